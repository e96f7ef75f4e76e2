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
#include "gpu/pass_list.h"
#include "lighting/light.h"
#include "lighting/settings.h"
#include "scene/scene.h"

#include <optional>

namespace reflet {

/// The background of a frame, unless it is the environment itself.
struct FrameBackground {
    Background shown;
    std::optional<EnvironmentLight> environment;  ///< only its texels; none: the environment itself is shown
};

/// The light with the background where there is no surface, and how much of each pixel surfaces cover, if the
/// background needs it. The light itself if the environment is shown.
lighting::Light withBackground(gpu::PassList& f, const FrameBackground& background, const ViewParams& view,
                               const lighting::Light& light);

/// RGBA8: the display image over the background's colour, or with straight alpha.
gpu::Image displayOver(gpu::PassList& f, const FrameBackground& background, const LightingSettings& settings,
                       const lighting::Light& light, gpu::Image exposure);

/// On the host, for images of the reference: radiance divided by the coverage, and a display image over the background.
/// coverage: "Y", 0 to 1. Both change nothing unless the background needs coverage.
FloatImage straightRadiance(const FloatImage& premultiplied, const FloatImage& coverage, const Background& background);
Bitmap overBackground(const Bitmap& display, const FloatImage& coverage, const Background& background);

/// Both, with the tone map between them: the display image of premultiplied radiance.
Bitmap displayedOver(const FloatImage& premultiplied, const FloatImage& coverage, const Background& background,
                     const TonemapSettings& settings);

}  // namespace reflet
#endif

#endif
