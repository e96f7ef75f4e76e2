// Shades the user interface's pixels, blended over the display-encoded images. In: texture coordinates in the font
// atlas, colour. Out: the window.
#version 460

uniform sampler2D font;
layout(location = 0) in vec2 fontUv;
layout(location = 1) in vec4 tint;
layout(location = 0) out vec4 window;

void main() { window = tint * texture(font, fontUv); }
