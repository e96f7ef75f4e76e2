// The background that the camera sees where there is no surface, if it is not the environment itself. Shared by C++ and
// GLSL.
//
// It is composited behind the finished radiance, which no rays read: so it lights nothing and is in no reflection. A
// colour or transparency is composited under the display image, weighted by the pixel's coverage by surfaces; radiance
// is then premultiplied by that coverage, and divided by it before the tone curve.
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

/// The background of a frame.
struct FrameBackground {
    Background shown;
    std::optional<EnvironmentLight> environment;  ///< only its texels; none: the lighting environment is shown
};

/// The light with the background where there is no surface, and with coverage, if the background needs it. The light
/// itself if the environment is shown.
lighting::Light withBackground(gpu::PassList& f, const FrameBackground& background, const ViewParams& view,
                               const lighting::Light& light);

/// RGBA8: the display image over the background's colour, or with straight alpha.
gpu::Image displayOver(gpu::PassList& f, const FrameBackground& background, const LightingSettings& settings,
                       const lighting::Light& light, gpu::Image exposure);

/// On the CPU, for images of the reference: radiance divided by the coverage, and a display image over the background.
/// coverage: "Y", 0 to 1. Both change nothing unless the background needs coverage.
FloatImage straightRadiance(const FloatImage& premultiplied, const FloatImage& coverage, const Background& background);
Bitmap overBackground(const Bitmap& display, const FloatImage& coverage, const Background& background);

/// Both, with tone mapping between them: the display image of premultiplied radiance.
Bitmap displayedOver(const FloatImage& premultiplied, const FloatImage& coverage, const Background& background,
                     const TonemapSettings& settings);

}  // namespace reflet
#endif

#endif
