// Kernels for denoising soft shadows: which neighbours lie on the same surface as a pixel, and their weights.
#ifndef REFLET_SHADOW_KERNEL_GLSL
#define REFLET_SHADOW_KERNEL_GLSL

#include "shaders/projection.glsl"

// Largest slope of a surface: a neighbour counts as on the same surface if its height over the pixel's plane, up or
// down, is below this times its distance across the view.
const float surfaceSlope = 0.25;

// The tangent plane at a pixel. onSurface tests whether a neighbour, `o` pixels away and `depthStep` deeper, lies on
// it. Heights are in units of the tolerance one pixel away.
struct ScreenPlane {
    vec2 perPixel;   // change of height for a step of one pixel at equal depth
    float perDepth;  // change of height for a step in depth
};

ScreenPlane screenPlane(vec3 p, vec3 n, mat4 clipToWorld, vec2 pixelSize, float pixelAngle) {
    vec4 plane = planeOnScreen(p, n, clipToWorld) * (1.0 / (surfaceSlope * pixelAngle));
    return ScreenPlane(plane.xy * pixelSize, plane.z);
}

float heightAbove(ScreenPlane plane, vec2 o, float depthStep) {
    return dot(plane.perPixel, o) + plane.perDepth * depthStep;
}

bool onSurface(ScreenPlane plane, vec2 o, float depthStep) {
    float height = heightAbove(plane, o, depthStep);
    return height * height <= max(dot(o, o), 1.0);
}

// Symmetric 2x2 matrices as (xx, xy, yy).
float quadratic(vec3 m, vec2 o) { return dot(m, vec3(o.x * o.x, 2.0 * o.x * o.y, o.y * o.y)); }
vec3 inverseSymmetric(vec3 m) { return vec3(m.z, -m.y, m.x) / max(m.x * m.z - m.y * m.y, 1e-20); }

// Squared distance in metres, perpendicular to the sun's direction, between a pixel and its neighbours on the surface:
// a quadratic form of the offset in pixels.
vec3 metresAcross(vec2 uv, float depth, ScreenPlane plane, mat4 clipToWorld, vec2 pixelSize, vec3 toSun) {
    vec4 h = clipToWorld * vec4(uvToNdc(uv), depth, 1.0);
    vec3 p = h.xyz / h.w;
    float perDepth = plane.perDepth < 0.0 ? min(plane.perDepth, -1e-6) : max(plane.perDepth, 1e-6);
    vec2 depthStep = -plane.perPixel / perDepth;
    vec4 stepX = clipToWorld[0] * (2.0 * pixelSize.x) + clipToWorld[2] * depthStep.x;
    vec4 stepY = clipToWorld[1] * (2.0 * pixelSize.y) + clipToWorld[2] * depthStep.y;
    vec3 x = (stepX.xyz - p * stepX.w) / h.w;
    vec3 y = (stepY.xyz - p * stepY.w) / h.w;
    x -= dot(x, toSun) * toSun;
    y -= dot(y, toSun) * toSun;
    return vec3(dot(x, x), dot(x, y), dot(y, y));
}

// Similarity of two visibility estimates of `samples` samples each: 1 equal, 0 a difference that noise cannot explain.
// Noise falls a little faster than 1 / sqrt(samples); with 16 samples a difference of 0.25 is more than noise.
float similarity(float difference, uint samples) {
    float unlike = 0.5 * pow(float(samples), 0.75) * difference;
    return max(1.0 - unlike * unlike, 0.0);
}

#endif
