// Morph targets and linear blend skinning. In: vertices in bind pose, joints and weights of this frame and the last. Out:
// positions of both frames, normals and tangents, later in the same buffers: in world space, without a skin in object
// space.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/skin/skin.h"

// VertexAttributes (scene/scene.h).
struct Attributes {
    vec3 normal;
    vec4 tangent;
    vec2 uv0;
    vec2 uv1;
    uvec2 color;
};

// scene/animation.h
struct MorphDelta {
    uint target;
    vec3 position;
    vec3 normal;
    vec3 tangent;
};

layout(local_size_x = 128) in;
layout(constant_id = 1) const uint morphed = 0u;  // 1: some vertices have morph targets
layout(scalar) uniform ParamsBlock { SkinParams params; };
layout(scalar) readonly buffer VertexBlock { SkinnedVertex items[]; } vertices;
layout(scalar) readonly buffer JointWeightBlock { SkinnedWeight items[]; } jointWeights;
layout(scalar) readonly buffer JointBlock { mat4x3 items[]; } joints;
layout(scalar) buffer PositionBlock { vec3 items[]; } positions;
layout(scalar) writeonly buffer PreviousPositionBlock { vec3 items[]; } previousPositions;
layout(scalar) buffer AttributeBlock { Attributes items[]; } attributes;
layout(scalar) readonly buffer MorphBlock { MorphedVertex items[]; } morphs;
layout(scalar) readonly buffer DeltaBlock { MorphDelta items[]; } deltas;
layout(scalar) readonly buffer WeightBlock { float items[]; } morphWeights;

mat4x3 toWorld(SkinnedVertex v, uint firstJoint) {
    if (v.jointCount == 0u) {
        return mat4x3(1.0);
    }
    mat4x3 sum = mat4x3(0.0);
    for (uint i = v.firstJoint; i < v.firstJoint + v.jointCount; ++i) {
        SkinnedWeight moved = jointWeights.items[i];
        sum += moved.weight * joints.items[firstJoint + moved.joint];
    }
    return sum;
}

vec3 unitOr(vec3 v, vec3 otherwise) {
    float square = dot(v, v);
    return square > 0.0 && !isinf(square) ? v * inversesqrt(square) : otherwise;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= params.count) {
        return;
    }
    SkinnedVertex v = vertices.items[i];
    uint target = params.firstVertex + i;
    vec3 position = positions.items[v.source];
    vec3 previous = position;
    vec3 normal = attributes.items[v.source].normal;
    vec4 tangent = attributes.items[v.source].tangent;
    if (morphed != 0u) {
        MorphedVertex m = morphs.items[i];
        for (uint k = m.firstDelta; k < m.firstDelta + m.deltaCount; ++k) {
            MorphDelta delta = deltas.items[k];
            uint at = m.firstWeight + delta.target;
            float weight = morphWeights.items[at];
            position += weight * delta.position;
            previous += morphWeights.items[params.weightCount + at] * delta.position;
            normal += weight * delta.normal;
            tangent.xyz += weight * delta.tangent;
        }
        normal = unitOr(normal, attributes.items[v.source].normal);
        tangent.xyz = unitOr(tangent.xyz, attributes.items[v.source].tangent.xyz);
    }
    mat4x3 now = toWorld(v, 0u);
    positions.items[target] = now * vec4(position, 1.0);
    previousPositions.items[target] = toWorld(v, params.jointCount) * vec4(previous, 1.0);
    mat3 m = mat3(now);
    // Cofactor matrix: the inverse transpose times the determinant, whose sign is removed below.
    mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    float handedness = dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
    attributes.items[target].normal = unitOr(handedness * (cofactors * normal), normal);
    attributes.items[target].tangent = vec4(unitOr(m * tangent.xyz, tangent.xyz), handedness * tangent.w);
}
