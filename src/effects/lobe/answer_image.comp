// Gives waiting rays the light that a host's image has at their pixel. In: the list, the image. Out: results, sources,
// the list of remaining rays.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/answer_image.h"
#include "effects/lobe/rays.glsl"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { AnswerImageParams params; };
uniform sampler2D light;
#include "effects/lobe/rays_waiting.glsl"
layout(rgba16f) uniform image2DArray answer;
layout(rgba8) uniform image2DArray source;
#include "effects/lobe/rays_answer.glsl"
#include "effects/lobe/rays_append.glsl"

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    for (uint i = gl_GlobalInvocationID.x; i < waiting.count; i += stride) {
        WaitingRay w = unpackWaitingRay(waiting.items[i]);
        if (!isKnownMiss(w)) {
            ivec2 pixel = w.slot.xy * int(params.scale) + int(params.blockOffset);
            vec4 seen = texelFetch(light, pixel, 0);
            w.rest = addAnswer(w.slot, RayAnswer(seen.rgb * params.factor, seen.a, params.distance), w.rest, sourceProbe);
        }
        if (w.rest > 0.0) {
            appendRay(w);
        }
    }
}
