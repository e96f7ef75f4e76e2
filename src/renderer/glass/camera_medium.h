// The volume of glass or water that the camera is in.
//
// The layers of glass then include the volume's back faces, where view rays leave it. Light is attenuated up to the
// nearest surface (A. Beer, 1852). Of nested volumes, only the innermost one is handled. Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_CAMERA_MEDIUM_H
#define REFLET_RENDERER_CAMERA_MEDIUM_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

struct CameraMediumParams {
    ViewParams view;
    vec3 extinction;  // [1/m]
};

SHARED_END

#ifdef __cplusplus

#include "lighting/light.h"
#include "renderer/draw_list.h"
#include "scene/volumes_around.h"

#include <optional>

namespace reflet {

struct CameraMedium {
    uint32_t draw = 0;  ///< index into DrawList::draws
    uint32_t kind = 0;  ///< glassKind of its material
    vec3 extinction{0.0F};
    float outerIor = 1.0F;  ///< index of refraction of the volume around it, or of air
};

/// The medium that the camera is in; nullopt: air, always for orthographic cameras. Costs nothing if the camera is
/// outside of all bounds of glass. pose: of an animated scene; list: of that pose. volumes: of that scene.
std::optional<CameraMedium> cameraMedium(VolumeFinder& volumes, const Scene& scene, const ScenePose* pose,
                                         const DrawList& list, const Camera& camera);

/// Attenuates the light by the medium, up to the nearest surface of `light`.
lighting::Light throughMedium(gpu::PassList& f, const CameraMedium& medium, const ViewParams& view,
                              const lighting::Light& light);

}  // namespace reflet
#endif

#endif
