// Traces rays from random pixels of a G-buffer: even ones are cosine-distributed around the geometric normal, odd ones
// are mirror rays. In: depth, geometric normal, pyramid, as trace_screen reads them. Out: the results of three tracers.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "oracle_test.h"
#include "shaders/noise.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"
#include "shaders/sampling.glsl"

layout(constant_id = 0) const uint secondLayer = 0u;

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { OracleParams params; };
uniform sampler2D depth;
uniform sampler2D backDepth;
layout(rg32f) uniform readonly image2D pyramid;
#include "effects/pyramid/pyramid.glsl"
uniform usampler2D geometricNormal;
layout(scalar) buffer OutputBlock { OracleRay items[]; } outputs;

float loadDepth(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
float loadBackDepth(ivec2 pixel) { return texelFetch(backDepth, pixel, 0).r; }
vec2 loadCell(ivec2 cell, int level) { return pyramidCell(cell, level, params.view.size); }
#include "shaders/march_hiz.glsl"

const uint tries = 64u;

bool findSurface(uint number, out ivec2 pixel) {
    for (uint i = 0u; i < tries; ++i) {
        pixel = ivec2(hashToUnit2(hashPixel(uvec2(number, i), 0u, 0u)) * params.view.size);
        if (loadDepth(pixel) > 0.0) {
            return true;
        }
    }
    return false;
}

vec3 directionOf(uint number, vec3 p, vec3 n) {
    if (number % 2u == 1u) {
        return reflect(-directionToEye(p, params.view.eye), n);
    }
    return basisAround(n) * sampleCosineHemisphere(hashToUnit2(hashPixel(uvec2(number, tries), 0u, 0u)));
}

OracleAnswer answerOf(MarchResult r) {
    return OracleAnswer(r.outcome == marchHit ? 1u : 0u, r.pixel.x, r.pixel.y, r.occluded ? 1u : 0u, r.clear, r.steps);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    ivec2 pixel;
    if (i >= outputs.items.length() || !findSurface(i, pixel)) {
        return;
    }
    MarchView view = MarchView(params.view.worldToClip, params.view.clipToWorld, params.view.viewPlane,
                               params.view.depthToDistance, params.view.size, params.view.pixel);
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), loadDepth(pixel), params.view.clipToWorld);
    vec3 n = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    MarchRay ray = makeMarchRay(p, directionOf(i, p, n), planeOnScreen(p, n, params.view.clipToWorld), view);
    TraceScreenSettings s = params.settings;
    MarchOptions o = MarchOptions(s.step, s.minStep, s.stride, s.maxDistance, 1.0, s.maxSteps, s.thickness, false,
                                  secondLayer != 0u, 0u, false, int(pyramidLevels), s.firstSteps);
    outputs.items[i] = OracleRay(1u, pixel.x, pixel.y, answerOf(marchExhaustive(ray, o, view)),
                                 answerOf(marchHiz(ray, o, view)), answerOf(marchDda(ray, o, view)));
}
