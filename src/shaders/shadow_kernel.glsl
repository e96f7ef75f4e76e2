// Kernels that clean soft shadows: which neighbours lie on a pixel's surface, and how much each counts.
#ifndef REFLET_SHADOW_KERNEL_GLSL
#define REFLET_SHADOW_KERNEL_GLSL

#include "shaders/projection.glsl"

// A neighbour lies on the same surface if it rises above or sinks below the pixel's plane by less than this for each
// unit that it is away across the view.
const float surfaceSlope = 0.25;

// The plane of a pixel's surface: a neighbour o pixels away with depth d lies on it where onSurface holds.
struct ScreenPlane {
    vec2 perPixel;   // height from a step of a pixel at equal depth, in units of what is allowed one pixel away
    float perDepth;  // height from a step in depth, in the same units
};

ScreenPlane screenPlane(vec3 p, vec3 n, mat4 clipToWorld, vec2 pixelSize, float pixelAngle) {
    vec4 plane = planeOnScreen(p, n, clipToWorld) * (1.0 / (surfaceSlope * pixelAngle));
    return ScreenPlane(plane.xy * pixelSize, plane.z);
}

float heightAbove(ScreenPlane plane, vec2 o, float depthStep) {
    return dot(plane.perPixel, o) + plane.perDepth * depthStep;
}

bool onSurface(ScreenPlane plane, vec2 o, float depthStep) {
    return abs(heightAbove(plane, o, depthStep)) <= max(length(o), 1.0);
}

// Symmetric 2x2 matrices as (xx, xy, yy).
float quadratic(vec3 m, vec2 o) { return dot(m, vec3(o.x * o.x, 2.0 * o.x * o.y, o.y * o.y)); }
vec3 inverseSymmetric(vec3 m) { return vec3(m.z, -m.y, m.x) / max(m.x * m.z - m.y * m.y, 1e-20); }

// Squared metres across the sun's direction between a pixel and its neighbours on the surface, as a quadratic form of
// the step in pixels.
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

// Whether two visibilities of so many samples may differ by noise alone: 1 the same, 0 they cannot. Noise falls a little
// faster than the root of their number; of 16 samples a difference of 0.25 is more than noise.
float likeness(float difference, uint samples) {
    float unlike = 0.5 * pow(float(samples), 0.75) * difference;
    return max(1.0 - unlike * unlike, 0.0);
}

#endif
