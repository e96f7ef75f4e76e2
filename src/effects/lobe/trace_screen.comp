// Screen-space ray tracing of waiting rays: marches them through the depth buffer; a hit takes the radiance stored there.
// The same for planar reflections, with rays that start on the mirror and the mirrored camera's buffers.
// In: depth and geometric normal of the rays' origins; of the traced view: depth of both layers, geometric normal,
// motion, pyramid, light of this and the last frame and mips of one of them; ray directions, the list.
// Out: results, sources, steps, motion of reflected images, the list of misses, that of rays that the next pass goes on with.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/rays.glsl"
#include "effects/lobe/trace_screen.h"

layout(constant_id = 0) const uint countSteps = 0u;
layout(constant_id = 1) const uint through = 0u;

layout(local_size_x = 64) in;
uniform sampler2D ownDepth;
uniform usampler2D ownGeometricNormal;
#include "effects/lobe/ray_origin.glsl"
layout(r32f) uniform writeonly image2DArray steps;
layout(rg32ui) uniform readonly uimage2DArray direction;
#include "effects/lobe/rays_waiting.glsl"
layout(rgba16f) uniform image2DArray answer;
layout(rgba8) uniform image2DArray source;
#include "effects/lobe/rays_answer.glsl"
#include "effects/lobe/rays_append.glsl"
#include "effects/lobe/screen_hit.glsl"
#include "effects/lobe/march_phases.glsl"
#include "effects/planar/mirror_answers.glsl"

// A ray of a list.
struct ListedRay {
    RayItem item;
    HizState state;
    bool waits;  // out: it has not ended, and is in the next pass' list
};

MarchResult traceRay(ListedRay listed, MarchRay ray, MarchOptions o, MarchView view) {
    // On a smooth mirror, rays point straight away from the mirrored camera and stay within one pixel, which stepping
    // would skip.
    if (through == throughMirror && all(lessThan(abs(makeScreenRay(ray, o.maxDistance, view).delta.xy), vec2(1.0)))) {
        return marchExhaustive(ray, o, view);
    }
    return marchPhase(listed.item, listed.state, ray, o, view);
}

RayAnswer traceAnswer(inout ListedRay listed, ivec3 slot, Ray ray, vec3 p, vec3 n, inout WaitingRay w) {
    MarchView view = marchView(params.view);
    // The mirror itself is clipped from its planar view, so no surface there needs to be excluded.
    vec4 ownPlane = through == throughScreen ? planeOnScreen(p, n, params.view.clipToWorld) : vec4(0.0, 0.0, 0.0, 1.0);
    MarchOptions options = screenOptions(slot.xy, params.firstRay + uint(slot.z));
    MarchResult hit = traceRay(listed, makeMarchRay(p, ray.direction, ownPlane, view), options, view);
    listed.waits = hit.outcome == marchUnfinished;
    if (collects != 0u && listed.waits) {
        return noAnswer;
    }
    if (countSteps != 0u) {
        imageStore(steps, slot, vec4(float(hit.steps)));
    }
    bool unseen = hitsUnseen(hit, p, ray, options);
    updateClearDistance(hit, unseen, p, ray, w);
    if (tellsMotion != 0u && slot.z == 0 && hit.outcome == marchHit && !unseen) {
        writeReflectionMotion(slot.xy, ray, p, hit);
    }
    if (through == throughMirror) {
        return unseen ? noAnswer : shadeMirrorHit(hit, p, ray);
    }
    return hit.outcome != marchHit || unseen ? noAnswer : answerOfHit(hit, p, ray);
}

RayAnswer answerRay(inout ListedRay listed, ivec3 slot, Ray ray, inout WaitingRay w) {
    if (through == throughScreen && ray.trust == 0.0) {
        return noAnswer;
    }
    float d = texelFetch(ownDepth, slot.xy, 0).r;
    vec3 p = rayOrigin(slot, d, params.own);
    vec3 n = unpackUnitVector(texelFetch(ownGeometricNormal, slot.xy, 0).r);
    // Planar views are of smooth surfaces; the next source answers where a texture makes these rough.
    if (through != throughScreen && (ray.highlighted || !liesOnMirror(p, n))) {
        return noAnswer;
    }
    if (through == throughMirrorLookup) {
        return lookUpMirror(p);
    }
    if (through == throughMirrorCamera) {
        return lookUpCamera(p);
    }
    return traceAnswer(listed, slot, ray, p, n, w);
}

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    uint count = waiting.count;
    if (continues != 0u) {
        count = unfinishedCount();
    }
    for (uint i = gl_GlobalInvocationID.x; i < count; i += stride) {
        ListedRay listed = ListedRay(RayItem(0u, 0u, 0u), hizStart(), false);
        if (continues != 0u) {
            listed.item = unfinished.items[i].ray;
            listed.state = unpackUnfinished(unfinished.items[i]);
        } else {
            listed.item = waiting.items[i];
        }
        WaitingRay w = unpackWaitingRay(listed.item);
        Ray ray = unpackRay(imageLoad(direction, w.slot).xy);
        RayAnswer a = answerRay(listed, w.slot, ray, w);
        if (collects != 0u && listed.waits) {
            continue;
        }
        // Not ?: of two vectors: with a specialization constant as condition, Mesa 22 gets all components but x wrong.
        vec4 color = sourcePlanar;
        if (through == throughScreen) {
            color = sourceScreen;
        }
        w.rest = addAnswer(w.slot, a, w.rest, color);
        if (w.rest > 0.0) {
            appendRay(w);
        }
    }
}
