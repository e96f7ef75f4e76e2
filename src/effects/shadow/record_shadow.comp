// Looks up the sun's shadow at one pixel and records every look-up. In: depth, geometric normal, shadow maps and their
// ranges. Out: a row of texels, see record_shadow.h.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/shadow/record_shadow.h"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 1) in;
layout(constant_id = 0) const uint filterKind = ShadowFilter_pcss;
layout(constant_id = 1) const uint hasRanges = 1;
layout(constant_id = 2) const uint cascades = 1;
layout(constant_id = 3) const uint biasKind = ShadowBias_slope;
layout(scalar) uniform ParamsBlock {
    RecordShadowParams params;
};
uniform sampler2D depth;
uniform usampler2D geometricNormal;
#include "effects/shadow/shadow_depth.glsl"
uniform sampler2D range;
layout(rgba32f) uniform writeonly image2D record;

float loadShadowDepth(ivec2 texel) {
    return shadowDepth(texel);
}
vec2 loadShadowRange(ivec2 cell) {
    return texelFetch(range, cell, 0).rg;
}
#include "shaders/shadow_map.glsl"

uint noted = 0u;
vec3 point;
DepthBias noteBias;
vec3 axisX;
vec3 axisY;
vec3 toSun;

void note(vec2 offset, ShadowTexel texel) {
    bool stored = texel.clearance > outsideClearance;
    bool blocking = stored && blocks(texel, noteBias);
    if (noted < recordedShadowTexels) {
        vec3 place = point + offset.x * axisX + offset.y * axisY + (blocking ? texel.height : 0.0) * toSun;
        imageStore(record, ivec2(recordedShadowHead + noted, 0), vec4(place, stored ? float(blocking) : -1.0));
    }
    ++noted;
}
#define NOTE_TEXEL(offset, texel) note(offset, texel)
#include "effects/shadow/sun_shadow.glsl"

void main() {
    ivec2 pixel = ivec2(params.pixel);
    float d = texelFetch(depth, pixel, 0).r;
    point = uvToWorld(pixelToUv(pixel, params.view.pixel), max(d, 1e-12), params.view.clipToWorld);
    vec3 normal = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    Cascade c = Cascade(cascades - 1u, 0.0);
    if (cascades > 1u) {
        c = selectCascade(dot(params.view.viewPlane, vec4(point, 1.0)), params.sun);
    }
    ShadowMapParams map = params.sun.maps[c.index];
    axisX = normalize(shadowAxis(map, 0));
    axisY = normalize(shadowAxis(map, 1));
    toSun = map.toSun;
    ShadowTile tile =
        ShadowTile(cascadeTileOrigin(c.index, params.settings.resolution), ivec2(params.settings.resolution));
    noteBias = biasKind == ShadowBias_constant ? constantReceiver(point, map, tile, params.settings.constantBias).bias
                                               : slopeReceiver(point, normal, map, tile, params.settings.bias, roundingAt(point)).bias;
    Result r = resultIn(c.index, point, normal, vec4(0.25));
    imageStore(record, ivec2(0, 0), vec4(float(noted), r.visibility, r.width, r.height));
    imageStore(record, ivec2(1, 0), vec4(point, 1.0));
}
