// The volume of glass or water that the camera is in.
//
// The layers of glass then have its back faces, too: there the view rays leave it. What the frame shows is attenuated
// up to the nearest surface (A. Beer, 1852). Of nested volumes only the innermost one is drawn so. Shared by C++ and
// GLSL.
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
    float outerIor = 1.0F;  ///< of the volume around it, or of air
};

/// nullopt: air. Free if the camera is in no bounds of glass. An orthographic camera is nowhere. pose: of an animated
/// scene; list: of that pose. volumes: of that scene.
std::optional<CameraMedium> cameraMedium(VolumeFinder& volumes, const Scene& scene, const ScenePose* pose,
                                         const DrawList& list, const Camera& camera);

/// The light after its way through the medium, up to the nearest surface of `light`.
lighting::Light throughMedium(gpu::PassList& f, const CameraMedium& medium, const ViewParams& view,
                              const lighting::Light& light);

}  // namespace reflet
#endif

#endif
