// From light to a picture: composite, means over frames, antialiasing, depth of field, motion blur, exposure, tone map.
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
    gpu::Image limits{};        ///< of the sum, by LightBound; may be none
};

/// A lobe without rays.
LobeLight blackLobe(gpu::PassList& f, const ViewContext& in, const Surfaces& surfaces, uint32_t lobe);

/// A picture of the surfaces, with nothing in front of them.
Light lightOf(const Surfaces& surfaces, gpu::Image lit);

/// The sum of the parts; direct light itself where neither lobe has rays and no layers are asked for. layers: each
/// part, too. into: where the sum is written; none: an image of this frame.
Light compose(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, const Surfaces& surfaces,
              const LightParts& parts, bool layers, gpu::Image into = {});

/// Only indirect light is left in the sum.
Light withoutDirect(gpu::PassList& f, const Light& light);

struct AccumulateHistory {
    AccumulateStore light;
    AccumulateStore coverage;
};

/// Means over this frame and the `framesBefore` before it. The light must have layers.
Light accumulate(gpu::PassList& f, AccumulateHistory& own, const Light& light, uint32_t framesBefore);

/// What antialiases to. size: of the picture; larger than the view's with temporal upscaling. jitter: of the view, in
/// its pixels. sky, mixesSizes: of TemporalInputs.
struct Antialiasing {
    uvec2 size{};
    vec2 jitter{};
    const EnvironmentLight* sky = nullptr;
    bool mixesSizes = false;
};

/// Surfaces and what they reflect, for stages that follow what a mirror shows rather than the mirror.
struct Reflecting {
    const Surfaces& surfaces;
    const LobeLight* specular = nullptr;  ///< none: nothing reflects
    gpu::Image lit{};                     ///< all light of the surfaces, not antialiased
};

/// Temporal antialiasing, and upscaling to the size of the output.
Light antialias(gpu::PassList& f, TemporalStore& own, const ViewContext& in, const LightingSettings& settings,
                const Reflecting& reflecting, const Light& light, const Antialiasing& to);

struct DofHistory {
    gpu::HistoryImage light{"circle_of_confusion"};
    gpu::HistoryImage coverage{"coverage.circle_of_confusion"};
};

/// The blur of the lens; the light itself if there is none. Reflections are blurred by the distance of what they show.
Light defocus(gpu::PassList& f, DofHistory& own, const ViewContext& in, const LightingSettings& settings,
              const Lens& lens, const Reflecting& reflecting, const Light& light);

/// The blur of the shutter; the light itself if there is none. cameraBefore: world to clip space: only the camera has
/// moved, from there; NULL: as the light's motion says.
Light blurMotion(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, const Light& light,
                 const mat4* cameraBefore = nullptr);

/// Whether exposure can be measured: a picture of the size of the depth is needed.
bool canMeter(const Light& light, const Surfaces& surfaces);

/// Stops of automatic exposure, smoothed over frames: of the light before the lens. elapsed: seconds since the last
/// frame. preExposure: stops by which the light has been exposed already.
gpu::Image exposure(gpu::PassList& f, gpu::HistoryImage& own, const LightingSettings& settings,
                    const Surfaces& surfaces, const Light& light, float elapsed, float preExposure = 0.0F);

/// RGBA8, display encoded, alpha 1. exposure: none: that of the settings.
gpu::Image display(gpu::PassList& f, const LightingSettings& settings, gpu::Image radiance, gpu::Image exposure);
using reflet::displayFor;
using reflet::exposureFactor;

}  // namespace reflet::lighting
