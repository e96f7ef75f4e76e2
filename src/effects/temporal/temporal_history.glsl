// The history of temporal antialiasing: reprojection, clipping, and the mean with what a frame shows.
// The includer declares params.settings, frame and exposureChange, the constants allowance
// (factors on the clip limits in motion and at rest), pixelStaleLimits and aloneBlur, and of the output's size the images previousMean,
// previousDeviations, mean and deviations, with HAS_COVERAGE also previousCoverage and meanCoverage.
#ifndef REFLET_TEMPORAL_HISTORY_GLSL
#define REFLET_TEMPORAL_HISTORY_GLSL

#include "effects/temporal/temporal_stale.glsl"
#include "shaders/catmull_rom.glsl"
#include "shaders/half_float.glsl"
#include "shaders/luminance.glsl"
#include "shaders/noise.glsl"
#include "shaders/tone_compressed.glsl"

// Tolerance for rounding, in tone-compressed radiance.
const float slack = 0.002;
const float stillest = 0.25;     // pixels per frame; faster motion counts as not at rest
// At rest, jitter makes an edge or a thin bar appear in some of a pixel's frames only, so limits are widened by the
// variance of past frames around their mean, unless the history is stale: staleShare between the includer's bounds
// pixelStaleLimits.
// History length from which pixels at rest take only samples of their own area: with one, edges are dotted. Relative MSE of
// builtin:colonnade at frame 8 and of builtin:moving at frame 32 with 1: 0.0099, 0.0079; 2: 0.0082, 0.0079; 4: 0.0079, 0.0087.
const float ownFrom = 2.0;
const float brightest = 2.0;  // luminance of what is shown of samples around a pixel at rest, relative to its mean
const float inMotion = -1.0;  // in place of that variance: the pixel moved

struct HistorySample {
    vec4 mean;  // radiance, length
    float covered;
};

// The history at a position in texels from the first texel's centre.
HistorySample reprojectedHistory(vec2 at) {
    ivec2 last = imageSize(previousMean) - 1;
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

// By how much another pre-exposure stretches small differences of tone-compressed luma y / (1 + y) around `luma`, which is
// that of this frame's.
float exposedStretch(float luma) {
    float exposed = params.exposureChange;
    float step = exposed + (1.0 - exposed) * luma;
    return step * step / exposed;
}

// What this frame shows at a pixel of the output.
struct Shown {
    vec3 own;       // the nearest sample's radiance
    float inside;   // 1 if that sample lies in the pixel's area, else 0
    vec3 blurred;   // mean of the samples around, weighted by distance
    float near;     // 0..1: how near the nearest sample is
    vec3 middle;    // of the 3x3 neighbourhood: mean, tone-compressed
    vec3 variance;
    vec2 moved;     // pixels of the output
    bool follows;   // the last frame showed the same surface
    float disturbed;  // as in Changed
    float relit;      // as in Changed
    float reactive;   // share of the history that is given up
    float left;       // 1: as Seen.left
#if HAS_COVERAGE
    float covered;
    float coveredMiddle;
    float coveredVariance;
#endif
};

// Adds it to the history.
void accumulate(ivec2 pixel, Shown now) {
    vec2 size = vec2(imageSize(mean));
    vec2 at = vec2(pixel) - now.moved;
    bool known = now.follows && all(greaterThan(at, vec2(-0.5))) && all(lessThan(at, size - 0.5));
    float still = known ? max(1.0 - length(now.moved) / stillest, 0.0) : 0.0;
    HistorySample history = HistorySample(vec4(0.0), 0.0);
    if (known) {
        history = reprojectedHistory(at);
        history.mean.rgb *= params.exposureChange;
    }
    vec4 before = vec4(history.mean.rgb * now.relit, history.mean.a);
    vec2 differed = still > 0.0 ? imageLoad(previousDeviations, ivec2(at + 0.5)).rg : vec2(0.0);
    // What has just come to rest may keep what the moving thing left behind: nobody knows yet how much jitter changes it.
    float rested = differed.x < 0.0 ? 0.0 : 1.0;
    differed *= rested;
    float stretch = exposedStretch(toneCompress(history.mean.rgb).x);
    differed *= vec2(stretch * stretch, stretch);
    float stale = ramp(staleShare(differed.y, differed.x, now.middle.x), pixelStaleLimits);
    float disturbed = max(now.disturbed, 0.0);
    float right = rested * still * (1.0 - stale) * (1.0 - disturbed);
    float trust = right * (1.0 - now.left);
    float variance = trust * differed.x;

    vec3 held = toneCompress(before.rgb);
    float allowed = params.settings.clip * mix(allowance.x, allowance.y, still);
    // With a history at rest that is right, a pixel takes only samples of its own area.
    float exact = trust * min(before.a / ownFrom, 1.0);
    // What is next to a lamp must not get its light from samples beside it. A sample in the middle is the pixel's own.
    float limit = brightest * luminance(before.rgb);
    float bounded = limit / max(luminance(now.blurred), max(limit, 1e-12));
    vec3 blurred = now.blurred * mix(1.0, bounded, now.near < 1.0 ? trust * min(before.a, 1.0) : 0.0);
    // Without a history the pixels around are all that can smooth an edge.
    float alone = before.a == 0.0 && now.variance.x > slack * slack ? aloneBlur : 0.0;
    vec3 shown = blurred + (now.own - blurred) * exact + alone * (toneExpand(now.middle) - blurred);
    // This frame's own value is always within the box: it may be a one-pixel feature.
    vec3 own = toneCompress(shown);
    vec3 halfSize = max(allowed * sqrt(now.variance + variance) + slack, abs(own - now.middle));
    float share = insideShare(held, now.middle, halfSize);
#if HAS_COVERAGE
    float coveredOverTime = trust * history.covered * (1.0 - history.covered);
    float halfCovered =
        max(allowed * sqrt(now.coveredVariance + coveredOverTime) + slack, abs(now.covered - now.coveredMiddle));
    share = min(share, halfCovered / max(abs(history.covered - now.coveredMiddle), halfCovered));
#endif
    // At rest, only a sample of the pixel's own area can tell that it changed: neighbours may have missed a thin bar.
    share = mix(share, 1.0, trust * (1.0 - now.inside));
    share = now.disturbed >= 0.0 && params.settings.clip > 0.0 ? share : 1.0;
    // Of what has left nothing may be kept; where it was not, all is as it would be without it.
    share = share < 1.0 ? share * (1.0 - now.left) : 1.0;
    trust = share < 1.0 ? trust : right;
    variance = trust * differed.x;
    vec3 clipped = mix(now.middle, held, share);
    vec3 kept = share < 1.0 ? toneExpand(clipped) : before.rgb;
#if HAS_COVERAGE
    float keptCovered = mix(now.coveredMiddle, history.covered, share);
#endif

    float most = mix(float(params.settings.framesInMotion), float(params.settings.frames), still);
    float fresh = still > 0.0 && now.disturbed >= 0.0 && params.settings.clip > 0.0 ? 1.0 - stale : 1.0;
    float lasting = before.a * share * fresh * (1.0 - now.reactive) * (1.0 - disturbed);
    float weight = now.near + (now.inside - now.near) * still * min(lasting / ownFrom, 1.0);
    float frames = min(lasting, most - weight) + weight;
    float part = max(weight / frames, disturbed);
    bool first = part >= 1.0;
    vec3 sum = first ? shown : mix(kept, shown, part);
    uint random = hashPixel(uvec2(pixel), 0u, params.frame);
    imageStore(mean, pixel, vec4(ditherToHalf(clampToHalf(sum), random), frames));
#if HAS_COVERAGE
    float covered = mix(now.covered, now.coveredMiddle, alone);
    imageStore(meanCoverage, pixel, vec4(first ? covered : mix(keptCovered, covered, part)));
#endif
    float off = own.x - clipped.x;
    vec2 differs =
        vec2(still > 0.0 ? still * mix(variance, off * off, part) : inMotion,
             trust * mix(differed.y, off, max(part, recentShare * now.inside)));
    imageStore(deviations, pixel, vec4(differs, 0.0, 0.0));
}

#endif
