// Generates the rays of a lobe, traces them on the screen, adds the environment and averages them, all in one pass: for rays
// that no other source may answer, so that none is written to memory.
// In: depth, both normals, material, base colour, GGX table, blue noise, tiles; what screen_hit.glsl reads; the
// environment. Out: radiance with mean hit distance, source colours with confidence, steps, variation of the light with the
// normal, motion of reflected images; added to earlier batches.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "base/strips.h"
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/rays.glsl"
// First, because its uniform block must be: Mesa 22.3 crashes if a loop or branch depends only on values of a shader's
// fourth uniform block.
#include "effects/lobe/screen_hit.glsl"
#include "effects/lobe/march_phases.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 1) const uint noise = RayNoise_blue;
layout(constant_id = 2) const uint distribution = RayDistribution_cosine;
layout(constant_id = 3) const uint screen = 0u;
layout(constant_id = 4) const uint countSteps = 0u;
layout(constant_id = 5) const uint hasDirectional = 0u;
layout(constant_id = 6) const uint adds = 0u;
layout(constant_id = 7) const uint spreads = 0u;
layout(constant_id = 9) const uint highlights = 0u;
layout(constant_id = 8) const uint environmentLights = 0u;
const uint adaptive = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform RayBlock { GenerateRaysParams rayParams; };
layout(scalar) uniform EnvironmentAnswerBlock { AnswerEnvironmentParams environmentAnswer; };
uniform sampler2D ownDepth;
uniform usampler2D ownNormal;
uniform usampler2D ownGeometricNormal;
uniform sampler2D ownMaterial;
uniform sampler2D ownBaseColor;
uniform sampler2D ggxTable;
layout(scalar) readonly buffer BlueNoiseBlock { uint texels[]; } blueNoise;
layout(rg32f) uniform readonly image2D tiles;
layout(rgba16f) uniform image2D radiance;
layout(rgba16f) uniform image2D meanSource;
layout(r32f) uniform image2D meanSteps;
layout(rgba16f) uniform image2D directional;
#include "effects/ambient_occlusion/ambient_visibility.glsl"
#include "effects/lobe/environment_answer.glsl"
#include "effects/lobe/make_ray.glsl"
#include "effects/lobe/resolve_ray.glsl"

// What all rays of a pixel start from.
struct RayOrigin {
    ivec2 pixel;
    vec3 point;
    vec3 normal;     // of shading
    vec3 geometric;  // normal
    vec4 plane;      // on screen
    MaterialTexel material;
};

// Traces a ray on the screen. number: of the ray in its pixel. steps: its number of steps. Returns whether it has not ended.
bool traceOnScreen(RayOrigin from, HizState state, uint number, Ray ray, inout WaitingRay w, inout AnswerSum sum,
                   inout float steps) {
    if (ray.trust == 0.0) {
        return false;
    }
    MarchView view = marchView(params.view);
    MarchRay march = makeMarchRay(from.point, ray.direction, from.plane, view);
    MarchOptions options = screenOptions(from.pixel, number);
    MarchResult hit = marchPhase(RayItem(packSlot(ivec3(from.pixel, 0)), 0u, 0u), state, march, options, view);
    if (collects != 0u && hit.outcome == marchUnfinished) {
        return true;
    }
    bool unseen = hitsUnseen(hit, from.point, ray, options);
    updateClearDistance(hit, unseen, from.point, ray, w);
    if (hit.outcome == marchHit && !unseen) {
        if (tellsMotion != 0u && number == 0u) {
            writeReflectionMotion(from.pixel, ray, from.point, hit);
        }
        w.rest = addAnswer(sum, answerOfHit(hit, from.point, ray), w.rest, sourceScreen);
    }
    steps = float(hit.steps);
    return false;
}

// Returns whether the ray has not ended.
bool traceRay(RayOrigin from, HizState state, RayNumber number, inout RaySum mean) {
    Ray ray = makeRay(number, from.point, from.normal, from.material, from.geometric);
    WaitingRay w = WaitingRay(ivec3(0), 1.0, 0.0, false, vec3(0.0));
    AnswerSum sum = AnswerSum(vec4(0.0), vec4(0.0));
    float looked = 0.0;
    if (screen != 0u) {
        bool waits = traceOnScreen(from, state, number.index, ray, w, sum, looked);
        if (collects != 0u && waits) {
            return true;
        }
    }
    if (w.rest > 0.0) {
        float occlusion = lobe == lobeDiffuse ? from.material.occlusion : 1.0;
        occlusion = min(occlusion, ambientVisibility(from.pixel, ray));
        addAnswer(sum, answerOfEnvironment(ray, occlusion, w.lost, w.inFront), w.rest, sourceEnvironment);
    }
    addRay(mean, ray, sum, from.normal, looked);
    return false;
}

void tracePixel(ivec2 pixel, HizState state, uint rays, float share) {
    float d = texelFetch(ownDepth, pixel, 0).r;
    MaterialTexel m = unpackMaterial(texelFetch(ownMaterial, pixel, 0));
    bool needed = d > 0.0 && (lobe == lobeDiffuse || (m.flags & materialFlagLambert) == 0u);
    vec3 p = uvToWorld(pixelToUv(pixel, rayParams.view.pixel), max(d, 1e-12), rayParams.view.clipToWorld);
    vec3 geometric = unpackUnitVector(texelFetch(ownGeometricNormal, pixel, 0).r);
    RayOrigin from = RayOrigin(pixel, p, unpackUnitVector(texelFetch(ownNormal, pixel, 0).r), geometric,
                               planeOnScreen(p, geometric, params.view.clipToWorld), m);
    RaySum mean = noRays();
    uint end = needed ? min(rayParams.firstRay + rayParams.rayCount, rays) : 0u;
    bool waits = false;  // with `collects` pixels have one ray
    for (uint i = rayParams.firstRay; i < end; ++i) {
        waits = traceRay(from, state, RayNumber(pixel, i, rays), mean);
    }
    if (collects == 0u || !waits) {
        storeMean(pixel, mean, rays, share);
    }
}

void tracePixel(ivec2 pixel, HizState state) {
    float share = imageLoad(tiles, pixel / int(rayTileSide)).r;
    tracePixel(pixel, state, pixelRays(share, uvec2(pixel), rayParams.view.frame), share);
}

void main() {
    if (continues != 0u) {
        uint stride = gl_NumWorkGroups.x * listGroupSize;
        for (uint i = gl_WorkGroupID.x * listGroupSize + gl_LocalInvocationIndex; i < unfinishedCount(); i += stride) {
            UnfinishedRay ray = unfinished.items[i];
            tracePixel(unpackSlot(ray.ray.slot).xy, unpackUnfinished(ray));
        }
        return;
    }
    ivec2 pixel = pixelInStrips();
    if (all(lessThan(pixel, ivec2(rayParams.view.size)))) {
        tracePixel(pixel, hizStart());
    }
}
