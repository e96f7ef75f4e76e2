// Resamples a host's cube map of radiance into faces of one level of a cube array. In: the host's cube. Out: radiance ·
// alpha; alpha: the known share.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/cube_map/cube_map.glsl"
#include "effects/import/finite.glsl"
#include "effects/probe/import_probes.h"
#include "shaders/half_float.glsl"
#include "shaders/not_inlined.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ImportProbeParams params; };
uniform samplerCube hostCube;
layout(rgba16f) uniform writeonly image2DArray faces;

void main() {
    int side = imageSize(faces).x;
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(side)))) {
        return;
    }
    uint face = gl_GlobalInvocationID.z;
    int places = int(notInlined(params.places, gl_GlobalInvocationID.x));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < places * places; ++i) {
        vec2 at = cubeTexelCenter(places * texel + ivec2(i % places, i / places), places * side);
        vec4 light = textureLod(hostCube, cubeFaceDirection(at, face), params.level);
        float known = params.coverage != 0u ? clamp(orZero(light.a), 0.0, 1.0) : 1.0;
        sum += vec4(finite(light.rgb) ? clampToHalf(light.rgb) : vec3(0.0), known);
    }
    imageStore(faces, ivec3(texel, params.firstFace + face), roundToHalf(sum / float(max(places * places, 1))));
}
