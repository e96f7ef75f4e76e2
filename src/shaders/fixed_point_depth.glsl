// Emulates a fixed-point standard depth buffer: 0 at the near plane, 1 at a far plane, evenly spaced integers.
#ifndef REFLET_FIXED_POINT_DEPTH_GLSL
#define REFLET_FIXED_POINT_DEPTH_GLSL

// Quantizes a reversed depth (0: sky) like a standard depth buffer of integers from 0 to `steps`, rounded to nearest.
// farDepth: the reversed depth at the far plane; anything beyond is clamped to it.
// Standard depth is 1 - (depth - farDepth) / (1 - farDepth). Rounding its complement gives the same integers, and
// avoids the cancellation of floats near 1.
float fixedPointDepth(float depth, float farDepth, float steps) {
    if (depth <= 0.0) {
        return 0.0;
    }
    float lacking = clamp((depth - farDepth) / (1.0 - farDepth), 0.0, 1.0);
    float kept = round(lacking * steps) / steps;
    return max(mix(farDepth, 1.0, kept), 1e-12);  // orthographic: 0 would mean sky
}

#endif
