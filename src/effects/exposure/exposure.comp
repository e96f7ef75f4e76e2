// The exposure that this frame's histogram asks for, and its mean with those of the last frames. One group.
// In: histogram; the last frame's exposures. Out: this frame's.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/exposure/exposure.h"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { ExposureParams params; };
layout(scalar) readonly buffer HistogramBlock { uint numbers[meterSize]; } histogram;
layout(rg32f) uniform readonly image2D previous;
layout(rg32f) uniform writeonly image2D next;

shared uint numbers[meterSize];

uint meterCount(uint i) { return numbers[i]; }
#include "effects/exposure/meter.glsl"

float weightOf(float age) {
    return params.adaptation > 0.0 ? exp(-age / params.adaptation) : 0.0;
}

void main() {
    for (uint i = gl_LocalInvocationIndex; i < meterSize; i += gl_WorkGroupSize.x) {
        numbers[i] = histogram.numbers[i];
    }
    barrier();
    if (gl_LocalInvocationIndex > 0u) {
        return;
    }
    float own = meteredExposure() + params.preExposure;
    imageStore(next, ivec2(0), vec4(own, 0.0, 0.0, 0.0));
    float sum = own;
    float weights = 1.0;
    for (int i = 1; i < int(exposureFrames); ++i) {
        vec2 past = params.hasPrevious != 0u ? imageLoad(previous, ivec2(i - 1, 0)).rg : vec2(0.0, -1.0);
        if (past.y >= 0.0) {
            past.y += params.elapsed;
            sum += past.x * weightOf(past.y);
            weights += weightOf(past.y);
        }
        imageStore(next, ivec2(i, 0), vec4(past, 0.0, 0.0));
    }
    imageStore(next, ivec2(exposureFrames, 0), vec4(sum / weights, 0.0, 0.0, 0.0));
}
