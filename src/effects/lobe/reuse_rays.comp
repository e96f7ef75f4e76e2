// Ray reuse: averages a pixel's rays with those of neighbours on the same surface. A neighbour's ray is weighted by the
// pixel's own lobe toward the ray's hit over the neighbour's pdf, and the sum is normalised by the sum of weights
// (ratio estimator). Light that varies along the surface is blurred, the lobe is not.
// In: surfaces; per ray: direction, result, source, steps. Out: radiance with mean hit distance; source colours with
// confidence and steps, of the pixel's own rays.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/ray_tiles.h"
#include "effects/lobe/rays.glsl"
#include "effects/lobe/reuse_rays.h"
#include "effects/gbuffer/gbuffer.glsl"
#include "shaders/directional_light.glsl"
#include "shaders/luminance.glsl"
#include "shaders/noise.glsl"
#include "shaders/shadow_kernel.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 1) const uint countSteps = 0u;
layout(constant_id = 2) const uint hasDirectional = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ReuseRaysParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D material;
layout(rg32ui) uniform readonly uimage2DArray direction;
layout(rgba16f) uniform readonly image2DArray answer;
layout(rgba8) uniform readonly image2DArray raySource;
layout(r32f) uniform readonly image2DArray raySteps;
layout(rgba16f) uniform writeonly image2D radiance;
layout(rgba16f) uniform writeonly image2D source;
layout(r32f) uniform writeonly image2D steps;
layout(rgba16f) uniform writeonly image2D directional;

const float goldenAngle = 2.39996323;
const float widest = 12.0;      // pixels to the farthest neighbour
// Radius of the neighbourhood relative to the lobe's width at the hit. Chosen from 0.1 and 0.3 by the error against the
// reference, on cave and gloss with 8 neighbours.
const float shareOfWay = lobe == lobeDiffuse ? 0.1 : 0.3;
const float leastFacing = 0.9;  // smallest cosine between neighbours' normals
const float leastCosine = 1e-3;
const float mostWeight = 4.0;   // of a neighbour's ray

// The surface of a pixel.
struct Shown {
    vec3 p;
    vec3 normal;
    vec3 toEye;
    float alpha;  // roughness squared
};

// Weighted sums.
struct Sum {
    vec3 light;
    float away;  // hit distance
    float weight;
    vec4 directional;
};

Shown shownAt(ivec2 pixel, float d) {
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    float roughness = texelFetch(material, pixel, 0).r;
    return Shown(p, unpackUnitVector(texelFetch(normal, pixel, 0).r), directionToEye(p, params.view.eye),
                 roughness * roughness);
}

// BRDF times cosine, without Fresnel, which hardly varies between a pixel's rays.
float evaluateLobe(Shown s, vec3 l) {
    float nl = dot(s.normal, l);
    if (nl <= 0.0) {
        return 0.0;
    }
    if (lobe == lobeDiffuse) {
        return nl;
    }
    float nv = max(dot(s.normal, s.toEye), leastCosine);
    float nh = clamp(dot(s.normal, normalize(s.toEye + l)), 0.0, 1.0);
    return ggxDistribution(nh, s.alpha) * ggxVisibility(nl, nv, s.alpha) * nl;
}

// The pdf of a direction, as sampled by generate_rays.comp; in the units of evaluateLobe. Reflection rays are distributed as
// the lobe, up to a factor that is about the same for neighbours.
float pdfOf(Shown s, Ray ray) {
    float nl = max(dot(s.normal, ray.direction), leastCosine);
    if (lobe == lobeDiffuse) {
        return nl / max(ray.weight, 0.05);  // the weight accounts for distributions other than cosine
    }
    return evaluateLobe(s, ray.direction);
}

void add(inout Sum sum, float weight, vec4 answered, vec3 toward, vec3 normal) {
    sum.light += weight * answered.rgb;
    if (hasDirectional != 0u) {
        sum.directional += directionalFromRay(luminance(clampToHalf(weight * answered.rgb)), toward, normal);
    }
    sum.away += weight * answered.a;
    sum.weight += weight;
}

// Radius in grid pixels within which incoming light is about the same.
float reuseRadius(Shown own, float d, float away) {
    float distance = depthToViewDistance(d, params.view.depthToDistance);
    float pixelWidth = params.gridAngle * (params.view.eye.w > 0.0 ? distance : 1.0);
    float lobeWidth = lobe == lobeDiffuse ? 1.0 : ggxConeTangent(own.alpha);
    return min(widest, shareOfWay * lobeWidth * away / pixelWidth);
}

void addNeighbour(inout Sum sum, Shown own, ivec2 at, float d) {
    Shown there = shownAt(at, d);
    if (dot(there.normal, own.normal) < leastFacing || abs(sqrt(there.alpha) - sqrt(own.alpha)) > 0.1) {
        return;
    }
    for (uint i = 0u; i < params.rayCount; ++i) {
        Ray ray = unpackRay(imageLoad(direction, ivec3(at, i)).xy);
        vec4 answered = imageLoad(answer, ivec3(at, i));
        vec3 toHit = there.p + ray.direction * max(answered.a, 1e-4) - own.p;
        float away = max(length(toHit), 1e-4);
        float weight = ray.spread > 0.0 ? 0.0 : evaluateLobe(own, toHit / away) / max(pdfOf(there, ray), 1e-6);
        add(sum, min(weight, mostWeight), vec4(answered.rgb, away), toHit / away, own.normal);
    }
}

void addNeighbours(inout Sum sum, ivec2 pixel, Shown own, float d) {
    float reach = reuseRadius(own, d, sum.away / max(sum.weight, 1e-6));
    if (reach < 1.0) {
        return;
    }
    vec3 geometric = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    ScreenPlane plane = screenPlane(own.p, geometric, params.view.clipToWorld, params.view.pixel, params.view.pixelAngle);
    float turn = 6.2831853 * hashToUnit(hashPixel(uvec2(pixel), 47u + lobe, params.view.frame));
    for (uint i = 0u; i < params.neighbours; ++i) {
        float angle = turn + float(i) * goldenAngle;
        float from = max(reach * sqrt((float(i) + 0.5) / float(params.neighbours)), 1.0);
        ivec2 at = pixel + ivec2(round(from * vec2(cos(angle), sin(angle))));
        if (at == pixel || any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(params.view.size)))) {
            continue;
        }
        float there = texelFetch(depth, at, 0).r;
        if (there > 0.0 && onSurface(plane, vec2(at - pixel), there - d)) {
            addNeighbour(sum, own, at, there);
        }
    }
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    Sum sum = Sum(vec3(0.0), 0.0, 0.0, vec4(0.0));
    Sum own = sum;
    vec4 colors = vec4(0.0);
    float stepped = 0.0;
    bool borrows = d > 0.0;
    Shown shown = shownAt(pixel, max(d, 1e-12));
    for (uint i = 0u; i < params.rayCount; ++i) {
        ivec3 slot = ivec3(pixel, i);
        Ray ray = unpackRay(imageLoad(direction, slot).xy);
        vec4 answered = imageLoad(answer, slot);
        add(own, ray.weight, vec4(answered.rgb, 0.0), ray.direction, shown.normal);
        own.away += answered.a;
        add(sum, evaluateLobe(shown, ray.direction) / max(pdfOf(shown, ray), 1e-6), answered, ray.direction,
            shown.normal);
        borrows = borrows && ray.spread == 0.0;
        colors += imageLoad(raySource, slot);
        stepped += countSteps != 0u ? imageLoad(raySteps, slot).r : 0.0;
    }
    float share = 1.0 / float(params.rayCount);
    // Other pixels have no rays; their slots hold stale data.
    bool traced = d > 0.0 && (lobe == lobeDiffuse || !isLambert(unpackMaterial(texelFetch(material, pixel, 0))));
    vec4 light = traced ? vec4(own.light, own.away) * share : vec4(0.0);
    colors = traced ? colors * share : vec4(0.0);
    vec4 turning = traced ? own.directional * share : vec4(0.0);
    if (traced && borrows && (lobe == lobeDiffuse || shown.alpha > mirrorRoughness * mirrorRoughness)) {
        float before = sum.weight;
        addNeighbours(sum, pixel, shown, d);
        if (sum.weight > before) {
            light = vec4(sum.light, sum.away) / max(sum.weight, 1e-6);
            turning = sum.directional / max(sum.weight, 1e-6);
        }
    }
    imageStore(radiance, pixel, roundToHalf(vec4(clampToHalf(light.rgb), min(light.a, largestHalf))));
    imageStore(source, pixel, roundToHalf(colors));
    if (hasDirectional != 0u) {
        imageStore(directional, pixel, roundToHalf(clamp(turning, -largestHalf, largestHalf)));
    }
    if (countSteps != 0u) {
        imageStore(steps, pixel, vec4(traced ? stepped * share : 0.0));
    }
}
