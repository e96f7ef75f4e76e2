// First pass of the shadow denoiser: temporal accumulation with the reprojected history, and each pixel's blur kernel.
// In: tiles, depth, geometric normal, motion, visibility, penumbra, history. Out, where there is a penumbra: texels as the
// blur reads them, kernels, history.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/shadow/shadow_clean.h"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"
#include "shaders/shadow_kernel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ShadowDenoiseParams params; };
uniform sampler2D depth;
uniform usampler2D geometricNormal;
uniform sampler2D motion;
layout(r8) uniform readonly image2D visibility;
layout(rg16f) uniform readonly image2D penumbra;
layout(rg32ui) uniform readonly uimage2D previous;  // mean, frames; depth
layout(rg32ui) uniform writeonly uimage2D next;
layout(r32ui) uniform writeonly uimage2D gathered;
layout(rgba32ui) uniform writeonly uimage2D kernel;
layout(scalar) readonly buffer TilesBlock {
    uint groups[3];
    uint count;
    uint items[];
} tiles;

// Standard deviation of a pass across the edge, relative to the penumbra width; both passes together widen it by 3 %.
const float acrossEdge = 0.05;
const float alongEdge = 3.0;     // standard deviation of a pass along a straight edge, pixels
const float longest = 6.0;       // of either, pixels
const float shortest = 0.15;     // pixels; reaches no neighbour
const float allowance = 0.06;    // tolerance of the history clip beyond the neighbours' range
const float enoughFound = 3.0;   // of eight neighbours
const float wideEnough = 8.0;    // pixels
const float historySlack = 4.0;  // tolerance for the height of history surfaces, relative to that of neighbours

struct Neighbours {
    vec2 gradient;  // of the visibility, per pixel
    float lowest;
    float highest;
    float width;  // mean penumbra width of the pixels with a known one [m]; 0: none
    vec2 found;   // sum of the visibility of those pixels, and their number
};

// Statistics of the 3x3 pixels on the same surface.
Neighbours look(ivec2 pixel, float d, float middle, ScreenPlane plane) {
    ivec2 last = ivec2(params.view.size) - 1;
    Neighbours n = Neighbours(vec2(0.0), middle, middle, 0.0, vec2(0.0));
    vec2 widths = vec2(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 o = ivec2(i % 3, i / 3) - 1;
        ivec2 at = clamp(pixel + o, ivec2(0), last);
        if (onSurface(plane, vec2(at - pixel), texelFetch(depth, at, 0).r - d)) {
            float v = imageLoad(visibility, at).r;
            float w = imageLoad(penumbra, at).r;
            n.lowest = min(n.lowest, v);
            n.highest = max(n.highest, v);
            n.gradient += (v - middle) * vec2(o) * vec2(o.y == 0 ? 0.25 : 0.125, o.x == 0 ? 0.25 : 0.125);
            widths += w > 0.0 ? vec2(w, 1.0) : vec2(0.0);
            n.found += w > 0.0 ? vec2(v, 1.0) : vec2(0.0);
        }
    }
    n.width = widths.y > 0.0 ? widths.x / widths.y : 0.0;
    return n;
}

// Reprojected history: mean and length; length 0: none.
vec2 remembered(ivec2 pixel, vec3 p, ScreenPlane plane) {
    vec4 before = params.view.previousWorldToClip * vec4(p, 1.0);
    float expected = before.z / before.w;
    // With subpixel jitter the history is the mean over a pixel's area, so it is read without jitter, which keeps it
    // sharp while nothing moves. Jitter matters only for the depth comparison.
    vec2 jitter = params.view.jitterChange * params.view.size;
    vec2 at = (pixelToUv(pixel, params.view.pixel) - texelFetch(motion, pixel, 0).rg) * params.view.size - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 f = at - vec2(corner);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 o = ivec2(i & 1, i >> 1);
        ivec2 texel = corner + o;
        if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(params.view.size)))) {
            continue;
        }
        uvec2 bits = imageLoad(previous, texel).xy;
        float frames = float(bits.x >> 16u);
        float height = heightAbove(plane, vec2(texel) - at - jitter, uintBitsToFloat(bits.y) - expected);
        if (frames > 0.0 && abs(height) <= historySlack) {
            vec2 share = mix(1.0 - f, f, vec2(o));
            sum += share.x * share.y * vec3(float(bits.x & 0xffffu) / 65535.0, frames, 1.0);
        }
    }
    return sum.z > 0.01 ? sum.xy / sum.z : vec2(0.0);
}

// The quadratic form (inverse covariance) of a pass's Gaussian kernel, in pixels.
// metres: from metresAcross.
vec3 formAt(vec3 metres, Neighbours n, float shrink) {
    float deviation = acrossEdge * n.width * shrink;
    vec3 disk = metres / (deviation * deviation) + vec3(1.0, 0.0, 1.0) / (longest * longest);
    // Pixels along a shadow edge are equally lit, so the kernel is extended along it where the gradient is as steep as
    // the penumbra width predicts (a single edge, not noise or several edges). This does not widen the kernel across
    // the edge.
    vec3 pixels = inverseSymmetric(metres + 1e-12 * vec3(1.0, 0.0, 1.0));
    float steep = sqrt(max(quadratic(pixels, n.gradient), 0.0)) * n.width;
    vec2 along = vec2(-n.gradient.y, n.gradient.x) * inversesqrt(max(dot(n.gradient, n.gradient), 1e-12));
    along *= alongEdge * shrink * min(0.8 * steep, 1.0);
    vec3 edge = vec3(along.x * along.x, along.x * along.y, along.y * along.y);
    return inverseSymmetric(inverseSymmetric(disk) + edge + vec3(1.0, 0.0, 1.0) * (shortest * shortest));
}

void gather(ivec2 pixel) {
    float d = texelFetch(depth, pixel, 0).r;
    if (d <= 0.0) {
        return;
    }
    vec2 uv = pixelToUv(pixel, params.view.pixel);
    vec3 p = uvToWorld(uv, d, params.view.clipToWorld);
    vec3 normal = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    ScreenPlane plane = screenPlane(p, normal, params.view.clipToWorld, params.view.pixel, params.view.pixelAngle);
    float seen = imageLoad(visibility, pixel).r;
    Neighbours n = look(pixel, d, seen, plane);
    if (n.width <= 0.0) {
        return;
    }
    // If the blocker search failed here but succeeded in most neighbours, inside a penumbra wider than the
    // neighbourhood, the pixel is not really lit: use the neighbours' mean.
    vec3 metres = metresAcross(uv, d, plane, params.view.clipToWorld, params.view.pixel, params.toSun);
    float pixelsWide = n.width * inversesqrt(max(max(metres.x, metres.z), 1e-20));
    bool wide = pixelsWide > wideEnough;
    if (imageLoad(penumbra, pixel).r < 0.0 && n.found.y >= enoughFound && wide) {
        seen = n.found.x / n.found.y;
    }
    vec2 before = params.hasPrevious != 0u ? remembered(pixel, p, plane) : vec2(0.0);
    float held = before.x;
    if (params.view.rest < framesUntilSettled) {
        held = clamp(before.x, n.lowest - allowance, n.highest + allowance);
        before.y *= max(1.0 - 8.0 * abs(held - before.x), 0.0) * similarity(seen - held, params.samples);
    } else if (params.view.jitterChange != vec2(0.0)) {
        // A sharp edge moves within its pixel with the jitter: temporal antialiasing keeps its samples apart.
        before.y *= min(pixelsWide / wideEnough, 1.0);
    }
    before.y = min(before.y, max(float(params.historyFrames) - 1.0, 0.0));
    float mean = (held * before.y + seen) / (before.y + 1.0);
    vec3 form = min(formAt(metres, n, inversesqrt(sqrt(before.y + 1.0))), vec3(1e4));
    imageStore(kernel, pixel,
               uvec4(packHalf2x16(form.xy), packHalf2x16(vec2(form.z, 0.0)), packHalf2x16(plane.perPixel),
                     floatBitsToUint(plane.perDepth)));
    uint meanBits = uint(clamp(mean, 0.0, 1.0) * 65535.0 + 0.5);
    imageStore(gathered, pixel, uvec4(meanBits | packHalf2x16(vec2(0.0, n.width))));
    if (params.historyFrames > 0u) {
        uint frames = min(uint(before.y + 1.5), params.historyFrames);
        imageStore(next, pixel, uvec4(meanBits | frames << 16u, floatBitsToUint(d), 0u, 0u));
    }
}

void main() {
    for (uint i = gl_WorkGroupID.x; i < tiles.count; i += gl_NumWorkGroups.x) {
        ivec2 tile = ivec2(tiles.items[i] & 0xffffu, tiles.items[i] >> 16u);
        ivec2 pixel = tile * int(shadowTileSide) + ivec2(gl_LocalInvocationID.xy);
        if (all(lessThan(pixel, ivec2(params.view.size)))) {
            gather(pixel);
        }
    }
}
