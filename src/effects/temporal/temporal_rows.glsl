// 3x3 neighbourhoods of this frame's pixels, a row at a time, so that pixels above one another share their loads.
// The includer declares params as TemporalParams, the images radiance, depth, motion, previousSeen, seen, previousLeft
// and left, and with HAS_COVERAGE coverage.
#ifndef REFLET_TEMPORAL_ROWS_GLSL
#define REFLET_TEMPORAL_ROWS_GLSL

#include "shaders/half_float.glsl"
#include "shaders/not_inlined.glsl"
#include "shaders/projection.glsl"
#include "shaders/tone_compressed.glsl"

layout(constant_id = 0) const uint isReactive = 0u;
layout(constant_id = 1) const uint hasBaseColor = 0u;
uniform sampler2D reactive;
uniform sampler2D baseColor;  // as in GBuffer

float reactiveAt(ivec2 pixel) { return isReactive != 0u ? texelFetch(reactive, pixel, 0).r : 0.0; }

const float darkest = 0.05;     // base colour that tells light from texture; darker things shine by reflections
const float sameSurface = 0.1;  // of the reversed depth

// Three pixels side by side.
struct Row {
    vec3 middle;   // linear
    vec3 sum;      // tone-compressed
    vec3 squares;
    vec3 light;    // of each: lightLuma
    vec3 depths;   // of each: reversed depth
    float nearest;  // reversed depth
    ivec2 at;       // of that
    float own;      // reversed depth of the middle pixel
#if HAS_COVERAGE
    float covered;         // the middle pixel
    float coveredSum;
    float coveredSquares;
#endif
};

// Of three samples around a pixel's centre: the quadratic B-spline, which the position of the samples hardly changes.
// jitter: of the samples, in pixels.
vec3 steadyWeights(float jitter) {
    float at = clamp(-jitter, -0.5, 0.5);
    return vec3(0.5 * (0.5 - at) * (0.5 - at), 0.75 - at * at, 0.5 * (0.5 + at) * (0.5 + at));
}

// Luma of the light that falls on a pixel's surface, without its texture, which jitter changes.
float lightLuma(vec3 c, ivec2 at) {
    float luma = dot(c, vec3(0.25, 0.5, 0.25));
    if (hasBaseColor == 0u) {
        return luma;
    }
    vec3 root = texelFetch(baseColor, at, 0).rgb;
    return luma / max(dot(root * root, vec3(0.25, 0.5, 0.25)), darkest);
}

vec3 onSurface(vec3 depths, float own) {
    return vec3(lessThanEqual(abs(depths - own), vec3(sameSurface * own)));
}

vec3 weightedSums(vec3 weights, vec3 values) {
    vec3 weighted = weights * values;
    return vec3(dot(weights, vec3(1.0)), dot(weighted, vec3(1.0)), dot(weighted, values));
}

// Of lightLuma over the 3x3 pixels: the mean, and the relative deviation of those that show the middle one's surface. The
// mean counts all, as jitter makes pixels at silhouettes show now this surface, now that.
vec2 steadyLight(Row above, Row row, Row below) {
    vec3 x = steadyWeights(params.jitter.x);
    vec3 y = steadyWeights(params.jitter.y);
    vec3 upper = x * y.x;
    vec3 middle = x * y.y;
    vec3 lower = x * y.z;
    float mean = dot(upper, above.light) + dot(middle, row.light) + dot(lower, below.light);
    upper *= onSurface(above.depths, row.own);
    middle *= onSurface(row.depths, row.own);
    lower *= onSurface(below.depths, row.own);
    vec3 sums = weightedSums(upper, above.light) + weightedSums(middle, row.light) + weightedSums(lower, below.light);
    vec2 moments = sums.yz / sums.x;
    return vec2(mean, sqrt(max(moments.y - moments.x * moments.x, 0.0)) / max(moments.x, 1e-6));
}

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
        row.light[x + 1] = lightLuma(c, at);
        float d = texelFetch(depth, at, 0).r;
        row.depths[x + 1] = d;
        row.own = x == 0 ? d : row.own;
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
    vec4 before = params.toPrevious * vec4(uvToNdc(uv), 0.0, 1.0);
    return before.w > 0.0 ? uv - ndcToUv(before.xy / before.w) : vec2(2.0);  // 2: off-screen: it was behind the camera
}

// What a pixel shows, and how it moved since the last frame.
struct Seen {
    vec2 moved;    // uv
    bool follows;  // the last frame showed the same surface where it was
    bool left;     // at rest, where something else has been until one frame ago, which may be in the history
    bool sky;      // the environment, which does not change
};

const float slowest = 0.25;      // of the frame's pixels; faster motion counts as not at rest
const float skyDistance = -64.0;  // in place of log2 of the reversed depth, which is 0
const float sameDistance = 0.15;  // of log2: 11 %
const vec2 sameMotion = vec2(1.0, 0.5);  // of the frame's pixels, and of the motion

float distanceOf(float reversedDepth) {
    return reversedDepth > 0.0 ? max(log2(reversedDepth), skyDistance) : skyDistance;
}

// Whether the last frame showed something else there: what hid this surface has left, or something has come that no
// motion vector tells of. It had another distance or, beside what it stands on, another motion of its own. Where
// nothing moves or moved, jitter alone lets a thin thing come and go. `of`: that surface, as imageStored in seen.
bool disoccluded(ivec2 at, vec4 of, float expected, float steep) {
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(params.size)))) {
        return true;
    }
    vec4 before = imageLoad(previousSeen, at);
    bool otherMotion = distance(before.yz, of.yz) > max(sameMotion.x, sameMotion.y * length(of.yz));
    bool rest = before.w > 0.0 && of.w > 0.0;
    return otherMotion || (!rest && abs(before.x - expected) > sameDistance + steep);
}

// Tells the next frame where something was that has started to move: what it hid there has been at rest like itself, so
// that nothing else tells them apart.
void leavePlace(ivec2 was, vec4 of) {
    bool inside = all(greaterThanEqual(was, ivec2(0))) && all(lessThan(was, ivec2(params.size)));
    bool moves = of.w == 0.0 && length(of.yz) > slowest;
    if (!moves || !inside || imageLoad(previousSeen, was).w <= 0.0) {
        return;
    }
    for (int i = 0; i < 9; ++i) {
        ivec2 at = clamp(was + ivec2(i % 3, i / 3) - 1, ivec2(0), ivec2(params.size) - 1);
        imageStore(left, at, vec4(1.0));
    }
}

Seen seenAt(ivec2 pixel, Row above, Row row, Row below) {
    float nearest = max(max(above.nearest, below.nearest), row.nearest);
    ivec2 nearestPixel = nearest > 0.0 ? nearestAround(above, row, below) : pixel;
    Seen now;
    now.moved = motionAt(nearestPixel, nearest);
    vec2 uv = pixelToUv(nearestPixel, 1.0 / vec2(params.size));
    vec4 was = params.toPrevious * vec4(uvToNdc(uv), nearest, 1.0);
    vec2 own = nearest > 0.0 ? now.moved - (uv - ndcToUv(was.xy / was.w)) : vec2(0.0);
    float rests = length(now.moved * vec2(params.size)) < slowest ? 1.0 : 0.0;
    vec4 of = vec4(distanceOf(nearest), clamp(own * vec2(params.size), -largestHalf, largestHalf), rests);
    // A steep surface changes its distance from pixel to pixel.
    float steep = 2.0 * (of.x - distanceOf(row.own));
    vec2 from = vec2(pixel) - (now.moved - params.jitterChange) * vec2(params.size);
    now.sky = nearest <= 0.0 && params.skyIsFixed != 0u;
    ivec2 before = rests > 0.0 ? pixel : ivec2(floor(from + 0.5));
    now.follows = notInlined(params.hasPrevious, gl_GlobalInvocationID.x) != 0u && !disoccluded(before, of, distanceOf(was.z / was.w), steep);
    now.left = rests > 0.0 && imageLoad(previousLeft, pixel).r > 0.0;
    imageStore(seen, pixel, of);
    leavePlace(before, of);
    return now;
}

#endif
