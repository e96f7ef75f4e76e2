// Clear coats (KHR_materials_clearcoat): a second GGX layer of reflectance 0.04 over everything else. Shared by C++ and
// GLSL.
//
// The coats of the surfaces that a view shows are a G-buffer of their own, black but for the layer. It is lit by the
// same passes as other surfaces, with one more reflection ray per coated pixel, and composited over these: what is
// beneath receives what the coat does not reflect.
#ifndef REFLET_RENDERER_COAT_H
#define REFLET_RENDERER_COAT_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

struct CoatOverParams {
    ViewParams view;
};

SHARED_END

#ifdef __cplusplus

#include "effects/accumulate/accumulate.h"
#include "renderer/lit_layer.h"

namespace reflet {

/// Whether the view may show coats of opaque surfaces; transmissive ones count as opaque where they are drawn so.
bool showsCoats(const ViewInputs& in, const Settings& settings);

/// Whether glass may have coats.
bool coatsGlass(const DrawList& list, const Settings& settings);

/// The surfaces whose coats are drawn.
struct CoatedSurfaces {
    gpu::Image depth;        ///< as rendered, with the same list and view
    gpu::Image nearerDepth;  ///< of the layer in front; none: `depth` is that of the nearest one
    enum class Kind : uint8_t { opaque, glass, blended } kind = Kind::opaque;
};

/// Composites the coats over `behind`, the light of these surfaces. seen: the surfaces, with their shadows, and the
/// screen that reflections read. lit: the sum is written to it; none: to an image of this frame. layers: also those of
/// `behind`, not only the sum. Reflected light counts as indirect specular.
LightLayers addCoats(gpu::Recorder& f, const ViewInputs& in, const Settings& asked, const TracedView& seen,
                     const CoatedSurfaces& surfaces, const LightLayers& behind, gpu::Image lit, bool layers);

}  // namespace reflet
#endif

#endif
