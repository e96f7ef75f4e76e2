// Traces the remaining rays against the scene's BVH and shades their hits. Included by trace_scene.comp and
// trace_scene_query.comp after their traversal.
// In: depth, geometric normal and material of the rays' origins; of the screen: depth, geometric normal, motion, light
// of this and the last frame; the sun's shadow map, GGX table, blue noise, lamps, ray directions, the list. Out:
// results, sources, motion of reflected images, the list of remaining rays.
#include "effects/environment/environment_lobes.glsl"
#include "effects/lobe/ray_tiles.h"
#include "effects/lobe/rays.glsl"
#include "effects/gbuffer/gbuffer.glsl"
#include "effects/lamps.h"
#include "effects/probe/probes.h"
#include "renderer/trace_scene/trace_scene.h"
#include "shaders/cascades.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 1) const uint sunShadows = sunShadowRay;
layout(constant_id = 2) const uint reuseScreen = 0u;
layout(constant_id = 3) const uint tellsMotion = 0u;
layout(constant_id = 4) const uint endsInProbes = 0u;
layout(constant_id = 5) const uint endsInCache = 0u;

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { TraceSceneParams params; };
layout(scalar) uniform LampUniforms { LampBlock lampBlock; };
uniform sampler2D ownDepth;
layout(rg16f) uniform writeonly image2D imageMotion;
uniform usampler2D ownGeometricNormal;
#include "effects/lobe/ray_origin.glsl"
layout(scalar) uniform ProbesUniforms { ProbeBlock probeBlock; };
uniform samplerCubeArray probeLobes;
uniform sampler2D probeIrradiance;
uniform samplerCubeArray probeDistance;
uniform sampler2D depth;
uniform usampler2D geometricNormal;
uniform sampler2D material;
uniform sampler2D motion;
layout(rgba16f) uniform readonly image2D light;
layout(rgba16f) uniform readonly image2D previousLit;
uniform sampler2D shadowMap;
uniform sampler2D ggxTable;
layout(scalar) readonly buffer BlueNoiseBlock { uint texels[]; } blueNoise;
layout(rg32ui) uniform readonly uimage2DArray direction;
#include "effects/lobe/rays_waiting.glsl"
layout(rgba16f) uniform image2DArray answer;
layout(rgba8) uniform image2DArray source;
layout(rgba16f) uniform writeonly image2DArray hitLight;
layout(rgba16f) uniform writeonly image2DArray hitFactor;
layout(r32ui) uniform writeonly uimage2DArray hitNormal;
#include "effects/lobe/rays_answer.glsl"
#include "effects/lobe/rays_append.glsl"

uint loadBlueNoise(uint texel) { return blueNoise.texels[texel]; }
float loadShadowDepth(ivec2 texel) { return texelFetch(shadowMap, texel, 0).r; }
#include "shaders/blue_noise.glsl"
#include "shaders/shadow_map.glsl"

SceneLights sceneLights() { return params.lights; }
LampParams loadLamp(uint index) { return lampBlock.lamps[index]; }
uint lampCount() { return lampBlock.count; }

// Uses the first cascade that contains the point; they are ordered from fine to coarse.
float sunMapVisibility(vec3 p, vec3 normal) {
    if (sunShadows != sunShadowMap) {
        return sunShadows == sunShadowNone ? 1.0 : -1.0;
    }
    ivec2 side = textureSize(shadowMap, 0) / (params.sun.count > 1u ? 2 : 1);
    for (uint i = 0u; i < params.sun.count; ++i) {
        ShadowTile tile = ShadowTile(cascadeTileOrigin(i, uint(side.x)), side);
        ShadowReceiver receiver = slopeReceiver(p, normal, params.sun.maps[i], tile, params.shadowBias, rounding(p));
        if (all(greaterThan(receiver.at, vec2(1.0))) && all(lessThan(receiver.at, vec2(side) - 1.0))) {
            return hardVisibility(receiver);
        }
    }
    return -1.0;
}
#include "effects/lobe/last_frame.glsl"

uint probeCount() { return probeBlock.count; }
ProbeParams loadProbe(uint index) { return probeBlock.probes[index]; }
#include "effects/probe/probes.glsl"
#include "renderer/trace_scene/scene_light.glsl"
#include "renderer/trace_scene/cached_light.glsl"

#include "renderer/trace_scene/scene_path.glsl"

// Starts at the surface, not at the end of the screen-space march, which misses geometry thinner than a pixel (in the
// built-in scene cave that loses a tenth of the light).
SceneRay rayOfPixel(ivec3 slot, Ray ray) {
    float d = texelFetch(ownDepth, slot.xy, 0).r;
    vec3 p = rayOrigin(slot, d, params.own);
    vec3 n = unpackUnitVector(texelFetch(ownGeometricNormal, slot.xy, 0).r);
    float away = depthToViewDistance(d, params.own.depthToDistance);
    float roughness = unpackMaterial(texelFetch(material, slot.xy, 0)).roughness;
    float lobeWidth = lobe == 0u ? 1.0 : ggxConeTangent(roughness * roughness);
    float pixelWidth = params.own.pixelAngle * (params.own.eye.w > 0.0 ? away : 1.0);
    return SceneRay(p + n * clearanceOfPixel(p, away, params.own.depthToDistance, pixelWidth), ray.direction, pixelWidth,
                    params.own.pixelAngle * params.own.eye.w + shareOfLobe * lobeWidth,
                    lobe == lobeDiffuse ? 1.0 : roughness);
}

// Whether the ray is within the ray budget, chosen by blue noise.
bool isChosen(ivec3 slot) {
    float chance = params.rayLimit / float(waiting.count);
    uint stream = params.firstRay + uint(slot.z) + 16u * lobe + hashPcg(params.own.seed + 7u);
    return hashToUnit(blueNoiseShift(uvec2(slot.xy), stream, params.own.frame).x) < chance;
}

// Writes the motion of the reflected image caused by the hit object's own motion, if the hit is visible on screen.
// Otherwise its previous position is unknown.
void writeReflectionMotion(ivec2 pixel, SceneRay ray, float hitDistance) {
    vec3 hit = ray.origin + ray.direction * hitDistance;
    OnScreen s = findOnScreen(hit);
    vec3 displacement = isShown(s, hit) ? displacementAt(s.pixel, s.shown) : vec3(0.0);
    if (displacement != vec3(0.0)) {
        vec2 moved = mirroredMotion(ray.origin, directionToEye(ray.origin, params.own.eye), ray.direction, hitDistance,
                                    displacement, params.own.previousWorldToClip);
        imageStore(imageMotion, pixel, vec4(moved, 0.0, 0.0));
    }
}

RayAnswer answerRay(inout WaitingRay w, Ray ray) {
    uint stream = ((params.firstRay + uint(w.slot.z)) * 2u + lobe) * 4u + hashPcg(params.own.seed + 3u);
    uint random = hashPixel(uvec2(w.slot.xy), stream, params.own.frame);
    float hitDistance;
    SceneRay traced = rayOfPixel(w.slot, ray);
    uint channel = (hashPixel(uvec2(w.slot.xy), stream, 0u) % 3u + params.own.frame) % 3u;
    SplitHit split;
    vec3 lightThere;
    vec3 radiance = radianceAlong(traced, ray.highlighted, channel, random, split, lightThere, hitDistance);
    if (hitDistance < 0.0) {
        w.lost = false;
        w.clear = largestHalf;  // known to hit nothing
        return RayAnswer(vec3(0.0), 0.0, 0.0);
    }
    if (tellsMotion != 0u && w.slot.z == 0) {
        writeReflectionMotion(w.slot.xy, traced, hitDistance);
    }
    if (splitsHits != 0u && split.known) {
        imageStore(hitLight, w.slot, vec4(clampToHalf(lightThere), 1.0));
        imageStore(hitFactor, w.slot, vec4(clampToHalf(w.rest * split.factor), min(split.away, largestHalf)));
        imageStore(hitNormal, w.slot, uvec4(packUnitVector(split.normal)));
    }
    return RayAnswer(radiance, 1.0, hitDistance);
}

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    for (uint i = gl_GlobalInvocationID.x; i < waiting.count; i += stride) {
        WaitingRay w = unpackWaitingRay(waiting.items[i]);
        Ray ray = unpackRay(imageLoad(direction, w.slot).xy);
        RayAnswer a = RayAnswer(vec3(0.0), 0.0, 0.0);
        if (ray.spread == 0.0 && isChosen(w.slot)) {
            a = answerRay(w, ray);
        }
        w.rest = addAnswer(w.slot, a, w.rest, sourceScene);
        if (w.rest > 0.0) {
            appendRay(w);
        }
    }
}
