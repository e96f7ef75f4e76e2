// Temporal antialiasing. In: this frame's radiance, depth, motion; history: mean, length, deviations. Out: the history
// with this frame. With HAS_COVERAGE also the coverage of pixels by surfaces, averaged with the radiance that is
// premultiplied by it: with the same weights, so that their quotient is the surfaces' colour.
#include "effects/temporal/temporal.h"
#include "shaders/catmull_rom.glsl"
#include "shaders/half_float.glsl"
#include "shaders/noise.glsl"
#include "shaders/projection.glsl"
#include "shaders/tone_compressed.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { TemporalParams params; };
layout(rgba16f) uniform readonly image2D radiance;
uniform sampler2D depth;
uniform sampler2D motion;
layout(rgba16f) uniform readonly image2D previousMean;    // radiance, history length
layout(rg16f) uniform readonly image2D previousDeviations;
layout(rgba16f) uniform writeonly image2D mean;
layout(rg16f) uniform writeonly image2D deviations;
#if HAS_COVERAGE
uniform sampler2D coverage;
layout(r32f) uniform readonly image2D previousCoverage;
layout(r32f) uniform writeonly image2D meanCoverage;
#endif

// Tolerance for rounding, in tone-compressed radiance.
const float slack = 0.002;
const float stillest = 0.25;     // pixels per frame; faster motion counts as not at rest
const float restAllowance = 1.25;  // factor on the clip limits at rest
// At rest, jitter makes an edge or a thin bar appear in some of a pixel's frames only, so limits are widened by the
// variance of past frames around their mean. If the differences keep the same sign, the history is stale. The measure
// is the squared recent mean difference over the variance, between these two bounds.
const vec2 staleness = vec2(0.25, 0.5);
const float recent = 0.25;  // weight of a frame in the recent mean difference

// Three pixels side by side.
struct Row {
    vec3 middle;   // linear
    vec3 sum;      // tone-compressed
    vec3 squares;
    float nearest;  // reversed depth
    ivec2 at;       // of that
#if HAS_COVERAGE
    float covered;         // the middle pixel
    float coveredSum;
    float coveredSquares;
#endif
};

Row loadRow(ivec2 pixel) {
    ivec2 last = ivec2(params.size) - 1;
    Row row;
    row.sum = vec3(0.0);
    row.squares = vec3(0.0);
    row.nearest = -1.0;
#if HAS_COVERAGE
    row.covered = texelFetch(coverage, clamp(pixel, ivec2(0), last), 0).r;
    row.coveredSum = 0.0;
    row.coveredSquares = 0.0;
#endif
    for (int x = -1; x <= 1; ++x) {
        ivec2 at = clamp(pixel + ivec2(x, 0), ivec2(0), last);
        vec3 c = clampToHalf(imageLoad(radiance, at).rgb);
        row.middle = x == 0 ? c : row.middle;
        vec3 t = toneCompress(c);
        row.sum += t;
        row.squares += t * t;
        float d = texelFetch(depth, at, 0).r;
        row.at = d > row.nearest ? at : row.at;
        row.nearest = max(d, row.nearest);
#if HAS_COVERAGE
        float covered = texelFetch(coverage, at, 0).r;
        row.coveredSum += covered;
        row.coveredSquares += covered * covered;
#endif
    }
    return row;
}

struct HistorySample {
    vec4 mean;  // radiance, length
    float covered;
};

// The history at a position in texels from the first texel's centre.
HistorySample reprojectedHistory(vec2 at) {
    ivec2 last = ivec2(params.size) - 1;
    CatmullRom taps = catmullRom(at);
    vec4 sum = vec4(0.0);
    float covered = 0.0;
    float total = 0.0;
    for (int y = taps.first.y; y <= taps.last.y; ++y) {
        bool outer = y == -1 || y == 2;
        int end = outer ? min(taps.last.x, 1) : taps.last.x;
        for (int x = outer ? max(taps.first.x, 0) : taps.first.x; x <= end; ++x) {
            float weight = taps.x[x + 1] * taps.y[y + 1];
            ivec2 tap = clamp(taps.corner + ivec2(x, y), ivec2(0), last);
            sum += weight * imageLoad(previousMean, tap);
#if HAS_COVERAGE
            covered += weight * imageLoad(previousCoverage, tap).r;
#endif
            total += weight;
        }
    }
    return HistorySample(max(sum / total, vec4(0.0)), clamp(covered / total, 0.0, 1.0));
}

// The fraction of the way from a box's centre to c at which its side lies, at most 1.
float insideShare(vec3 c, vec3 middle, vec3 halfSize) {
    vec3 out3 = abs(c - middle) / halfSize;
    return 1.0 / max(max(out3.x, out3.y), max(out3.z, 1.0));
}

// The pixel with the nearest surface in the 3x3 neighbourhood.
ivec2 nearestAround(Row above, Row row, Row below) {
    ivec2 at = above.nearest > row.nearest ? above.at : row.at;
    return below.nearest > max(above.nearest, row.nearest) ? below.at : at;
}

// uv now minus uv in the last frame. The G-buffer has no motion for the sky, which must still follow the camera's
// rotation to avoid ghosting.
vec2 motionAt(ivec2 pixel, float nearest) {
    if (nearest > 0.0) {
        return texelFetch(motion, pixel, 0).rg;
    }
    vec2 uv = pixelToUv(pixel, 1.0 / vec2(params.size));
    vec4 before = params.skyToPrevious * vec4(uvToNdc(uv), 0.0, 1.0);
    return before.w > 0.0 ? uv - ndcToUv(before.xy / before.w) : vec2(2.0);  // 2: off-screen: it was behind the camera
}

void resolve(ivec2 pixel, Row above, Row row, Row below) {
    float nearest = max(max(above.nearest, below.nearest), row.nearest);
    vec2 moved = motionAt(nearest > 0.0 ? nearestAround(above, row, below) : pixel, nearest) * vec2(params.size);
    vec2 at = vec2(pixel) - moved;
    bool known = params.hasPrevious != 0u && all(greaterThan(at, vec2(-0.5))) &&
                 all(lessThan(at, vec2(params.size) - 0.5));
    float still = known ? max(1.0 - length(moved) / stillest, 0.0) : 0.0;
    HistorySample history = HistorySample(vec4(0.0), 0.0);
    if (known) {
        history = reprojectedHistory(at);
    }
    vec4 before = history.mean;
    vec2 differed = still > 0.0 ? imageLoad(previousDeviations, ivec2(at + 0.5)).rg : vec2(0.0);
    float stale = differed.y * differed.y / (differed.x + 1e-5);
    float trust = still * clamp((staleness.y - stale) / (staleness.y - staleness.x), 0.0, 1.0);
    float variance = trust * differed.x;

    vec3 held = toneCompress(before.rgb);
    vec3 middle = (above.sum + row.sum + below.sum) / 9.0;
    vec3 around = max((above.squares + row.squares + below.squares) / 9.0 - middle * middle, 0.0);
    float allowed = params.settings.clip * mix(1.0, restAllowance, still);
    // This frame's own value is always within the box: it may be a one-pixel feature.
    vec3 halfSize = max(allowed * sqrt(around + variance) + slack, abs(toneCompress(row.middle) - middle));
    float share = insideShare(held, middle, halfSize);
#if HAS_COVERAGE
    float middleCovered = (above.coveredSum + row.coveredSum + below.coveredSum) / 9.0;
    float coveredSquares = (above.coveredSquares + row.coveredSquares + below.coveredSquares) / 9.0;
    float coveredAround = max(coveredSquares - middleCovered * middleCovered, 0.0);
    float coveredOverTime = trust * history.covered * (1.0 - history.covered);
    float halfCovered =
        max(allowed * sqrt(coveredAround + coveredOverTime) + slack, abs(row.covered - middleCovered));
    share = min(share, halfCovered / max(abs(history.covered - middleCovered), halfCovered));
    float keptCovered = mix(middleCovered, history.covered, share);
#endif
    vec3 clipped = mix(middle, held, share);
    vec3 kept = share < 1.0 ? toneExpand(clipped) : before.rgb;

    float most = mix(float(params.settings.framesInMotion), float(params.settings.frames), still);
    float fresh = still > 0.0 ? trust / still : 1.0;
    float frames = min(before.a * share * fresh, most - 1.0) + 1.0;
    float weight = 1.0 / frames;
    vec3 sum = frames > 1.0 ? mix(kept, row.middle, weight) : row.middle;
    uint random = hashPixel(uvec2(pixel), 0u, params.frame);
    imageStore(mean, pixel, vec4(ditherToHalf(clampToHalf(sum), random), frames));
#if HAS_COVERAGE
    imageStore(meanCoverage, pixel, vec4(frames > 1.0 ? mix(keptCovered, row.covered, weight) : row.covered));
#endif
    float off = toneCompress(row.middle).x - clipped.x;
    vec2 differs = vec2(still * mix(variance, off * off, weight), trust * mix(differed.y, off, max(weight, recent)));
    imageStore(deviations, pixel, vec4(differs, 0.0, 0.0));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y * temporalColumn);
    if (any(greaterThanEqual(uvec2(pixel), params.size))) {
        return;
    }
    int end = min(pixel.y + int(temporalColumn), int(params.size.y));
    Row above = loadRow(pixel - ivec2(0, 1));
    Row row = loadRow(pixel);
    for (; pixel.y < end; ++pixel.y) {
        Row below = loadRow(pixel + ivec2(0, 1));
        resolve(pixel, above, row, below);
        above = row;
        row = below;
    }
}
