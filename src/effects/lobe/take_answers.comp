// A host's answers as a ray source (missed_rays.h). In: the list of rays, answers in its order. Out: results, sources,
// the list of remaining rays.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/missed_rays.h"
#include "effects/lobe/rays.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer AnswersBlock { HostAnswer items[]; } answers;
#include "effects/lobe/rays_waiting.glsl"
layout(rgba16f) uniform image2DArray answer;
layout(rgba8) uniform image2DArray source;
#include "effects/lobe/rays_answer.glsl"
#include "effects/lobe/rays_append.glsl"

// What is not finite counts as not answered.
RayAnswer answerOf(HostAnswer given) {
    bool finite = !any(isnan(given.radiance)) && !any(isinf(given.radiance));
    bool hits = given.hitDistance >= 0.0;  // false for NaN, too
    float confidence = finite && hits && given.confidence > 0.0 ? min(given.confidence, 1.0) : 0.0;
    return RayAnswer(given.radiance, confidence, hits ? min(given.hitDistance, largestHalf) : 0.0);
}

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    for (uint i = gl_GlobalInvocationID.x; i < waiting.count; i += stride) {
        WaitingRay w = unpackWaitingRay(waiting.items[i]);
        HostAnswer given = answers.items[i];
        if (given.hitDistance < 0.0) {
            w.lost = false;
            w.clear = largestHalf;  // known to hit nothing
        }
        w.rest = addAnswer(w.slot, answerOf(given), w.rest, sourceScene);
        if (w.rest > 0.0) {
            appendRay(w);
        }
    }
}
