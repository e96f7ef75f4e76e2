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

// Pixels between a hit and the point where the ray meets the plane of what that pixel shows: more, and it met another
// surface.
const float sideSlack = 2.0;

// Whether a ray from p hit something that the screen does not show: the far side of the visible surface at the hit, or its
// side, behind the silhouette (the ray meets the plane of the visible surface far from that pixel, if at all). certainNext:
// the next source finds the actual hit; then it may be anything, if the ray passed behind something whose thickness is
// only assumed, and which may have stopped it. n: geometric normal at the hit. Methods whose steps are longer than a
// pixel miss the place by more than a side's width.
bool isUnseen(MarchResult hit, vec3 p, vec3 direction, vec3 n, uint method, MarchOptions o, bool certainNext,
              ViewParams view) {
    float toward = -dot(n, direction);
    if (toward <= 0.0 || (certainNext && hit.occluded && !o.secondLayer)) {
        return true;
    }
    if (method < TraceMethod_dda) {
        return false;
    }
    vec3 there = uvToWorld(pixelToUv(hit.pixel, view.pixel), loadDepth(hit.pixel), view.clipToWorld);
    vec4 clip = view.worldToClip * vec4(toward * p + dot(n, p - there) * direction, toward);
    vec2 across = ndcToUv(clip.xy / clip.w) * view.size - (vec2(hit.pixel) + 0.5);
    float slack = sideSlack + (method == TraceMethod_dda ? o.stride : 0.0);
    return clip.w <= 0.0 || max(abs(across.x), abs(across.y)) > slack;
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
