// Irradiance / pi of cube maps as nine spherical harmonics coefficients, one thread group per cube (Ramamoorthi and
// Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001). In: sharp (one of its mips), or
// irradiance. Out: irradiance, a row of nine texels per cube.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/cube_map/cube_map.glsl"

const uint threads = 64u;
layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { CubeIrradianceParams params; };
uniform sampler2DArray sharp;
layout(rgba32f) uniform writeonly image2D irradiance;

shared vec4 sums[threads][irradianceCoefficients];

// Factors of the cosine convolution by degree, over pi.
float cosineFactor(uint coefficient) { return coefficient == 0u ? 1.0 : coefficient < 4u ? 2.0 / 3.0 : 0.25; }

void main() {
    uint cube = params.firstCube + gl_WorkGroupID.x;
    uint thread = gl_LocalInvocationIndex;
    int side = textureSize(sharp, 0).x;
    vec4[irradianceCoefficients] own;
    for (uint c = 0u; c < irradianceCoefficients; ++c) {
        own[c] = vec4(0.0);
    }
    int texels = 6 * side * side;
    for (int i = int(thread); i < texels; i += int(threads)) {
        ivec3 at = ivec3(i % side, (i / side) % side, i / (side * side));
        vec3 n = normalize(cubeFaceDirection(cubeTexelCenter(at.xy, side), uint(at.z)));
        vec4 light = texelFetch(sharp, ivec3(at.xy, 6 * int(cube) + at.z), 0) * cubeTexelSolidAngle(at.xy, side);
        float[irradianceCoefficients] basis = sphericalHarmonics(n);
        for (uint c = 0u; c < irradianceCoefficients; ++c) {
            own[c] += light * basis[c];
        }
    }
    sums[thread] = own;
    barrier();
    if (thread < irradianceCoefficients) {
        vec4 sum = vec4(0.0);
        for (uint i = 0u; i < threads; ++i) {
            sum += sums[i][thread];
        }
        sum *= params.convolved != 0u ? 1.0 : cosineFactor(thread);
        imageStore(irradiance, ivec2(thread, cube), vec4(sum.rgb * params.scale, sum.a));
    }
}
