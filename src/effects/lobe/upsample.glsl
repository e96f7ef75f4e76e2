// Joint bilateral upsampling of light that was traced for one pixel of each block (after Kopf et al., Joint Bilateral
// Upsampling, 2007): the four traced pixels around a pixel, weighted by how well their surfaces match its own.
#ifndef REFLET_UPSAMPLE_GLSL
#define REFLET_UPSAMPLE_GLSL

#include "shaders/shadow_kernel.glsl"

// A pixel and its surface.
struct Shown {
    ivec2 pixel;
    float depth;
    vec3 normal;
    ScreenPlane plane;
};

// The four low-resolution pixels around a pixel and their weights.
struct Blocks {
    ivec2 corner;
    vec4 weights;  // bilinear
};

// place: of the traced pixel within its block. shift: LobeLight.shift.
Blocks blocksAt(Shown shown, uint scale, uint place, vec2 shift, ivec2 size) {
    vec2 at = (vec2(shown.pixel - int(place)) + shift) / float(scale);
    Blocks b;
    b.corner = clamp(ivec2(floor(at)), ivec2(0), max(size - 2, ivec2(0)));
    vec2 f = clamp(at - vec2(b.corner), vec2(0.0), vec2(1.0));
    b.weights = vec4(1.0 - f.x, f.x, 1.0 - f.x, f.x) * vec4(1.0 - f.yy, f.yy);
    return b;
}

ivec2 blockAt(Blocks b, int i, ivec2 size) { return min(b.corner + ivec2(i & 1, i >> 1), size - 1); }

// How well a block's surface matches the pixel's plane, 0..1.
float onSameSurface(Shown shown, vec2 away, float blockDepth) {
    float length2 = max(dot(away, away), 1.0);
    float height = heightAbove(shown.plane, away, blockDepth - shown.depth);
    float height2 = height * height;
    float length4 = length2 * length2;
    return length4 / (length4 + height2 * height2);
}

// Weights never reach 0, so a pixel without a matching neighbour still gets the average.
float weighed(float share, float same, float blockDepth) {
    return blockDepth > 0.0 ? share * (same + 1e-4) + 1e-7 : 0.0;
}

// Edge-stopping weight by normals, wider for light that is adapted to the normal (directional_light.glsl).
float facingLike(vec3 blockNormal, vec3 normal, bool turns) {
    float facing = max(dot(blockNormal, normal), 0.0);
    float facing2 = facing * facing;
    float facing4 = facing2 * facing2;
    return turns ? facing2 : facing4 * facing4;
}

#endif
