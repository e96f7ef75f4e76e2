// Marches one ray through the depth buffer by the method and options of the settings. The includer defines what
// march.glsl and march_hiz.glsl require.
#ifndef REFLET_TRACE_RAY_GLSL
#define REFLET_TRACE_RAY_GLSL

#include "effects/lobe/trace_screen.h"
#include "effects/pyramid/pyramid.h"
#include "shaders/march_hiz.glsl"
#include "shaders/march_world.glsl"

MarchOptions marchOptions(TraceScreenSettings s, float longest, uint secondLayer, float jitter) {
    return MarchOptions(s.step, s.minStep, s.stride, longest, jitter, s.maxSteps, s.thickness,
                        s.thicknessMode == ThicknessMode_step, secondLayer != 0u, s.binarySteps, s.interpolate != 0u,
                        int(pyramidLevels), s.firstSteps);
}

MarchResult marchBy(uint method, MarchRay ray, MarchOptions o, MarchView view) {
    switch (method) {
        case TraceMethod_halving:
            return marchHalving(ray, o, view);
        case TraceMethod_fixedPoint:
            return marchFixedPoint(ray, o, view);
        case TraceMethod_dda:
            return marchDda(ray, o, view);
        case TraceMethod_exhaustive:
            return marchExhaustive(ray, o, view);
        case TraceMethod_hiz:
            return marchHiz(ray, o, view);
        default:
            return marchLinear(ray, o, view);
    }
}

// Confidence of a hit, 0..1, then its factors: fade at the screen's edge, at the maximum distance, toward the camera.
vec4 fadeOf(MarchResult hit, vec3 p, vec3 direction, TraceScreenSettings s, float longest, ViewParams view) {
    vec2 uv = pixelToUv(hit.pixel, view.pixel);
    vec2 inside = min(uv, 1.0 - uv);
    float edge = clamp(min(inside.x, inside.y) / max(s.edgeFade, 1e-6), 0.0, 1.0);
    float near = clamp((1.0 - hit.distance / longest) / max(s.distanceFade, 1e-6), 0.0, 1.0);
    float turned = clamp((1.0 - dot(direction, directionToEye(p, view.eye))) / max(s.cameraFade, 1e-6), 0.0, 1.0);
    return vec4(edge * near * turned, edge, near, turned);
}

MarchView marchView(ViewParams view) {
    return MarchView(view.worldToClip, view.clipToWorld, view.viewPlane, view.depthToDistance, view.size, view.pixel);
}

#endif
