// Standard depth in fixed point: 0 at the near plane, 1 at a far plane, evenly spaced whole numbers.
#ifndef REFLET_FIXED_POINT_DEPTH_GLSL
#define REFLET_FIXED_POINT_DEPTH_GLSL

// Reversed depth (0: sky) after it has been such a number from 0 to `steps`, rounded to the nearest. farDepth: the
// reversed depth at the far plane; what lies beyond is moved there.
// Standard depth is 1 - (depth - farDepth) / (1 - farDepth). Rounding what it lacks of 1 gives the same whole numbers,
// and keeps floats out of the range where standard depth has lost its digits to the 1.
float fixedPointDepth(float depth, float farDepth, float steps) {
    if (depth <= 0.0) {
        return 0.0;
    }
    float lacking = clamp((depth - farDepth) / (1.0 - farDepth), 0.0, 1.0);
    float kept = round(lacking * steps) / steps;
    return max(mix(farDepth, 1.0, kept), 1e-12);  // orthographic: 0 would be the sky
}

#endif
