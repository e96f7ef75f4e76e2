// Gives every waiting ray the environment's radiance. In: the list, material. Out: answers, sources.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/bounce/answer_environment.h"
#include "render/bounce/rays.glsl"

layout(constant_id = 0) const uint lobe = 0u;

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { AnswerEnvironmentParams params; };
layout(set = 0, binding = 1) uniform sampler2D material;
layout(set = 0, binding = 2, scalar) readonly buffer WaitingBlock {
    uint groups[3];
    uint count;
    RayItem items[];
} waiting;
layout(set = 0, binding = 3, rgba16f) uniform image2DArray answer;
layout(set = 0, binding = 4, rgba8) uniform image2DArray source;
#include "render/bounce/rays_answer.glsl"

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    for (uint i = gl_GlobalInvocationID.x; i < waiting.count; i += stride) {
        WaitingRay ray = unpackWaitingRay(waiting.items[i]);
        // Occlusion maps know of nearby surfaces, which a ray may be known not to meet.
        float occlusion = lobe == lobeDiffuse && !meetsNothing(ray) ? texelFetch(material, ray.slot.xy, 0).b : 1.0;
        RayAnswer a = RayAnswer(params.radiance * occlusion * (ray.lost ? params.settings.lostShare : 1.0), 1.0, environmentDistance);
        addAnswer(ray.slot, a, ray.rest, sourceEnvironment);
    }
}
