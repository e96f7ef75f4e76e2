// From light to the final picture: composite, accumulation, antialiasing, depth of field, motion blur, exposure, tone
// mapping.
#pragma once

#include "effects/accumulate/accumulate.h"
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/exposure/exposure.h"
#include "effects/lobe/rays.h"
#include "effects/motion_blur/motion_blur.h"
#include "effects/temporal/temporal.h"
#include "effects/tonemap/display.h"
#include "lighting/light.h"
#include "lighting/settings.h"
#include "lighting/surfaces.h"

namespace reflet::lighting {

/// Direct light, and both lobes of indirect light.
struct LightParts {
    gpu::Image direct;
    LobeLight diffuse;
    LobeLight specular;
    gpu::Image fromEmitters{};  ///< part of `direct` that counts as indirect diffuse light
    gpu::Image highlights{};    ///< part of `direct` that counts as indirect specular light
    gpu::Image limits{};        ///< upper bounds of the sum, from LightBound; may be none
};

/// A lobe without rays.
LobeLight blackLobe(gpu::PassList& f, const ViewContext& in, const Surfaces& surfaces, uint32_t lobe);

/// Light of the surfaces, with nothing in front of them.
Light lightOf(const Surfaces& surfaces, gpu::Image lit);

/// The sum of the parts; direct light itself if neither lobe has rays and no layers are requested. layers: also write
/// each part. into: target of the sum; none: a transient image.
Light compose(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, const Surfaces& surfaces,
              const LightParts& parts, bool layers, gpu::Image into = {});

/// Removes direct light from the sum.
Light withoutDirect(gpu::PassList& f, const Light& light);

struct AccumulateHistory {
    AccumulateStore light;
    AccumulateStore coverage;
};

/// Averages this frame and the `framesBefore` frames before it. The light must have layers.
Light accumulate(gpu::PassList& f, AccumulateHistory& own, const Light& light, uint32_t framesBefore);

/// Parameters of antialiasing. size: output size; larger than the view's with temporal upscaling. jitter: of the view,
/// in its pixels. sky, mixesSizes: as in TemporalInputs.
struct Antialiasing {
    uvec2 size{};
    vec2 jitter{};
    const EnvironmentLight* sky = nullptr;
    bool mixesSizes = false;
};

/// Surfaces and their reflections, for stages that track the reflected image instead of the mirror.
struct Reflecting {
    const Surfaces& surfaces;
    const LobeLight* specular = nullptr;  ///< none: nothing reflects
    gpu::Image lit{};                     ///< all light of the surfaces, not antialiased
};

/// Temporal antialiasing (TAA), and upscaling to the output size.
Light antialias(gpu::PassList& f, TemporalStore& own, const ViewContext& in, const LightingSettings& settings,
                const Reflecting& reflecting, const Light& light, const Antialiasing& to);

struct DofHistory {
    gpu::HistoryImage light{"circle_of_confusion"};
    gpu::HistoryImage coverage{"coverage.circle_of_confusion"};
};

/// Depth of field; returns the light itself if there is none. Reflections are blurred by the distance of the reflected
/// image.
Light defocus(gpu::PassList& f, DofHistory& own, const ViewContext& in, const LightingSettings& settings,
              const Lens& lens, const Reflecting& reflecting, const Light& light);

/// Motion blur; returns the light itself if there is none. cameraBefore: world to clip space before the motion, if only
/// the camera has moved; NULL: use the light's motion vectors.
Light blurMotion(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, const Light& light,
                 const mat4* cameraBefore = nullptr);

/// Whether exposure can be metered: the light must have the size of the depth.
bool canMeter(const Light& light, const Surfaces& surfaces);

/// Automatic exposure in stops, smoothed over frames, from the light before depth of field. elapsed: seconds since the
/// last frame. preExposure: stops by which the light has been exposed already.
gpu::Image exposure(gpu::PassList& f, gpu::HistoryImage& own, const LightingSettings& settings,
                    const Surfaces& surfaces, const Light& light, float elapsed, float preExposure = 0.0F);

/// RGBA8, display encoded, alpha 1. exposure: none: the settings' exposure.
gpu::Image display(gpu::PassList& f, const LightingSettings& settings, gpu::Image radiance, gpu::Image exposure);
using reflet::displayFor;
using reflet::exposureFactor;

}  // namespace reflet::lighting
