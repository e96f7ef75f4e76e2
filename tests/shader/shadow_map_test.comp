// Look-ups of points in an analytic shadow map: each texel's centre holds the surface nearest to the sun.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/octahedral.glsl"
#include "shadow_map_test.h"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { ShadowScene params; };
layout(scalar) readonly buffer InputBlock { ShadowCase items[]; } inputs;
layout(scalar) buffer OutputBlock { float items[]; } outputs;

// Depth of a plane along the sun's ray from `low` (depth 0) to `high` (depth 1).
float depthOf(vec4 plane, vec3 low, vec3 high) {
    return -dot(plane, vec4(low, 1.0)) / dot(plane.xyz, high - low);
}

float loadShadowDepth(ivec2 texel) {
    vec2 xy = 2.0 * (vec2(texel) + 0.5) / float(params.resolution) - 1.0;
    vec3 low = (params.shadowToWorld * vec4(xy, 0.0, 1.0)).xyz;
    vec3 high = (params.shadowToWorld * vec4(xy, 1.0, 1.0)).xyz;
    float depth = depthOf(params.receiver, low, high);
    if (params.occluder != vec4(0.0)) {
        float occluder = depthOf(params.occluder, low, high);
        if (dot(params.occluderEdge, vec4(mix(low, high, occluder), 1.0)) < 0.0) {
            depth = max(depth, occluder);
        }
    }
    return depth;
}
#include "shaders/shadow_map.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    ShadowCase c = inputs.items[i];
    ShadowTile tile = ShadowTile(ivec2(0), ivec2(params.resolution));
    if (params.constant != 0u) {
        outputs.items[i] = hardVisibility(constantReceiver(c.point, params.map, tile, params.bias));
        return;
    }
    vec3 n = params.packedNormal != 0u ? unpackUnitVector(packUnitVector(c.normal)) : c.normal;
    outputs.items[i] = dot(n, params.map.toSun) > 0.0 ? hardVisibility(slopeReceiver(c.point, n, params.map, tile, params.bias, rounding(c.point))) : 0.0;
}
