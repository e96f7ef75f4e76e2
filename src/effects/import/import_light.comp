// Copies radiance into half floats, finite and bounded. In: the host's image; limits of bound_light.h. Out: RGBA16F, of
// the same size.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/import/bounded.glsl"
#include "effects/import/finite.glsl"
#include "effects/import/import.h"

layout(constant_id = 0) const uint keepAlpha = 0u;
layout(constant_id = 1) const uint bounded = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ImportLightParams params; };
uniform sampler2D hostLight;
layout(r32f) uniform readonly image2D limits;
layout(rgba16f) uniform writeonly image2D light;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.size)))) {
        return;
    }
    vec4 texel = texelFetch(hostLight, pixel + ivec2(params.origin), 0);
    vec3 radiance = finite(texel.rgb) ? texel.rgb : vec3(0.0);
    float limit = params.maxRadiance;
    if (bounded != 0u) {
        limit = min(limit, imageLoad(limits, pixel / int(boundTileSide)).r);
    }
    float alpha = keepAlpha != 0u ? clamp(orZero(texel.a), 0.0, largestHalf) : 1.0;
    imageStore(light, pixel, vec4(boundedLuminance(radiance, limit), alpha));
}
