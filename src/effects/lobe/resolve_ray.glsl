// The mean of a pixel's rays. The includer declares the images radiance, meanSource, meanSteps and
// directional, and the constants countSteps, adaptive, hasDirectional and adds.
#ifndef REFLET_RESOLVE_RAY_GLSL
#define REFLET_RESOLVE_RAY_GLSL

#include "effects/lobe/rays.glsl"
#include "shaders/directional_light.glsl"
#include "shaders/luminance.glsl"

// Sums over the rays of a batch.
struct RaySum {
    vec4 light;    // radiance · weight, hit distance [m]
    vec4 colors;   // of the sources
    vec4 turning;  // variation of the light with the normal
    float steps;
};

RaySum noRays() { return RaySum(vec4(0.0), vec4(0.0), vec4(0.0), 0.0); }

// n: the pixel's shading normal; only read if hasDirectional is set.
void addRay(inout RaySum sum, Ray ray, AnswerSum a, vec3 n, float steps) {
    vec3 radiance = a.light.rgb * ray.weight;
    sum.light += vec4(radiance, a.light.a);
    sum.colors += a.colors;
    sum.steps += steps;
    if (hasDirectional != 0u) {
        float bright = luminance(clampToHalf(radiance));
        sum.turning += ray.spread > 0.0 ? directionalFromAmbient(bright) : directionalFromRay(bright, ray.direction, n);
    }
}

// Overwrites the pixel, or adds to it, if this is not its first batch (`adds`). rays: of the pixel, in all batches; share: rays per
// pixel in its tile.
void storeMean(ivec2 pixel, RaySum sum, uint rays, float share) {
    float weight = 1.0 / float(max(rays, 1u));
    vec4 light = sum.light * weight;
    vec4 colors = sum.colors * weight;
    vec4 turning = sum.turning * weight;
    float steps = sum.steps * weight;
    if (adds != 0u) {
        light += imageLoad(radiance, pixel);
        colors += imageLoad(meanSource, pixel);
        turning += hasDirectional != 0u ? imageLoad(directional, pixel) : vec4(0.0);
        steps += countSteps != 0u ? imageLoad(meanSteps, pixel).r : 0.0;
    }
    if (adaptive != 0u && rays == 0u && share > 0.0) {
        light.a = -1.0;  // no rays in this frame
    }
    imageStore(radiance, pixel, roundToHalf(vec4(clampToHalf(light.rgb), min(light.a, largestHalf))));
    imageStore(meanSource, pixel, roundToHalf(colors));
    if (hasDirectional != 0u) {
        imageStore(directional, pixel, roundToHalf(clamp(turning, -largestHalf, largestHalf)));
    }
    if (countSteps != 0u) {
        imageStore(meanSteps, pixel, vec4(steps));
    }
}

#endif
