// Sunlight that blended surfaces let through. In: the sun's visibility, and for two layers of blended surfaces their
// depth from the sun, the share of light that passes; the extinction behind the first. Out: the visibility times that
// share, in colour.
#version 460
#extension GL_EXT_scalar_block_layout : require
float loadShadowDepth(ivec2 texel) { return 0.0; }  // of the opaque surfaces, not used
#include "renderer/blend/blend_shadow.h"
#include "shaders/cascades.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"
#include "shaders/shadow_map.glsl"

layout(constant_id = 0) const uint cascades = 1u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { BlendShadowParams params; };
uniform sampler2D depth;
uniform usampler2D geometricNormal;
uniform sampler2D sunVisibility;
uniform sampler2D depth0;
uniform sampler2D depth1;
uniform sampler2D transmittance0;
uniform sampler2D transmittance1;
uniform sampler2D extinction0;
layout(rgba8) uniform writeonly image2D visibility;

// Metres from a layer's texel to the receiver, whose plane is at `plane` metres above the receiver there; 0: the layer is
// not in the light's way.
float inFront(float d, ShadowReceiver r, float plane) {
    float clearance = (d - r.s.z) * r.depthRange - plane;
    return d > 0.0 && clearance > r.bias.most ? clearance : 0.0;
}

// Share of the light that passes both layers' texels. Between them is the volume that the light enters at the first one.
vec3 passes(ivec2 texel, ShadowReceiver r, float plane) {
    float first = inFront(texelFetch(depth0, texel, 0).r, r, plane);
    float second = inFront(texelFetch(depth1, texel, 0).r, r, plane);
    vec3 share = first > 0.0 ? texelFetch(transmittance0, texel, 0).rgb : vec3(1.0);
    share *= second > 0.0 ? texelFetch(transmittance1, texel, 0).rgb : vec3(1.0);
    float path = first > 0.0 && second > 0.0 ? first - second : 0.0;
    return share * exp(-path * texelFetch(extinction0, texel, 0).rgb);
}

// Bilinear over four texels.
vec3 transmittanceIn(uint cascade, vec3 p, vec3 normal) {
    ShadowTile tile = ShadowTile(cascadeTileOrigin(cascade, params.resolution), ivec2(params.resolution));
    ShadowReceiver r = slopeReceiver(p, normal, params.sun.maps[cascade], tile, params.bias, rounding(p));
    ivec2 corner = ivec2(floor(r.at - 0.5));
    vec2 f = r.at - 0.5 - vec2(corner);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(corner + offset, ivec2(0), tile.size - 1);
        vec2 toCentre = (2.0 * (vec2(texel) + 0.5) / vec2(tile.size) - 1.0) - r.s.xy;
        float plane = dot(r.slope, toCentre);
        texel += tile.origin;
        vec2 weight = mix(1.0 - f, f, vec2(offset));
        sum += weight.x * weight.y * passes(texel, r, plane);
    }
    return sum;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    vec3 visible = vec3(texelFetch(sunVisibility, pixel, 0).r);
    if (d > 0.0 && visible.r > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        vec3 normal = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
        Cascade c = Cascade(0u, 0.0);
        if (cascades > 1u) {
            c = selectCascade(dot(params.view.viewPlane, vec4(p, 1.0)), params.sun);
        }
        visible *= transmittanceIn(c.index, p, normal);
    }
    imageStore(visibility, pixel, vec4(visible, 1.0));
}
