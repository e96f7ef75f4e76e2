// The light of a view, passed through the stages after the composite: each takes and returns one.
#pragma once

#include "effects/composite/composite.h"
#include "gpu/pass_list.h"

#include <vector>

namespace reflet::lighting {

struct Light : LightLayers {
    /// Red: share of the pixel covered by surfaces; the layers are premultiplied by it. None: fully covered.
    gpu::Image coverage;
    /// Light of blended surfaces, already contained in the layers. They cover the background, too; alpha is their
    /// transmittance. Empty once `coverage` includes them.
    std::vector<gpu::Image> translucent;
    /// Depth of the nearest surface in each pixel, glass included; 0: the background shows.
    gpu::Image depth;
    /// Depth and motion by which the light of a pixel is reprojected.
    gpu::Image followedDepth;
    gpu::Image followedMotion;
    gpu::Image baseColor;    ///< base colour of the G-buffer; none: unknown
    gpu::Image reactive;     ///< reactive mask, red: share of the history that TAA discards; none: 0
    gpu::Image antialiased;  ///< radiance, history length; none without temporal antialiasing
    /// `lit` before antialiasing and depth of field, at the rendered size; none: `lit` itself.
    gpu::Image unfiltered;
    gpu::Image sharp;              ///< `lit` before depth of field and motion blur; none without them
    gpu::Image circleOfConfusion;  ///< as in DofImages; none without depth of field
    gpu::Image motionTiles;        ///< as in MotionBlurImages; none without motion blur
};

/// Light::unfiltered, or `lit`.
inline gpu::Image unfilteredOf(const Light& light) {
    return light.unfiltered ? light.unfiltered : light.lit;
}

}  // namespace reflet::lighting
