// The settings that the stages read. Every caller has these; a caller may have more.
#pragma once

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/contact/contact.h"
#include "effects/denoise/denoise.h"
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/rays.h"
#include "effects/lobe/trace_screen.h"
#include "effects/motion_blur/motion_blur.h"
#include "effects/radiance_cache/radiance_cache.h"
#include "effects/shadow/shadow.h"
#include "effects/temporal/temporal.h"
#include "effects/tonemap/tonemap.h"

namespace reflet {

struct LightingSettings {
    ShadowSettings shadow;
    ContactSettings contact;
    TraceScreenSettings traceScreen;
    EnvironmentSettings environment;
    AoSettings ao;
    DiffuseSettings diffuse;
    SpecularSettings specular;
    DenoiseSettings denoise;
    RadianceCacheSettings radianceCache;
    TemporalSettings temporal;
    DofSettings dof;
    MotionBlurSettings motionBlur;
    TonemapSettings tonemap;
};

namespace lighting {

/// Whether either lobe has rays.
bool tracesRays(const LightingSettings& settings);

/// Whether sunShadow reads its history.
bool keepsPenumbras(const ShadowSettings& settings);

/// Users count pixels of the output; stages count those that are rendered. Call it once for the settings of a frame
/// that is rendered at another height than its output has (temporal upscaling).
void countRenderedPixels(LightingSettings& settings, float renderedHeight, float outputHeight);

/// What has changed since the last frame.
struct Change {
    uint32_t rest = 0;   ///< frames before this one since anything changed (ViewParams::rest)
    float light = 0.0F;  ///< the share of the light that has changed, 0 to 1
};

/// Sets how long histories may be. What is at rest converges: its histories grow beyond what settings allow for motion,
/// and are not clipped. Where light changes they shrink at once, to what a mean would hold that forgets that share in
/// each frame. scale: of rendered frames to the output. Call it once for the settings of a frame.
void fitHistories(LightingSettings& settings, const Change& change, float scale);

}  // namespace lighting
}  // namespace reflet
