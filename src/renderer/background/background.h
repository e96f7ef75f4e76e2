// The background: what the camera sees where there is no surface, if it is not the environment itself. Shared by C++
// and GLSL.
//
// It is put behind the finished radiance, which rays of this frame and of the next one do not read: so it lights
// nothing and is in no reflection. A colour or transparency is laid under the display image, by how much of the pixel
// surfaces cover; radiance is then premultiplied by that coverage, and divided by it before the tone curve.
#ifndef REFLET_RENDERER_BACKGROUND_H
#define REFLET_RENDERER_BACKGROUND_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

struct BackgroundParams {
    ViewParams view;
};

struct StraightParams {
    uvec2 size;
};

struct UnderlayParams {
    vec3 color;  // display encoded, 0 to 1
    uvec2 size;
};

SHARED_END

#ifdef __cplusplus

#include "base/image_file.h"
#include "effects/environment/environment_light.h"
#include "effects/tonemap/tonemap.h"
#include "gpu/recorder.h"
#include "scene/scene.h"

#include <optional>

namespace reflet {

/// The background of a frame, unless it is the environment itself.
struct FrameBackground {
    Background shown;
    std::optional<EnvironmentLight> environment;  ///< only its texels; none: the environment itself is shown
};

/// RGBA16F copies with the background where there is no surface.
struct BackgroundImages {
    gpu::Image direct;
    gpu::Image lit;
    gpu::Image coverage;  ///< red, green and blue: 1 where there is a surface, else 0
};

BackgroundImages drawBackground(gpu::Recorder& f, gpu::Image depth, gpu::Image direct, gpu::Image lit,
                                const EnvironmentLight& environment, const ViewParams& view);

/// Radiance divided by the coverage, 0 where that is 0: RGBA16F.
gpu::Image straightRadiance(gpu::Recorder& f, gpu::Image premultiplied, gpu::Image coverage);

/// RGBA8: the display image over the background's colour, or with straight alpha.
gpu::Image overBackground(gpu::Recorder& f, gpu::Image display, gpu::Image coverage, const Background& background);

/// The same two on the host, for images of the reference. coverage: "Y", 0 to 1. Both change nothing unless the
/// background needs coverage.
FloatImage straightRadiance(const FloatImage& premultiplied, const FloatImage& coverage, const Background& background);
Bitmap overBackground(const Bitmap& display, const FloatImage& coverage, const Background& background);

/// Both, with the tone map between them: the display image of premultiplied radiance.
Bitmap displayedOver(const FloatImage& premultiplied, const FloatImage& coverage, const Background& background,
                     const TonemapSettings& settings);

}  // namespace reflet
#endif

#endif
