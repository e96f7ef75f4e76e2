// Transforms the user interface's triangles. In: position in ImGui's coordinates, font atlas coordinates,
// sRGB colour. Out: clip-space position and the same attributes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "view/canvas.h"

layout(scalar) uniform ParamsBlock { UiParams params; };
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
layout(location = 0) out vec2 fontUv;
layout(location = 1) out vec4 tint;

void main() {
    fontUv = uv;
    tint = color;
    gl_Position = vec4(position * params.scale + params.shift, 0.0, 1.0);
}
