// Gives every remaining ray the environment's radiance: along its direction, or prefiltered by its lobe (Ray.spread).
// In: the list, directions, material, the environment. Out: answers, sources.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/rays.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 10) const uint spreads = 0u;
layout(constant_id = 11) const uint environmentLights = 0u;

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { AnswerEnvironmentParams environmentAnswer; };
uniform sampler2D material;
#include "effects/lobe/rays_waiting.glsl"
layout(rgba16f) uniform image2DArray answer;
layout(rgba8) uniform image2DArray source;
layout(rg32ui) uniform readonly uimage2DArray direction;
#include "effects/ambient_occlusion/ambient_visibility.glsl"
#include "effects/lobe/environment_answer.glsl"
#include "effects/lobe/rays_answer.glsl"

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    for (uint i = gl_GlobalInvocationID.x; i < waiting.count; i += stride) {
        WaitingRay w = unpackWaitingRay(waiting.items[i]);
        float occlusion = lobe == lobeDiffuse && !isKnownMiss(w) ? texelFetch(material, w.slot.xy, 0).b : 1.0;
        Ray ray = unpackRay(imageLoad(direction, w.slot).xy);
        occlusion = min(occlusion, ambientVisibility(w.slot.xy, ray));
        RayAnswer a = answerOfEnvironment(ray, occlusion, w.lost, w.inFront);
        addAnswer(w.slot, a, w.rest, sourceEnvironment);
    }
}
