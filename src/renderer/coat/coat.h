// Clear coats (KHR_materials_clearcoat): a second GGX layer of reflectance 0.04 over everything else. Shared by C++ and
// GLSL.
//
// The coats of the surfaces that a view shows are a separate G-buffer, black except for the layer. It is lit by the
// same passes as other surfaces, with one more reflection ray per coated pixel, and composited over these: the surface
// beneath receives the light that the coat does not reflect.
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

#include "lighting/light.h"
#include "renderer/trace_lobe.h"

namespace reflet {

/// Whether glass may have coats.
bool coatsGlass(const DrawList& list, const Settings& settings);

/// The surfaces whose coats are drawn.
struct CoatedSurfaces {
    gpu::Image depth;        ///< as rendered, with the same list and view
    gpu::Image nearerDepth;  ///< depth of the layer in front; none: `depth` is the nearest layer
    enum class Kind : uint8_t { opaque, glass, blended } kind = Kind::opaque;
};

/// Composites the coats over `behind`, the light of these surfaces, including any layers that it has. seen: the
/// surfaces, with their shadows, and the screen that reflections read. Reflected light counts as indirect specular.
LightLayers addCoats(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                     const CoatedSurfaces& surfaces, const LightLayers& behind);

/// The same for the opaque surfaces of a view; returns `behind` itself if no visible surface has a coat. Transmissive
/// surfaces count as opaque if they are drawn so.
LightLayers withCoats(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                      const LightLayers& behind);
lighting::Light withCoats(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                          const lighting::Light& behind);

}  // namespace reflet
#endif

#endif
