// Histogram of log luminance. A group of threads meters a square of 64x64 of the pixels that are metered, each thread
// 16 of them, and adds its histogram to that of the picture.
// In: radiance, depth. Out: histogram, which must have been cleared.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/exposure/exposure.h"
#include "shaders/luminance.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(scalar) uniform ParamsBlock { MeterParams params; };
uniform sampler2D radiance;  // RGBA16F, or RGBA32F if accumulated
uniform sampler2D depth;
layout(scalar) buffer HistogramBlock { uint numbers[meterSize]; } histogram;

const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;

shared uint inGroup[meterSize];

uint meterCount(uint i) { return inGroup[i]; }
#include "effects/exposure/meter.glsl"

void meterPixel(ivec2 pixel) {
    int level = meterLevel(luminance(texelFetch(radiance, pixel, 0).rgb));
    if (level >= 0) {
        uint kind = texelFetch(depth, pixel, 0).r > 0.0 ? meterSurfaces : meterBackground;
        uint bin = kind + uint(level) / levelsPerBin;
        atomicAdd(inGroup[bin], 1u);
        atomicAdd(inGroup[meterSums + bin], uint(level) % levelsPerBin);
    }
}

void main() {
    for (uint i = gl_LocalInvocationIndex; i < meterSize; i += threads) {
        inGroup[i] = 0u;
    }
    barrier();
    for (uint i = 0u; i < 16u; ++i) {
        uvec2 metered = gl_WorkGroupID.xy * 64u + gl_LocalInvocationID.xy + 16u * uvec2(i % 4u, i / 4u);
        uvec2 pixel = metered * params.step + params.step / 2u;
        if (all(lessThan(pixel, params.size))) {
            meterPixel(ivec2(pixel));
        }
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < meterSize; i += threads) {
        if (inGroup[i] > 0u) {
            atomicAdd(histogram.numbers[i], inGroup[i]);
        }
    }
}
