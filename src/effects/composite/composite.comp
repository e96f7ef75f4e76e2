// Multiplies indirect light by the surface's reflectance and sums all light. In: G-buffer, direct light, the lobes'
// mean radiance, at reduced resolution with their surfaces. Out: both indirect layers, and lit = direct + both, within
// the limits, with the distance along the view [m], 0: the sky.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/composite/composite.h"
#include "effects/denoise/keeps_jitter.glsl"
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "effects/import/bounded.glsl"
#include "effects/lobe/upsample.glsl"
#include "shaders/directional_light.glsl"
#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint diffuseScale = 1u;  // 0: the lobe is black
layout(constant_id = 2) const uint lambertOnly = 0u;
layout(constant_id = 3) const uint layers = 1u;
layout(constant_id = 4) const uint hasDirectional = 0u;
layout(constant_id = 5) const uint splits = 0u;
layout(constant_id = 6) const uint bounded = 0u;
layout(constant_id = 7) const uint highlights = 0u;  // with splits: there are some

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { CompositeParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform sampler2D baseColor;
uniform sampler2D material;
uniform sampler2D ggxTable;
layout(rgba16f) uniform readonly image2D direct;
layout(rgba16f) uniform readonly image2D fromEmitters;
layout(rgba16f) uniform readonly image2D emitterHighlights;
layout(rgba16f) uniform readonly image2D diffuse;
layout(rgba16f) uniform writeonly image2D directAlone;
layout(rgba16f) uniform writeonly image2D indirectDiffuse;
layout(rgba16f) uniform writeonly image2D indirectSpecular;
layout(rgba16f) uniform writeonly image2D lit;
layout(r32f) uniform readonly image2D limits;

uniform usampler2D geometricNormal;
layout(r32f) uniform readonly image2D diffuseDepth;
layout(r32ui) uniform readonly uimage2D diffuseNormal;
layout(rgba16f) uniform readonly image2D diffuseDirectional;
#include "effects/lobe/upsample_specular.glsl"

vec3 diffuseRadiance(Shown shown) {
    if (diffuseScale == 0u) {
        return vec3(0.0);
    }
    if (diffuseScale == 1u) {
        return imageLoad(diffuse, shown.pixel).rgb;
    }
    const bool turns = hasDirectional != 0u;
    ivec2 size = imageSize(diffuseDepth);
    Blocks b = blocksAt(shown, diffuseScale, params.diffuseBlockOffset, params.diffuseShift, size);
    vec4 sum = vec4(0.0);
    vec4 directional = vec4(0.0);
    vec3 normals = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 block = blockAt(b, i, size);
        vec2 away = vec2(block * int(diffuseScale) + int(params.diffuseBlockOffset) - shown.pixel);
        float d = imageLoad(diffuseDepth, block).r;
        vec3 n = unpackUnitVector(imageLoad(diffuseNormal, block).r);
        float same = onSameSurface(shown, away, d) * facingLike(n, shown.normal, turns);
        float weight = weighed(b.weights[i], same, d);
        sum += weight * vec4(imageLoad(diffuse, block).rgb, 1.0);
        if (turns) {
            directional += weight * imageLoad(diffuseDirectional, block);
            normals += weight * n;
        }
    }
    float whole = 1.0 / max(sum.a, 1e-12);
    return sum.rgb * whole * (turns ? relightFactor(directional * whole, normals * whole, shown.normal) : 1.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    vec3 fromDiffuse = vec3(0.0);
    vec3 fromSpecular = vec3(0.0);
    float d = texelFetch(depth, pixel, 0).r;
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
        float nv = dot(n, directionToEye(p, params.view.eye));
        MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
        Surface s = surfaceAt(pixel, texelFetch(baseColor, pixel, 0).rgb, m, nv, ggxTable, lambertOnly != 0u);
        vec3 geometric = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
        Shown shown = Shown(pixel, d, n, screenPlane(p, geometric, params.view.clipToWorld, params.view.pixel,
                                                     params.view.pixelAngle));
        fromDiffuse = params.diffuseGain * (s.diffuse + s.sheenAlbedo) * diffuseRadiance(shown);
        vec2 specularShift = (1.0 - keepsJitter(m.roughness)) * params.specularShift;
        fromSpecular = s.specular * specularLight(shown, params.specularBlockOffset, specularShift).rgb;
    }
    vec3 all = imageLoad(direct, pixel).rgb;
    if (layers != 0u) {
        vec3 emitters = vec3(0.0);
        vec3 reflected = fromSpecular;
        if (splits != 0u) {
            emitters = imageLoad(fromEmitters, pixel).rgb;
            vec3 shine = highlights != 0u ? imageLoad(emitterHighlights, pixel).rgb : vec3(0.0);
            imageStore(directAlone, pixel, vec4(max(all - emitters - shine, vec3(0.0)), 1.0));
            reflected += shine;
        }
        imageStore(indirectDiffuse, pixel, vec4(clampToHalf(fromDiffuse + emitters), 1.0));
        imageStore(indirectSpecular, pixel, vec4(clampToHalf(reflected), 1.0));
    }
    vec3 sum = all + fromDiffuse + fromSpecular;
    if (bounded != 0u) {
        sum = boundedLuminance(sum, imageLoad(limits, pixel / int(boundTileSide)).r);
    }
    float away = d > 0.0 ? min(depthToViewDistance(d, params.view.depthToDistance), largestHalf) : 0.0;
    imageStore(lit, pixel, vec4(clampToHalf(sum), away));
}
