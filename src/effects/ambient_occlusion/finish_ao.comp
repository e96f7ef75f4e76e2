// Upsamples ambient visibility and turns its variation with the normal into the bent normal. In: G-buffer; visibility as light of
// a lobe, with its surfaces if at reduced resolution. Out: bent normal, visibility.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/gbuffer/gbuffer.glsl"
#include "effects/lobe/upsample.glsl"
#include "shaders/directional_light.glsl"
#include "shaders/luminance.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint scale = 1u;
layout(constant_id = 1) const uint multiBounce = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { FinishAoParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D baseColor;
layout(rgba16f) uniform readonly image2D light;
layout(rgba16f) uniform readonly image2D directional;
layout(r32f) uniform readonly image2D lightDepth;
layout(r32ui) uniform readonly uimage2D lightNormal;
layout(rgba16f) uniform writeonly image2D result;

// Visibility, and its variation with the normal.
struct Visibility {
    float open;
    vec4 directional;
};

Visibility upsampled(Shown shown) {
    ivec2 size = imageSize(lightDepth);
    Blocks b = blocksAt(shown, scale, params.blockOffset, params.shift, size);
    float open = 0.0;
    float weights = 0.0;
    vec4 turning = vec4(0.0);
    vec3 normals = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 block = blockAt(b, i, size);
        vec2 away = vec2(block * int(scale) + int(params.blockOffset) - shown.pixel);
        float d = imageLoad(lightDepth, block).r;
        vec3 n = unpackUnitVector(imageLoad(lightNormal, block).r);
        float weight = weighed(b.weights[i], onSameSurface(shown, away, d) * facingLike(n, shown.normal, true), d);
        open += weight * imageLoad(light, block).r;
        turning += weight * imageLoad(directional, block);
        normals += weight * n;
        weights += weight;
    }
    float whole = 1.0 / max(weights, 1e-12);
    turning *= whole;
    return Visibility(open * whole * relightFactor(turning, normals * whole, shown.normal), turning);
}

// A fit of path-traced visibility with light between surfaces of this albedo (Jimenez et al., Practical Real-Time Strategies for
// Accurate Indirect Occlusion, 2016).
float withBounces(float open, float albedo) {
    float a = 2.0404 * albedo - 0.3324;
    float b = -4.7951 * albedo + 0.6417;
    float c = 2.7552 * albedo + 0.6903;
    return max(open, ((open * a + b) * open + c) * open);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    vec4 seen = vec4(0.0, 0.0, 0.0, 1.0);
    if (d > 0.0) {
        vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
        Visibility v;
        if (scale > 1u) {
            vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
            vec3 geometric = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
            v = upsampled(Shown(pixel, d, n, screenPlane(p, geometric, params.view.clipToWorld, params.view.pixel,
                                                        params.view.pixelAngle)));
        } else {
            v = Visibility(imageLoad(light, pixel).r, imageLoad(directional, pixel));
        }
        v.open = clamp(v.open, 0.0, 1.0);
        if (multiBounce != 0u) {
            v.open = withBounces(v.open, luminance(unpackBaseColor(texelFetch(baseColor, pixel, 0).rgb)));
        }
        // Of a surface that sees nothing, the normal. Not below the surface.
        vec3 open = v.directional.rgb;
        open += max(1e-4 - dot(open, n), 0.0) * n;
        seen = vec4(normalize(open), v.open);
    }
    imageStore(result, pixel, seen);
}
