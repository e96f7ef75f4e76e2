// Splits the picture at half resolution. In: radiance, circle of confusion. Out: background and near layer.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/depth_of_field.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };

#include "effects/depth_of_field/dof_picture.glsl"

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(cell, ivec2(params.half2)))) {
        splitCell(cell, 0.0);
    }
}
