// Object motion, and the motion of mirror images.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "object_motion_test.h"
#include "effects/view.h"
#include "shaders/object_motion.glsl"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock {
    ViewParams params;
};
layout(scalar) readonly buffer InputBlock {
    MirroredThing items[];
}
inputs;
layout(scalar) buffer OutputBlock {
    ObjectMotion items[];
}
outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    MirroredThing t = inputs.items[i];
    ObjectMotion o;
    o.displacement = objectDisplacement(t.thing, t.uv, t.motion, params.previousWorldToClip, params.viewPlane.xyz);
    o.ofImage = mirroredMotion(t.mirror, directionToEye(t.mirror, params.eye), normalize(t.thing - t.mirror),
                               distance(t.thing, t.mirror), o.displacement, params.previousWorldToClip);
    outputs.items[i] = o;
}
