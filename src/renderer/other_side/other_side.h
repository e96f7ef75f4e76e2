// Surfaces that transmit diffuse light (KHR_materials_diffuse_transmission). Shared by C++ and GLSL.
//
// Light that leaves a thin surface on the camera's side has arrived on its other side. So those surfaces have a
// separate G-buffer, with normals that face away from the camera; it is lit by the same passes, and added to the light.
#ifndef REFLET_RENDERER_OTHER_SIDE_H
#define REFLET_RENDERER_OTHER_SIDE_H

#include "base/shared.h"

SHARED_BEGIN

struct OtherSideParams {
    uvec2 size;
};

SHARED_END

#ifdef __cplusplus

#include "lighting/light.h"
#include "renderer/trace_lobe.h"

namespace reflet {

/// Adds the light that the opaque surfaces of a view transmit; `light` itself if none does. seen: as for withCoats.
LightLayers withOtherSide(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                          const LightLayers& light);
lighting::Light withOtherSide(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                              const lighting::Light& light);

}  // namespace reflet
#endif

#endif
