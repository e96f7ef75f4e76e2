// The light of a picture, as the stages after the composite pass it on: each takes one and gives one.
#pragma once

#include "effects/composite/composite.h"
#include "gpu/pass_list.h"

#include <vector>

namespace reflet::lighting {

struct Light : LightLayers {
    /// Red: share of the pixel that surfaces cover; the layers are premultiplied by it. None: all of it.
    gpu::Image coverage;
    /// Light of blended surfaces that the layers hold already. They cover the background, too: alpha is what they let
    /// through. Empty once `coverage` counts them.
    std::vector<gpu::Image> translucent;
    /// Of the nearest surface in each pixel, glass included; 0: the background shows.
    gpu::Image depth;
    /// Depth and motion that the light of a pixel moves with.
    gpu::Image followedDepth;
    gpu::Image followedMotion;
    gpu::Image baseColor;    ///< of the G-buffer; none: unknown
    gpu::Image reactive;     ///< share of the history that antialiasing gives up, red; none: 0
    gpu::Image antialiased;  ///< radiance, history length; none without temporal antialiasing
    /// `lit` before antialiasing and depth of field, of the rendered size; none: `lit` itself.
    gpu::Image unfiltered;
    gpu::Image sharp;              ///< `lit` before depth of field and motion blur; none without them
    gpu::Image circleOfConfusion;  ///< of DofImages; none without depth of field
    gpu::Image motionTiles;        ///< of MotionBlurImages; none without motion blur
};

/// Light::unfiltered, or `lit`.
inline gpu::Image unfilteredOf(const Light& light) {
    return light.unfiltered ? light.unfiltered : light.lit;
}

}  // namespace reflet::lighting
