// Gives every remaining ray the environment's radiance: along its direction, or prefiltered by its lobe (Ray.spread).
// In: the list, directions, material, the environment. Out: answers, sources.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/rays.glsl"
#include "effects/environment/environment_lobes.glsl"

layout(constant_id = 0) const uint lobe = 0u;

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { AnswerEnvironmentParams params; };
uniform sampler2D material;
#include "effects/lobe/rays_waiting.glsl"
layout(rgba16f) uniform image2DArray answer;
layout(rgba8) uniform image2DArray source;
layout(rg32ui) uniform readonly uimage2DArray direction;
#include "effects/lobe/rays_answer.glsl"

vec3 radianceFor(Ray ray) {
    if (params.settings.enabled == 0u) {
        return vec3(0.0);
    }
    if (ray.spread == 0.0) {
        return environmentRadiance(ray.direction);
    }
    return lobe == lobeDiffuse ? environmentIrradianceOverPi(ray.direction) : environmentLobe(ray.direction, ray.spread);
}

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    for (uint i = gl_GlobalInvocationID.x; i < waiting.count; i += stride) {
        WaitingRay ray = unpackWaitingRay(waiting.items[i]);
        // Occlusion maps stand for nearby geometry; they are ignored for rays that ray tracing has found to be
        // unoccluded.
        float occlusion = lobe == lobeDiffuse && !isKnownMiss(ray) ? texelFetch(material, ray.slot.xy, 0).b : 1.0;
        vec3 radiance = radianceFor(unpackRay(imageLoad(direction, ray.slot).xy));
        float share = occlusion * (ray.lost ? params.settings.occludedWeight : 1.0);
        RayAnswer a = RayAnswer(radiance * share, 1.0, environmentDistance);
        addAnswer(ray.slot, a, ray.rest, sourceEnvironment);
    }
}
