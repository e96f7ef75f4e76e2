// Brings a lamp's cube map of depth or distance into tiles of Reflet's atlas. In: the host's cube. Out: near / distance
// along the tile's axis, 0: nothing.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/import/finite.glsl"
#include "effects/shadow/import_lamp_map.h"
#include "shaders/not_inlined.glsl"

layout(scalar) uniform ParamsBlock { ImportLampParams params; };
uniform samplerCube hostMap;

float metresAlong(vec3 direction) {
    float stored = textureLod(hostMap, direction, 0.0).r;
    uint depth = notInlined(params.depth, gl_GlobalInvocationID.x);
    if (depth == lampDistance) {
        return stored * params.distanceScale / length(direction);
    }
    vec3 a = abs(direction);
    float axis = max(max(a.x, a.y), a.z);  // the face's component of the direction
    float nearness = depth == lampDepthReversed ? stored : 1.0 - stored;  // 1 near, 0 far
    float metres = 1.0 / mix(1.0 / params.farPlane, 1.0 / params.nearPlane, nearness);
    return nearness <= 0.0 ? 0.0 : metres / axis;
}
#include "effects/shadow/import_lamp_map.glsl"
