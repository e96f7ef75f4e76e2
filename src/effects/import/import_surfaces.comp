// Turns a host's G-buffer into Reflet's. In: the host's images, placeholders where it has none. Out: the images of
// GBuffer (effects/gbuffer/gbuffer.h).
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer.glsl"
#include "effects/import/finite.glsl"
#include "effects/import/import.h"
#include "shaders/projection.glsl"
#include "shaders/shading_normal.glsl"
#include "shaders/srgb.glsl"

layout(constant_id = 0) const uint reversed = 1u;
layout(constant_id = 1) const uint normalKind = normalOctahedralSnorm;
layout(constant_id = 2) const uint hasGeometricNormal = 0u;
layout(constant_id = 3) const uint hasRoughness = 0u;
layout(constant_id = 4) const uint roughnessKind = roughnessPerceptual;
layout(constant_id = 5) const uint hasMetallic = 0u;
layout(constant_id = 6) const uint hasBaseColor = 0u;
layout(constant_id = 7) const uint baseColorIsSrgb = 0u;
layout(constant_id = 8) const uint hasF0 = 0u;
layout(constant_id = 9) const uint hasMotion = 0u;
layout(constant_id = 10) const uint hasBackDepth = 0u;
layout(constant_id = 11) const uint hasExcluded = 0u;
layout(constant_id = 12) const uint hasUnlit = 0u;
layout(constant_id = 13) const uint hasReactive = 0u;
layout(constant_id = 14) const uint hasNormal = 1u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ImportParams params; };
uniform sampler2D hostDepth;
uniform sampler2D hostNormal;
uniform sampler2D hostGeometricNormal;
uniform sampler2D hostRoughness;
uniform sampler2D hostMetallic;
uniform sampler2D hostBaseColor;
uniform sampler2D hostF0;
uniform sampler2D hostMotion;
uniform sampler2D hostBackDepth;
uniform sampler2D hostExcluded;
uniform sampler2D hostUnlit;
uniform sampler2D hostReactive;
layout(r32f) uniform writeonly image2D depth;
layout(r32ui) uniform writeonly uimage2D normal;
layout(r32ui) uniform writeonly uimage2D geometricNormal;
layout(rgb10_a2) uniform writeonly image2D baseColor;
layout(rgba8) uniform writeonly image2D material;
layout(rgba16f) uniform writeonly image2D motion;
layout(rgba16f) uniform writeonly image2D reflectance;
layout(r32f) uniform writeonly image2D backDepth;
layout(r32f) uniform writeonly image2D shownDepth;
layout(r8) uniform writeonly image2D reactive;

// Where a pixel of the frame is in an image of the host.
ivec2 inImage(ivec2 pixel, uint image) {
    uint origin = params.origins[image];
    return pixel + ivec2(origin & 0xffffu, origin >> 16u);
}

// Reversed; 0 for the sky, and for what is no depth.
float reversedDepth(float stored) {
    float d = reversed != 0u ? stored : 1.0 - stored;
    return finite(d) ? clamp(d, 0.0, 1.0) : 0.0;
}

float channelOf(vec4 texel, uint channel) { return clamp(orZero(texel[min(channel, 3u)]), 0.0, 1.0); }

float shownDepthAt(ivec2 pixel) { return reversedDepth(texelFetch(hostDepth, inImage(pixel, hostImageDepth), 0).r); }

bool isExcluded(ivec2 pixel) {
    return hasExcluded != 0u && channelOf(texelFetch(hostExcluded, inImage(pixel, hostImageExcluded), 0), params.excludedChannel) > 0.5;
}

// 0 outside of the picture, and where the host excludes what is shown.
float depthAt(ivec2 pixel) {
    bool outside = any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(params.view.size)));
    return outside || isExcluded(pixel) ? 0.0 : shownDepthAt(pixel);
}

// Unit, in world space; toward the camera if it is no direction.
vec3 decodedNormal(vec4 texel, vec3 toEye) {
    vec3 n = texel.xyz;
    if (normalKind == normalOctahedralUnorm || normalKind == normalVectorUnorm) {
        n = 2.0 * n - 1.0;
    }
    if (normalKind == normalOctahedralSnorm || normalKind == normalOctahedralUnorm) {
        n.z = 1.0 - abs(n.x) - abs(n.y);
        float fold = max(-n.z, 0.0);
        n.xy += vec2(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold);
    }
    n /= max(max(max(abs(n.x), abs(n.y)), abs(n.z)), 1.0);  // so that the square of its length is finite
    float length2 = dot(n, n);
    return finite(n) && length2 > 1e-8 ? mat3(params.normalToWorld) * (n * inversesqrt(length2)) : toEye;
}

vec3 positionAt(ivec2 pixel, float d) {
    return uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
}

const float lies = 1e30;
const float sameBend = 0.05;  // allowed change of slope from pixel to pixel, relative: curved surfaces, rounding
const float sameStep = 0.25;  // and in widths of a pixel

float awayOf(float d) { return depthToViewDistance(max(d, 1e-9), params.view.depthToDistance); }

// How far the pixel lies off the line through its neighbour and the one behind that, in metres [lies: another surface].
// Depth is linear in screen space on a plane.
float offLine(float d, float next, float behind) {
    float wanted = 2.0 * next - behind;
    if (next <= 0.0 || behind <= 0.0 || wanted <= 0.0) {
        return lies;
    }
    float away = awayOf(d);
    float off = abs(away - awayOf(wanted));
    float pixelWidth = params.view.pixelAngle * (params.view.eye.w > 0.0 ? away : 1.0);
    return off <= sameStep * pixelWidth + sameBend * abs(awayOf(next) - awayOf(behind)) ? off : lies;
}

// The vector along the surface to the neighbour, before or after, whose distance continues a plane better; 0 if neither
// does, as on a surface of one or two pixels.
vec3 along(ivec2 pixel, ivec2 step, float d, vec3 p) {
    float before = depthAt(pixel - step);
    float after = depthAt(pixel + step);
    float offBefore = offLine(d, before, depthAt(pixel - 2 * step));
    float offAfter = offLine(d, after, depthAt(pixel + 2 * step));
    if (min(offBefore, offAfter) >= lies) {
        return vec3(0.0);
    }
    return offBefore < offAfter ? p - positionAt(pixel - step, before) : positionAt(pixel + step, after) - p;
}

// Of the surface that the depths around show. Along an axis that shows none, the shading normal.
vec3 normalFromDepth(ivec2 pixel, float d, vec3 p, vec3 shaded) {
    vec3 right = along(pixel, ivec2(1, 0), d, p);
    vec3 down = along(pixel, ivec2(0, 1), d, p);
    vec3 n = cross(right, down);
    bool one = (right == vec3(0.0)) != (down == vec3(0.0));
    if (one) {
        vec3 known = right + down;
        n = shaded - known * (dot(shaded, known) / dot(known, known));
    }
    float length2 = dot(n, n);
    return finite(n) && length2 > 0.0 ? n * inversesqrt(length2) : shaded;
}

float roughnessAt(ivec2 pixel) {
    if (hasRoughness == 0u) {
        return 1.0;
    }
    float value = channelOf(texelFetch(hostRoughness, inImage(pixel, hostImageRoughness), 0), params.roughnessChannel);
    value = roughnessKind == roughnessSmoothness ? 1.0 - value : value;
    return roughnessKind == roughnessAlpha ? sqrt(value) : value;
}

vec3 baseColorAt(ivec2 pixel) {
    if (hasBaseColor == 0u) {
        return vec3(0.5);
    }
    vec3 color = texelFetch(hostBaseColor, inImage(pixel, hostImageBaseColor), 0).rgb;
    color = finite(color) ? clamp(color, 0.0, 1.0) : vec3(0.0);
    return baseColorIsSrgb != 0u ? decodeSrgb(color) : color;
}

// uv now minus uv in the last frame, without jitter.
vec2 motionAt(ivec2 pixel, vec2 uv, vec3 p) {
    if (hasMotion != 0u) {
        vec2 texel = texelFetch(hostMotion, inImage(pixel, hostImageMotion), 0).rg;
        return vec2(orZero(texel.x), orZero(texel.y)) * params.motionToUv + params.motionOffset;
    }
    vec4 before = params.view.previousWorldToClip * vec4(p, 1.0);
    vec2 was = before.w > 0.0 ? ndcToUv(before.xy / before.w) : uv;
    return uv - was;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float d = depthAt(pixel);
    imageStore(depth, pixel, vec4(d));
    float shown = shownDepthAt(pixel);
    if (hasExcluded != 0u) {
        imageStore(shownDepth, pixel, vec4(shown));
    }
    if (hasReactive != 0u) {
        imageStore(reactive, pixel, vec4(channelOf(texelFetch(hostReactive, inImage(pixel, hostImageReactive), 0), params.reactiveChannel)));
    }
    if (hasBackDepth != 0u) {
        imageStore(backDepth, pixel, vec4(reversedDepth(texelFetch(hostBackDepth, inImage(pixel, hostImageBackDepth), 0).r)));
    }
    vec2 uv = pixelToUv(pixel, params.view.pixel);
    vec3 p = uvToWorld(uv, max(shown, 1e-9), params.view.clipToWorld);
    vec3 toEye = directionToEye(p, params.view.eye);
    vec3 n = d > 0.0 && hasNormal != 0u ? decodedNormal(texelFetch(hostNormal, inImage(pixel, hostImageNormal), 0), toEye) : toEye;
    vec3 flat_ = toEye;
    if (d > 0.0) {
        flat_ = hasGeometricNormal != 0u ? decodedNormal(texelFetch(hostGeometricNormal, inImage(pixel, hostImageGeometricNormal), 0), toEye)
                                         : normalFromDepth(pixel, d, p, n);
    }
    flat_ = dot(flat_, toEye) < 0.0 ? -flat_ : flat_;
    // Normals that the host has bent by the same rule are kept bit for bit.
    vec3 bent = consistentNormal(n, flat_, toEye);
    imageStore(normal, pixel, uvec4(packUnitVector(dot(bent, n) > 0.9999 ? n : bent)));
    imageStore(geometricNormal, pixel, uvec4(packUnitVector(flat_)));
    imageStore(baseColor, pixel, vec4(packBaseColor(baseColorAt(pixel)), 1.0));
    float metal = 0.0;
    if (hasMetallic != 0u && hasF0 == 0u) {
        metal = channelOf(texelFetch(hostMetallic, inImage(pixel, hostImageMetallic), 0), params.metallicChannel);
    }
    bool dark = hasUnlit != 0u && channelOf(texelFetch(hostUnlit, inImage(pixel, hostImageUnlit), 0), params.unlitChannel) > 0.5;
    imageStore(material, pixel, vec4(roughnessAt(pixel), metal, 1.0, dark ? float(materialFlagUnlit) / 255.0 : 0.0));
    if (hasF0 != 0u) {
        vec3 f0 = texelFetch(hostF0, inImage(pixel, hostImageF0), 0).rgb;
        f0 = finite(f0) ? clamp(f0, 0.0, 1.0) : vec3(0.0);
        imageStore(reflectance, pixel, vec4(f0 / dielectricF0, 1.0));
    }
    vec2 moved = shown > 0.0 ? motionAt(pixel, uv, p) : vec2(0.0);
    imageStore(motion, pixel, vec4(clamp(moved, -4.0, 4.0), 0.0, 0.0));
}
