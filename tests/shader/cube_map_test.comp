// Looks up a filtered cube map.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "cube_map_test.h"
#include "effects/cube_map/cube_map.glsl"

layout(local_size_x = 64) in;
layout(scalar) readonly buffer InputBlock { CubeLookup items[]; } inputs;
layout(scalar) buffer OutputBlock { CubeLight items[]; } outputs;
uniform samplerCubeArray sharp;
uniform samplerCubeArray lobes;
uniform sampler2D irradiance;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < outputs.items.length()) {
        CubeLookup at = inputs.items[i];
        outputs.items[i] = CubeLight(textureLod(sharp, vec4(at.direction, float(at.cube)), 0.0).rgb,
                                     cubeMapLobe(lobes, at.cube, at.direction, at.roughness),
                                     cubeMapIrradiance(irradiance, at.cube, at.direction));
    }
}
