// Visibility of each shadow-casting lamp that may reach the pixel: one texel, PCF or PCSS. In: depth, geometric normal,
// the lamps' shadow maps, lamp masks per tile, blue noise. Out: visibility, 1 lit.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/shadow/lamp_shadow.h"
#include "shaders/lamp.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint filterKind = ShadowFilter_pcss;
layout(scalar) uniform ParamsBlock { LampVisibilityParams params; };
layout(scalar) uniform ShadowUniforms { LampShadows shadowBlock; };
uniform sampler2D depth;
uniform usampler2D geometricNormal;
uniform sampler2D shadowMap;
layout(scalar) readonly buffer BlueNoise { uint texels[]; } blueNoise;
uniform usampler2DArray lampMasks;
layout(rgba8) uniform writeonly image2DArray visibility;

uint loadBlueNoise(uint texel) { return blueNoise.texels[texel]; }
float loadLampDepth(ivec2 texel) { return texelFetch(shadowMap, texel, 0).r; }
uvec4 loadLampMask(ivec3 texel) { return texelFetch(lampMasks, texel, 0); }
#include "shaders/lamp_mask.glsl"
#include "shaders/lamp_shadow.glsl"
#include "shaders/shadow_noise.glsl"

const uint lampStream = 0x1a90u;  // of the noise

LampReceiver receiver;
float wayThroughCasters;  // from the receiver toward a directional lamp [m]
ShadowTexel shadowTexel(vec2 offset) { return lampTexel(receiver, offset); }
float hardShadow() { return hardLampVisibility(receiver); }
#include "shaders/soft_shadow.glsl"

// Shrinks the blocker search radius iteratively to the penumbra radius of the highest blocker sampled so far. Otherwise
// few samples over a very wide disk would miss narrow penumbras. 0: no blockers; -1: nor the receiver's own
// surface in the texel that holds it.
float shrunkSearch(ShadowCone cone, float radius, float least, vec2 noise, uint count) {
    bool own = false;
    for (int i = 0; i < 3; ++i) {
        ShadowPattern pattern = shadowPattern(params.settings, count, fract(noise + 0.618 * float(i)));
        float highest = -1.0;
        for (uint k = 0u; k <= count; ++k) {
            ShadowTexel texel = shadowTexel(k == 0u ? vec2(0.0) : radius * nextPoint(pattern));
            own = own || (k == 0u && showsReceiver(texel, receiver.bias));
            highest = blocks(texel, receiver.bias) ? max(highest, max(texel.height, 0.0)) : highest;
        }
        float needed = highest < 0.0 ? (own ? 0.0 : -1.0) : max(penumbraRadius(cone, highest), least);
        if (needed > 0.7 * radius) {
            break;
        }
        radius = needed;
        if (needed <= least) {
            break;
        }
    }
    return radius;
}

float pcss(ShadowCone cone, vec4 noise, ShadowSettings s) {
    float least = minFilterRadius * receiver.texel;
    // Any depth of the tile could cast, but for blockers closer to the lamp than ten radii the search would get far too
    // wide: they are found only where they hide the lamp's centre (lampSearchTangent).
    // No blocker of a directional lamp is beyond the casters' bounds.
    float highest = isDistant(receiver.shadow) ? wayThroughCasters : receiver.distance - receiver.shadow.near;
    float radius = min(penumbraRadius(cone, highest), lampSearchTangent * receiver.distance);
    if (radius <= least) {
        return sharpLampVisibility(receiver);
    }
    radius = shrunkSearch(cone, radius, least, noise.wz, s.blockerSamples);
    if (radius == 0.0) {
        return 1.0;
    }
    float height = radius < 0.0 ? -1.0
                                : meanBlockerHeight(cone, radius, least, receiver.bias,
                                                    shadowPattern(s, s.blockerSamples, noise.zw), s.blockerSamples);
    if (height == 0.0) {
        return 1.0;
    }
    return height < 0.0
               ? hardShadow()
               : diskVisibility(cone, height, least, receiver.bias, shadowPattern(s, s.samples, noise.xy), s.samples);
}

// Metres from p along a unit direction to where it leaves the bounds of all casters.
float wayToBounds(vec3 p, vec3 direction) {
    vec3 ahead = mix(shadowBlock.boundsMin, shadowBlock.boundsMax, greaterThan(direction, vec3(0.0))) - p;
    vec3 ways = abs(ahead) / max(abs(direction), vec3(1e-6));
    return min(ways.x, min(ways.y, ways.z));
}

float visibilityAt(ivec2 pixel, uint index, vec3 p, vec3 n) {
    LampShadow shadow = shadowBlock.lamps[index];
    vec3 toLamp;
    vec3 irradiance = lampIrradiance(shadow.lamp, p, toLamp);
    float facing = dot(n, toLamp);
    if (irradiance == vec3(0.0) || facing <= 0.0) {
        return 0.0;  // out of its range or cone, or in the surface's own shadow
    }
    ShadowSettings s = params.settings;
    bool distant = isDistant(shadow);
    wayThroughCasters = distant ? wayToBounds(p, toLamp) : 0.0;
    receiver = lampReceiver(shadow, shadowBlock.tileSize, shadowBlock.columns, p, n, s.bias,
                            roundingOfPixel(p, pixelWidth(p, params.view.viewPlane, params.view.eye, params.view.pixelAngle)),
                            shadow.lamp.radius * wayThroughCasters);
    if (filterKind == ShadowFilter_hard) {
        return hardLampVisibility(receiver);
    }
    vec4 noise = shadowNoise(pixel, params.view, s.pattern == ShadowPattern_rings, lampStream + 2u * index);
    if (filterKind == ShadowFilter_pcf) {
        float radius = s.radius * (s.radiusUnit == ShadowUnit_texels ? receiver.texel : 1.0);
        return pcfVisibility(radius, receiver.bias, shadowPattern(s, s.samples, noise.xy), s.samples);
    }
    float slope = distant ? shadow.lamp.radius : shadow.lamp.radius / receiver.distance;
    float share = fractionAboveHorizon(facing, slope * inversesqrt(1.0 + slope * slope));
    if (shadow.lamp.type == lampEmitter) {
        return share * sharpLampVisibility(receiver);
    }
    return share * pcss(ShadowCone(slope, distant ? 0.0 : 1.0 / receiver.distance), noise, s);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float results[maxShadowedLamps];
    for (uint i = 0u; i < maxShadowedLamps; ++i) {
        results[i] = 0.0;
    }
    uint lamps = 0u;  // bit mask of the lamps that may light the pixel
    for (uint i = 0u; i < shadowBlock.count; ++i) {
        lamps |= lampMayReach(pixel, shadowBlock.lamps[i].index) ? 1u << i : 0u;
    }
    float d = texelFetch(depth, pixel, 0).r;
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        vec3 n = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
        for (; lamps != 0u; lamps &= lamps - 1u) {
            uint i = uint(findLSB(lamps));
            results[i] = visibilityAt(pixel, i, p, n);
        }
    }
    for (uint i = 0u; i < shadowBlock.count; i += 4u) {
        imageStore(visibility, ivec3(pixel, i / 4u), vec4(results[i], results[i + 1u], results[i + 2u], results[i + 3u]));
    }
}
