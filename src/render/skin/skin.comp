// Linear blend skinning. In: vertices in bind pose, joints of this frame and the last. Out: positions of both frames,
// normals and tangents in world space, later in the same buffers.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/skin/skin.h"

// VertexAttributes (scene/scene.h).
struct Attributes {
    vec3 normal;
    vec4 tangent;
    vec2 uv0;
    vec2 uv1;
    uvec2 color;
};

layout(local_size_x = 128) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { SkinParams params; };
layout(set = 0, binding = 1, scalar) readonly buffer VertexBlock { SkinnedVertex items[]; } vertices;
layout(set = 0, binding = 2, scalar) readonly buffer JointBlock { mat4x3 items[]; } joints;
layout(set = 0, binding = 3, scalar) buffer PositionBlock { vec3 items[]; } positions;
layout(set = 0, binding = 4, scalar) writeonly buffer PreviousPositionBlock { vec3 items[]; } previousPositions;
layout(set = 0, binding = 5, scalar) buffer AttributeBlock { Attributes items[]; } attributes;

mat4x3 toWorld(SkinnedVertex v, uint firstJoint) {
    mat4x3 sum = mat4x3(0.0);
    for (int i = 0; i < 4; ++i) {
        sum += v.weights[i] * joints.items[firstJoint + v.joints[i]];
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
    vec4 position = vec4(positions.items[v.source], 1.0);
    mat4x3 now = toWorld(v, 0u);
    positions.items[target] = now * position;
    previousPositions.items[target] = toWorld(v, params.jointCount) * position;
    mat3 m = mat3(now);
    // Cofactor matrix: the inverse transpose times the determinant, whose sign is removed below.
    mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    float handedness = dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
    vec3 normal = attributes.items[v.source].normal;
    vec4 tangent = attributes.items[v.source].tangent;
    attributes.items[target].normal = unitOr(handedness * (cofactors * normal), normal);
    attributes.items[target].tangent = vec4(unitOr(m * tangent.xyz, tangent.xyz), handedness * tangent.w);
}
