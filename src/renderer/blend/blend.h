// Blended surfaces (alphaMode BLEND): order-independent transparency by depth peeling, composited over the light of the
// opaque surfaces. Shared by C++ and GLSL.
//
// Depth peeling (C. Everitt, Interactive Order-Independent Transparency, 2001) finds the nearest blended surface of
// each pixel, then the next one behind it, and so on. Each layer is a G-buffer of its own, which is lit like that of
// the opaque surfaces, by the same passes. So blending is exact in any order and through intersections, up to the
// number of layers. Layers are composited front to back, with the "over" operator (T. Porter, T. Duff, Compositing
// Digital Images, 1984).
#ifndef REFLET_RENDERER_BLEND_H
#define REFLET_RENDERER_BLEND_H

#include "base/shared.h"

SHARED_BEGIN

#define BLEND_SETTINGS(VALUE, SWITCH, CHOICE)                                                                         \
    VALUE(uint, layers, 4, 0, 8,                                                                                      \
          "Blended surfaces (alphaMode BLEND) that a pixel shows behind one another, the nearest ones first, in any " \
          "order of drawing. More: right where more of them overlap, cost grows linearly. 0: drawn opaque where "     \
          "their alpha is at least 0.5.")
SETTINGS(BlendSettings, BLEND_SETTINGS)

struct BlendLayerParams {
    uvec2 size;
    uint first;  // 1: nothing is in front of the layer
};

struct BlendOverParams {
    uvec2 size;
    uint coverage;  // 1: composites the layers' coverage in place of their light
};

SHARED_END

#ifdef __cplusplus

#include "effects/view.h"
#include "gpu/pass_list.h"
#include "renderer/draw_list.h"

#include <string_view>

namespace reflet {

/// Whether the view may show blended surfaces.
bool showsBlended(const DrawList& list, const ViewParams& view);

/// Which surfaces of a layer are composited.
enum class BlendSide : uint8_t { all, beforeGlass, behindGlass };

/// The layer that blendLayer composites.
struct BlendedLayer {
    gpu::Image depth;
    gpu::Image motion;      ///< motion of its G-buffer, with alpha
    gpu::Image glassDepth;  ///< depth of the nearest glass; none with BlendSide::all
    bool first = false;     ///< nothing is in front of it
};

/// Composites a layer under those in front of it. accumulated: RGBA16F: light and transmittance of the layers in front;
/// written by the first layer. radiance: of the layer.
void blendLayer(gpu::PassList& f, gpu::Image accumulated, gpu::Image radiance, const BlendedLayer& layer,
                BlendSide side);

/// over = accumulated layers over the light `behind` them; the alpha of `behind` is kept. RGBA16F, not the same image.
void blendOver(gpu::PassList& f, gpu::Image accumulated, gpu::Image behind, gpu::Image over);

/// The same for coverage by surfaces, in red, green and blue.
void coverOver(gpu::PassList& f, gpu::Image accumulated, gpu::Image behind, gpu::Image over);

/// Coverage by the accumulated layers: R32F.
gpu::Image coverageOf(gpu::PassList& f, gpu::Image accumulated);

/// As blendOver, with radiance and coverage of the layers in two images. RGBA16F.
gpu::Image blendAntialiased(gpu::PassList& f, gpu::Image radiance, gpu::Image covered, gpu::Image behind);

}  // namespace reflet
#endif

#endif
