// Offsets of ray origins from surfaces, against self-intersection.
#ifndef REFLET_CLEARANCE_GLSL
#define REFLET_CLEARANCE_GLSL

#include "shaders/subpixel.glsl"

// Offset from a surface, to compensate for rounded coordinates.
const float relativeClearance = 4e-6;

// The same for a point reconstructed from depth, `away` metres in front of the camera: depth and geometric normal are
// rounded as well. Orthographic depth is rounded to about 1e-7 of the far distance. width: of the pixel there [m].
float clearanceOfPixel(vec3 p, float away, vec4 depthToDistance, float width) {
    vec3 size = abs(p);
    float ofDepth = max(4e-7 * abs(depthToDistance.y), subpixel * width);
    return max(4.0 * relativeClearance * max(max(size.x, size.y), max(size.z, away)), ofDepth);
}

#endif
