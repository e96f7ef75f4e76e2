// Luminance of linear Rec. 709 colours. C++ too, see tone_curves.glsl.
#ifndef REFLET_LUMINANCE_GLSL
#define REFLET_LUMINANCE_GLSL

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

#endif
