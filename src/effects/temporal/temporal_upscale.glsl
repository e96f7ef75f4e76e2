// Temporal upscaling: adds a frame to a history of more pixels. In: the frame's radiance and neighbourhoods
// (temporal_around.glsl); history: mean, length, deviations. Out: the history with this frame. With HAS_COVERAGE also
// coverage, as in temporal.glsl.
#include "effects/temporal/temporal.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { TemporalUpscaleParams params; };
layout(rgba16f) uniform readonly image2D radiance;
layout(rgba16f) uniform readonly image2D around;
layout(rgba16f) uniform readonly image2D spread;
layout(rgba16f) uniform readonly image2D changed;
layout(rgba16f) uniform readonly image2D previousMean;  // radiance, history length
layout(rg16f) uniform readonly image2D previousDeviations;
layout(rgba16f) uniform writeonly image2D mean;
layout(rg16f) uniform writeonly image2D deviations;
#if HAS_COVERAGE
uniform sampler2D coverage;
layout(rg16f) uniform readonly image2D coveredAround;
layout(r32f) uniform readonly image2D previousCoverage;
layout(r32f) uniform writeonly image2D meanCoverage;
#endif
// Neighbourhoods are wider than the output's, and samples of a pixel's own area are rarer and less evenly spread.
const vec2 allowance = vec2(1.0, 2.0);
const vec2 pixelStaleLimits = vec2(0.4, 0.8);
const float aloneBlur = 0.0;  // what is shown of a pixel is a mean of four samples
#include "effects/temporal/temporal_history.glsl"

// Of the Gaussian, by the square of the distance in pixels of the output: 0.4 half a pixel off to both sides.
const float sharpness = 2.0;

float nearness(vec2 away) { return exp(-sharpness * dot(away, away)); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(mean)))) {
        return;
    }
    // The pixel's centre in the frame's pixels, whose centres are where samples are.
    vec2 at = (vec2(pixel) + 0.5) * params.ratio - params.jitter;
    ivec2 last = ivec2(params.size) - 1;
    ivec2 nearest = clamp(ivec2(floor(at)), ivec2(0), last);
    vec2 away = abs(vec2(nearest) + 0.5 - at) / params.ratio;
    vec4 middle = imageLoad(around, nearest);
    vec4 deviation = imageLoad(spread, nearest);
    ivec2 corner = ivec2(floor(at - 0.5));
    vec3 sum = vec3(0.0);
    float covered = 0.0;
    float total = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 sampled = corner + ivec2(i & 1, i >> 1);
        float weight = nearness((vec2(sampled) + 0.5 - at) / params.ratio) + 1e-6;
        sampled = clamp(sampled, ivec2(0), last);
        sum += weight * clampToHalf(imageLoad(radiance, sampled).rgb);
#if HAS_COVERAGE
        covered += weight * texelFetch(coverage, sampled, 0).r;
#endif
        total += weight;
    }
    Shown now;
    now.own = clampToHalf(imageLoad(radiance, nearest).rgb);
    now.blurred = sum / total;
    vec4 change = imageLoad(changed, nearest);
    now.follows = change.y >= 0.0;
    now.disturbed = change.x;
    now.relit = change.y;
    now.reactive = change.z;
    now.left = change.w;
    now.inside = all(lessThanEqual(away, vec2(0.5))) ? 1.0 : 0.0;
    now.near = nearness(away) + 1e-3;
    now.middle = middle.rgb;
    now.variance = deviation.rgb * deviation.rgb;
    now.moved = vec2(middle.a, deviation.a) / params.ratio * vec2(params.size);
#if HAS_COVERAGE
    now.covered = covered / total;
    vec2 coveredNear = imageLoad(coveredAround, nearest).rg;
    now.coveredMiddle = coveredNear.x;
    now.coveredVariance = coveredNear.y * coveredNear.y;
#endif
    accumulate(pixel, now);
}
