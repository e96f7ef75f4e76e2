// Settings of the stages, common to all callers; a caller may have more.
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

/// Converts pixel counts in the settings from output pixels to rendered pixels. Call it once for the settings of a
/// frame whose rendered height differs from that of its output (temporal upscaling).
void countRenderedPixels(LightingSettings& settings, float renderedHeight, float outputHeight);

/// Amount of change since the last frame.
struct Change {
    uint32_t rest = 0;   ///< frames before this one since anything changed (ViewParams::rest)
    float light = 0.0F;  ///< share of the light that has changed, 0 to 1
};

/// Sets maximum history lengths. At rest the image converges: histories grow beyond what settings allow for motion, and
/// are not clipped. When light changes they shrink at once, to the length of a mean that forgets that share in each
/// frame. scale: rendered size over output size. Call it once for the settings of a frame.
void fitHistories(LightingSettings& settings, const Change& change, float scale);

}  // namespace lighting
}  // namespace reflet
