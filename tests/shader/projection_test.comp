// Projects world points to the screen and back, as passes do it.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/view.h"
#include "shaders/projection.glsl"
#include "projection_test.h"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { ViewParams params; };
layout(scalar) readonly buffer InputBlock { vec3 items[]; } inputs;
layout(scalar) buffer OutputBlock { ProjectedPoint items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    vec3 p = inputs.items[i];
    vec4 clip = params.worldToClip * vec4(p, 1.0);
    ProjectedPoint o;
    o.uv = ndcToUv(clip.xy / clip.w);
    o.depth = clip.z / clip.w;
    o.distance = depthToViewDistance(o.depth, params.depthToDistance);
    o.back = uvToWorld(o.uv, o.depth, params.clipToWorld);
    o.toEye = directionToEye(p, params.eye);
    o.above = dot(planeOnScreen(planePoint, planeNormal, params.clipToWorld), vec4(o.uv, o.depth, 1.0));
    outputs.items[i] = o;
}
