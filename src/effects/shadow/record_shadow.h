// Debug record of the sun's shadow at one pixel, with all look-ups in the shadow map, for explanatory pictures. Shared
// by C++ and GLSL.
#ifndef REFLET_EFFECTS_RECORD_SHADOW_H
#define REFLET_EFFECTS_RECORD_SHADOW_H

#include "base/shared.h"
#include "effects/shadow/shadow.h"

SHARED_BEGIN

// The image: (number of look-ups, visibility, penumbra width, mean blocker height), (point, 1), then for each look-up
// (position in world space, 1: it blocks).
const uint recordedShadowHead = 2;
const uint recordedShadowTexels = 600;  // further ones are counted, not stored

struct RecordShadowParams {
    ViewParams view;
    SunShadowParams sun;
    ShadowSettings settings;
    float sunSlope;
    uvec2 pixel;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/recorder.h"

#include <vector>

namespace reflet {

struct RecordedShadow {
    struct Texel {
        vec3 place{0.0F};     ///< of the surface that the shadow map holds; where it blocks nothing, beside the point
        bool blocks = false;  ///< it is nearer to the sun than the point
    };

    vec3 point{0.0F};
    float visibility = 1.0F;     ///< of the sun, before denoising
    float penumbraWidth = 0.0F;  ///< metres, as SunVisibility::penumbra
    float blockerHeight = 0.0F;  ///< mean, metres toward the sun; 0: none found
    uint32_t lookups = 0;        ///< in the blocker search and the filter
    std::vector<Texel> texels;   ///< in the order of the look-ups, those outside of the map left out
};

/// Records the look-ups of the pixel with the same filter as sunVisibility, with another turn of its sample pattern.
/// The pixel must show a surface for the result to mean anything. in.blueNoise is not used.
gpu::Readback recordShadow(gpu::PassList& f, const GBuffer& g, const ShadowInputs& in,
                           const RecordShadowParams& params);
RecordedShadow recordedShadow(const gpu::Recorder& f, gpu::Readback readback);

}  // namespace reflet
#endif

#endif
