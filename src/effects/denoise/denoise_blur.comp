// One blur pass over neighbours on the same surface, on a disk rotated per pixel. Its radius depends on the remaining
// noise, the hit distance and the width of the lobe.
// In: light with hit distance or nearness, surfaces, moments, geometric normals. Out: light, blurred; where the history is short,
// the blurred light also becomes the next frame's history.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/denoise/denoise.glsl"
#include "shaders/blur_disk.glsl"
#include "shaders/ggx.glsl"
#include "shaders/noise.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 1) const uint feedsBack = 0u;
layout(constant_id = 2) const uint hasDirectional = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DenoiseBlurParams params; };
layout(rgba16f) uniform readonly image2D from;
layout(rg32ui) uniform readonly uimage2D surface;
layout(rg16f) uniform readonly image2D moments;
uniform usampler2D geometricNormal;
layout(rgba16f) uniform writeonly image2D nextLight;
layout(rgba16f) uniform writeonly image2D blurred;
layout(rgba16f) uniform readonly image2D directional;
layout(rgba16f) uniform writeonly image2D nextDirectional;
layout(rgba16f) uniform writeonly image2D blurredDirectional;

// Taps of a disk of 4 pixels or more. Smaller ones need fewer: they have no more pixels.
const int leastTaps = 3;
const int mostTaps = 8;
const float tapsPerPixel = 2.0;  // of the radius; with 1 the relative MSE of builtin:cave grows by 8 %
// Radius within which incoming light is about the same, relative to the lobe's width at the hit; diffuse: to the harmonic mean
// of the distances (0.3: 12 % more relative MSE in builtin:cave at frame 32).
const float shareOfWay = 0.3;
const float shareOfHarmonicWay = 0.8;
// Fraction of the radius per unit of relative noise, at frame 32 in seven scenes: with 0.7 mottling of 4 to 8 pixels is half as
// strong again, with 1.5 blur adds a tenth to the relative MSE of builtin:cornell.
const float radiusOfNoise = 1.0;
const float varianceFrames = 8.0;  // history length from which the variance is reliable; using it earlier loses energy
// History length from which pixels weigh the same in the blur. Fewer for reflections: history clip shortens that of
// highlights, which then weigh too little (builtin:gloss: relative MSE 0.0114 without, 0.0116 with 2, 0.0122 with 8).
const float trustedFrames = 4.0;
const float trustedFramesReflections = 2.0;
const float feedbackFrames = 4.0;  // history length from which the history is no longer replaced by blurred light

// Pixels of the grid. hit: distance, or nearness (denoise.glsl) of diffuse light.
float radiusAt(float d, float roughness, float hit, float noise) {
    if (lobe == 0u) {
        return min(params.radius, shareOfHarmonicWay / max(hit, 1e-6)) * noise;
    }
    float away = depthToViewDistance(d, params.view.depthToDistance);
    float pixelWidth = params.gridAngle * (params.view.eye.w > 0.0 ? away + hit : 1.0);
    return min(params.radius, shareOfWay * ggxConeTangent(roughness * roughness) * hit / pixelWidth) * noise;
}

// Relative standard deviation of the history's mean, estimated over five pixels: that of a single pixel is too small if
// its rays have not hit a bright light yet. With a short history 1 / sqrt(frames).
float noiseAt(ivec2 pixel, ivec2 size, float frames) {
    if (frames < varianceFrames) {
        return inversesqrt(max(frames, 1.0));
    }
    const ivec2 around[5] = ivec2[](ivec2(0), ivec2(-2, -2), ivec2(2, -2), ivec2(-2, 2), ivec2(2, 2));
    float mean = 0.0;
    float variance = 0.0;
    for (int i = 0; i < 5; ++i) {
        ivec2 at = clamp(pixel + around[i], ivec2(0), size - 1);
        vec2 m = imageLoad(moments, at).xy;
        float bright = luminance(imageLoad(from, at).rgb);
        variance += max(m.y - bright * bright, 0.0) / max(m.x, 1.0);
        mean += bright;
    }
    return min(1.0, radiusOfNoise * sqrt(5.0 * variance) / max(mean, 1e-6));
}

// Weight of a pixel in the blur by its frames: their mean's variance falls with them, so that a pixel with a short
// history takes its light from neighbours with a longer one. Not 0, for pixels that have no history yet.
float trust(float frames) { return clamp(frames, 0.25, lobe == 0u ? trustedFrames : trustedFramesReflections); }

// How fast the weight of reflections falls with the angle between both mirror directions: by the width of the lobe.
float sharpnessOf(float roughness) {
    float width = max(ggxConeTangent(roughness * roughness), 0.01);
    return 4.0 / (width * width);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(params.view.size);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    vec4 middle = imageLoad(from, pixel);
    KeptSurface own = unpackSurface(imageLoad(surface, pixel).xy);
    vec2 m = imageLoad(moments, pixel).xy;
    float radius = own.depth > 0.0 ? radiusAt(own.depth, own.roughness, middle.a, noiseAt(pixel, size, m.x)) : 0.0;
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), own.depth, params.view.clipToWorld);
    vec3 geometric = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    ScreenPlane plane = screenPlane(p, geometric, params.view.clipToWorld, params.view.pixel, params.view.pixelAngle);
    float turn = 6.2831853 * hashToUnit(hashPixel(uvec2(pixel), params.pass + 31u + 2u * lobe, params.view.frame));
    float weights = trust(m.x);
    vec4 sum = weights * middle;
    vec4 turning = hasDirectional != 0u ? weights * imageLoad(directional, pixel) : vec4(0.0);
    vec3 normals = weights * own.normal;
    // Below half a pixel nothing changes. The trip count is dynamic on purpose: see hardVisibility (shadow_map.glsl).
    int count = radius < 0.5 ? 0 : clamp(int(tapsPerPixel * radius + 1.0), leastTaps, mostTaps);
    vec2 spoke = firstSpoke(radius, max(count, 1), turn);
    float near = firstTapWeight(max(count, 1));
    float falls = near * near;
    float sharpness = lobe == 0u ? 0.0 : sharpnessOf(own.roughness);
    for (int i = 0; i < count; ++i) {
        ivec2 o = ivec2(round(tapReach(i) * spoke));
        spoke = nextSpoke(spoke);
        ivec2 at = clamp(pixel + o, ivec2(0), size - 1);
        // All loads at once, without a branch: a GPU waits for them once.
        KeptSurface there = unpackSurface(imageLoad(surface, at).xy);
        vec4 light = imageLoad(from, at);
        float frames = imageLoad(moments, at).x;
        float same = hasDirectional != 0u ? normalSimilarity(own, there) : surfaceSimilarity(own, there, lobe, sharpness);
        bool counts = there.depth > 0.0 && at == pixel + o && onSurface(plane, vec2(o), there.depth - own.depth);
        float weight = counts ? near * same * trust(frames) : 0.0;
        near *= falls;
        sum += weight * light;
        if (hasDirectional != 0u) {
            turning += weight * imageLoad(directional, at);
            normals += weight * there.normal;
        }
        weights += weight;
    }
    if (hasDirectional != 0u) {
        sum.rgb *= relightFactor(turning, normals / weights, own.normal);
        turning = roundToHalf(clamp(turning / weights, -largestHalf, largestHalf));
        imageStore(blurredDirectional, pixel, turning);
    }
    vec4 mean = roundToHalf(min(sum / weights, vec4(largestHalf)));
    imageStore(blurred, pixel, mean);
    if (feedsBack != 0u && m.x < feedbackFrames) {
        imageStore(nextLight, pixel, mean);
        if (hasDirectional != 0u) {
            imageStore(nextDirectional, pixel, turning);
        }
    }
}
