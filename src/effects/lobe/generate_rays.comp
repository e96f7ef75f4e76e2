// Generates the rays of a lobe: directions, weights, and the list of rays to trace. In the same pass, if requested, traces
// them on the screen (`screen`), so that the list has only its misses; and if no other source follows (`last`), adds the
// environment and averages the pixel's rays, so that no ray is written to memory.
// In: depth, both normals, material, base colour, GGX table, blue noise, tiles, the list of tiles with rays; what
// screen_hit.glsl reads; the environment.
// Out: direction, answer, source and steps of the rays, the list of waiting rays; or radiance with mean hit distance, source
// colours with confidence, steps, and variation of the light with the normal; motion of reflected images.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/rays.glsl"
#include "effects/lobe/trace_screen.h"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 8) const uint adds = 0u;
layout(constant_id = 10) const uint spreads = 0u;
layout(constant_id = 11) const uint environmentLights = 0u;
layout(constant_id = 1) const uint noise = RayNoise_blue;
layout(constant_id = 2) const uint distribution = RayDistribution_cosine;
layout(constant_id = 3) const uint adaptive = 0u;  // 1: rays per pixel change from frame to frame
layout(constant_id = 4) const uint screen = 0u;
layout(constant_id = 5) const uint last = 0u;
layout(constant_id = 6) const uint countSteps = 0u;
layout(constant_id = 7) const uint hasDirectional = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
#include "effects/lobe/screen_hit.glsl"
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
layout(scalar) readonly buffer ListBlock {
    uint groups[3];
    uint count;
    uint items[];
} list;
layout(rg32ui) uniform writeonly uimage2DArray direction;
layout(rgba16f) uniform writeonly image2DArray answer;
layout(rgba8) uniform writeonly image2DArray source;
layout(r32f) uniform writeonly image2DArray steps;
layout(rgba16f) uniform image2D radiance;
layout(rgba16f) uniform image2D meanSource;
layout(r32f) uniform image2D meanSteps;
layout(rgba16f) uniform image2D directional;
#include "effects/lobe/environment_answer.glsl"
#include "effects/lobe/make_ray.glsl"
#include "effects/lobe/rays_append.glsl"
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

// Traces a ray on the screen. number: of the ray in its pixel. Returns its steps.
float traceOnScreen(RayOrigin from, uint number, Ray ray, inout WaitingRay w, inout AnswerSum sum) {
    if (ray.trust == 0.0) {
        return 0.0;
    }
    MarchView view = marchView(params.view);
    MarchOptions options = screenOptions(from.pixel, number);
    MarchResult hit = marchBy(method, makeMarchRay(from.point, ray.direction, from.plane, view), options, view);
    bool facesAway = hitsBackOf(hit, ray);
    updateClearDistance(hit, facesAway, w);
    if (hit.outcome == marchHit && !facesAway) {
        if (tellsMotion != 0u && number == 0u) {
            writeReflectionMotion(from.pixel, ray, from.point, hit);
        }
        w.rest = addAnswer(sum, answerOfHit(hit, from.point, ray), w.rest, sourceScreen);
    }
    return float(hit.steps);
}

// Traces, or leaves to the next source, one ray.
void processRay(RayOrigin from, RayNumber number, bool needed, inout RaySum mean) {
    ivec3 slot = ivec3(from.pixel, number.index - rayParams.firstRay);
    Ray ray = Ray(vec3(0.0, 0.0, 1.0), 0.0, 0.0, 0.0);
    WaitingRay w = WaitingRay(slot, 1.0, 0.0, false);
    AnswerSum sum = AnswerSum(vec4(0.0), vec4(0.0));
    float looked = 0.0;
    if (needed) {
        ray = makeRay(number, from.point, from.normal, from.material, from.geometric);
        if (screen != 0u) {
            looked = traceOnScreen(from, number.index, ray, w, sum);
        }
    }
    if (last != 0u) {
        if (needed && w.rest > 0.0) {
            float occlusion = lobe == lobeDiffuse ? from.material.occlusion : 1.0;
            addAnswer(sum, answerOfEnvironment(ray, occlusion, w.lost), w.rest, sourceEnvironment);
        }
        addRay(mean, ray, sum, from.normal, looked);
        return;
    }
    imageStore(direction, slot, uvec4(packRay(ray), 0u, 0u));
    imageStore(answer, slot, sum.light);
    imageStore(source, slot, sum.colors);
    if (countSteps != 0u) {
        imageStore(steps, slot, vec4(looked));
    }
    if (needed && w.rest > 0.0) {
        appendRay(w);
    }
}

void processPixel(ivec2 pixel, uint rays, float share) {
    float d = texelFetch(ownDepth, pixel, 0).r;
    MaterialTexel m = unpackMaterial(texelFetch(ownMaterial, pixel, 0));
    bool needed = d > 0.0 && (lobe == lobeDiffuse || (m.flags & materialFlagLambert) == 0u);
    vec3 p = uvToWorld(pixelToUv(pixel, rayParams.view.pixel), max(d, 1e-12), rayParams.view.clipToWorld);
    vec3 geometric = unpackUnitVector(texelFetch(ownGeometricNormal, pixel, 0).r);
    RayOrigin from = RayOrigin(pixel, p, unpackUnitVector(texelFetch(ownNormal, pixel, 0).r), geometric,
                               planeOnScreen(p, geometric, params.view.clipToWorld), m);
    RaySum mean = noRays();
    uint end = min(rayParams.firstRay + rayParams.rayCount, rays);
    for (uint i = rayParams.firstRay; i < end; ++i) {
        processRay(from, RayNumber(pixel, i, rays), needed, mean);
    }
    if (last != 0u) {
        storeMean(pixel, mean, rays, share);
    }
}

// One group per tile: of the list; or of all, if every pixel of the means must be written.
void main() {
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    if (last == 0u) {
        uint item = gl_WorkGroupID.y * tileListRow + gl_WorkGroupID.x;
        if (item >= list.count) {
            return;
        }
        tile = ivec2(unpackTilePlace(list.items[item]));
    }
    ivec2 pixel = tile * int(rayTileSide) + ivec2(gl_LocalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(rayParams.view.size)))) {
        float share = imageLoad(tiles, tile).r;
        processPixel(pixel, pixelRays(share, uvec2(pixel), rayParams.view.frame), share);
    }
}
