// Marches one pixel's mirror ray through the depth buffer and records every depth sample, to explain why there is or is
// no reflection.
// In: depth, normals, back depth, pyramid. Out: a row of texels, see record_ray.h.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer.glsl"
#include "effects/lobe/record_ray.h"

layout(local_size_x = 1) in;
layout(scalar) uniform ParamsBlock {
    RecordRayParams params;
};
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D backDepth;
layout(rg32f) uniform readonly image2D pyramid;
#include "effects/pyramid/pyramid.glsl"
layout(rgba32f) uniform writeonly image2D record;

uint noted = 0u;

void note(ivec2 cell, int level, float nearest) {
    if (noted < recordedSteps) {
        imageStore(record, ivec2(recordHead + noted, 0), vec4(vec2(cell), float(level), nearest));
    }
    ++noted;
}

float loadDepth(ivec2 pixel) {
    float d = texelFetch(depth, pixel, 0).r;
    note(pixel, 0, d);
    return d;
}
float loadBackDepth(ivec2 pixel) {
    return texelFetch(backDepth, pixel, 0).r;
}
vec2 loadCell(ivec2 cell, int level) {
    vec2 depths = pyramidCell(cell, level, params.view.size);
    note(cell, level, depths.x);
    return depths;
}
#include "effects/lobe/trace_ray.glsl"

void main() {
    ivec2 pixel = ivec2(params.pixel);
    float d = texelFetch(depth, pixel, 0).r;
    imageStore(record, ivec2(0), vec4(-1.0));
    if (d <= 0.0) {
        return;
    }
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    vec3 flatNormal = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    vec3 direction = reflect(-directionToEye(p, params.view.eye), unpackUnitVector(texelFetch(normal, pixel, 0).r));
    MarchView view = marchView(params.view);
    MarchRay ray = makeMarchRay(p, direction, planeOnScreen(p, flatNormal, params.view.clipToWorld), view);
    MarchOptions options = marchOptions(params.settings, params.settings.maxDistance, params.secondLayer, 1.0);
    MarchResult hit = marchBy(params.settings.method, ray, options, view);
    vec3 there = unpackUnitVector(texelFetch(geometricNormal, hit.pixel, 0).r);
    bool unseen = hit.outcome == marchHit && isUnseen(hit, p, direction, there, params.settings.method, options,
                                                      params.certainNext != 0u, params.view);
    imageStore(record, ivec2(0, 0), vec4(float(hit.outcome), vec2(hit.pixel), hit.distance));
    imageStore(record, ivec2(1, 0), vec4(hit.clear, float(hit.occluded), float(hit.steps), float(unseen)));
    imageStore(record, ivec2(2, 0),
               fadeOf(hit, p, direction, params.settings, params.settings.maxDistance, params.view));
    imageStore(record, ivec2(3, 0), vec4(direction, float(noted)));
    imageStore(record, ivec2(4, 0), vec4(p, 1.0));
}
