// Direct light: sun and lamps on the G-buffer, plus what surfaces emit and the background. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_DIRECT_H
#define REFLET_RENDER_DIRECT_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

// As many as the smallest uniform buffer that Vulkan promises (16 KiB) holds.
const uint maxLamps = 200;

const uint lampPoint = 0;
const uint lampSpot = 1;
const uint lampDirectional = 2;

// KHR_lights_punctual.
struct LampParams {
    vec3 position;  // world space
    uint type;
    vec3 toLamp;         // unit, against the way the light travels (spot, directional)
    float inverseRange;  // 1 / range; 0: without end
    vec3 intensity;      // [W/sr]; directional: irradiance [W/m²]
    float spotScale;     // factor = clamp(cos · scale + offset, 0, 1)²
    float spotOffset;
};

struct LampBlock {
    uint count;
    LampParams lamps[maxLamps];
};

struct DirectParams {
    ViewParams view;
    vec3 toSun;
    vec3 sunIrradiance;  // on a surface that faces it [W/m²]
    vec3 background;     // radiance of the sky
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// The GGX albedo table (RG16F, 32x32: A, B; see ggx_table.comp). Made once.
gpu::Texture makeGgxTable(gpu::Frame& f);

/// RGBA16F: radiance of direct light, emission and background, alpha 1.
gpu::Image directLight(gpu::Frame& f, const GBuffer& g, gpu::Image sunVisibility, gpu::Image ggxTable,
                       const DirectParams& params, const LampBlock& lamps);

}  // namespace reflet
#endif

#endif
