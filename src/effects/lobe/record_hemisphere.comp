// Marches diffuse rays of one pixel through the depth buffer, evenly over its cosine-weighted hemisphere, to show where
// its indirect light comes from.
// In: depth, normals, back depth, pyramid. Out: two texels for each ray, see record_ray.h.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/record_ray.h"
#include "effects/gbuffer/gbuffer.glsl"
#include "shaders/sampling.glsl"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { RecordRayParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D backDepth;
layout(rg32f) uniform readonly image2D pyramid;
#include "effects/pyramid/pyramid.glsl"
layout(rgba32f) uniform writeonly image2D record;

float loadDepth(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
float loadBackDepth(ivec2 pixel) { return texelFetch(backDepth, pixel, 0).r; }
vec2 loadCell(ivec2 cell, int level) { return pyramidCell(cell, level, params.view.size); }
#include "effects/lobe/trace_ray.glsl"

void main() {
    int i = int(gl_LocalInvocationIndex);
    ivec2 pixel = ivec2(params.pixel);
    float d = loadDepth(pixel);
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), max(d, 1e-12), params.view.clipToWorld);
    vec3 flatNormal = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    // Equal areas of the disk, turned by the golden ratio.
    vec2 u = vec2((float(i) + 0.5) / float(recordedSamples), fract(float(i) * 0.61803398875));
    vec3 direction = basisAround(unpackUnitVector(texelFetch(normal, pixel, 0).r)) * sampleCosineHemisphere(u);
    const float lowest = 1e-3;  // normals of normal maps send some below the surface
    float height = dot(direction, flatNormal);
    direction = height < lowest ? normalize(direction + flatNormal * (lowest - height)) : direction;
    MarchView view = marchView(params.view);
    MarchRay ray = makeMarchRay(p, direction, planeOnScreen(p, flatNormal, params.view.clipToWorld), view);
    MarchOptions options = marchOptions(params.settings, params.settings.maxDistance, params.secondLayer, 1.0);
    MarchResult hit = marchBy(params.settings.method, ray, options, view);
    vec3 there = unpackUnitVector(texelFetch(geometricNormal, hit.pixel, 0).r);
    bool unseen = hit.outcome == marchHit && isUnseen(hit, p, direction, there, params.settings.method, options,
                                                      params.certainNext != 0u, params.view);
    bool counts = hit.outcome == marchHit && !(unseen && params.settings.rejectBackfaces != 0u);
    imageStore(record, ivec2(2 * i, 0), vec4(direction, hit.distance));
    imageStore(record, ivec2(2 * i + 1, 0), vec4(counts ? 1.0 : 0.0, vec2(hit.pixel), 0.0));
}
