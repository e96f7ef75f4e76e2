// Writes a host's spherical harmonics of irradiance / pi into the row of one cube. Out: irradiance of CubeMap.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/probe/import_probes.h"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { ImportHarmonicsParams params; };
layout(rgba32f) uniform writeonly image2D irradiance;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < irradianceCoefficients) {
        imageStore(irradiance, ivec2(i, params.cube), params.coefficients[i]);
    }
}
