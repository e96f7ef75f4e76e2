// Trilinear lookup of radiance blurred to a given width. The includer first defines vec3 loadLight(ivec2 cell, int
// level), which reads the image (level 0) or its mips.
#ifndef REFLET_LIGHT_MIPS_GLSL
#define REFLET_LIGHT_MIPS_GLSL

#include "effects/levels.glsl"

// at: in pixels of level 0, (0.5, 0.5) is the first one's centre. Clamped at the edges.
vec3 lightOfLevel(vec2 at, int level, ivec2 pixels) {
    vec2 cell = at / float(1 << level) - 0.5;
    vec2 part = fract(cell);
    ivec2 last = levelSize(pixels, level) - 1;
    ivec2 a = clamp(ivec2(floor(cell)), ivec2(0), last);
    ivec2 b = clamp(ivec2(floor(cell)) + 1, ivec2(0), last);
    vec3 top = mix(loadLight(a, level), loadLight(ivec2(b.x, a.y), level), part.x);
    vec3 bottom = mix(loadLight(ivec2(a.x, b.y), level), loadLight(b, level), part.x);
    return mix(top, bottom, part.y);
}

// Radiance around `at`, blurred over `width` pixels.
vec3 blurredLight(vec2 at, float width, ivec2 pixels) {
    int top = findMSB(max(pixels.x, pixels.y) - 1) + 1;  // one cell; findMSB(0) is -1
    float level = clamp(log2(max(width, 1.0)), 0.0, float(top));
    int finer = int(level);
    float part = level - float(finer);
    vec3 fine = lightOfLevel(at, finer, pixels);
    return part > 0.0 ? mix(fine, lightOfLevel(at, finer + 1, pixels), part) : fine;
}

#endif
