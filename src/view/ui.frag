// Shades the user interface's pixels, blended over the display-encoded images. In: texture coordinates in the font
// atlas, colour. Out: the window.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "view/canvas.h"

layout(scalar) uniform ParamsBlock { UiParams params; };
uniform sampler2D font;
layout(location = 0) in vec2 fontUv;
layout(location = 1) in vec4 tint;
layout(location = 0) out vec4 window;

void main() {
    vec4 color = tint * texture(font, fontUv);
    window = params.swapped != 0u ? color.bgra : color;
}
