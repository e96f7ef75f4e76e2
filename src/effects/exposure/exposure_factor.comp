// The smoothed exposure as a factor on radiance. In: exposure, of exposure.comp. Out: one texel.
#version 460
#include "effects/exposure/exposure.h"

layout(local_size_x = 1) in;
layout(rg32f) uniform readonly image2D exposure;
layout(r32f) uniform writeonly image2D factor;

void main() { imageStore(factor, ivec2(0), vec4(exp2(imageLoad(exposure, ivec2(exposureFrames, 0)).r))); }
