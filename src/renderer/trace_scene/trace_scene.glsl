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

const uint rouletteStart = 4u;  // bounces before Russian roulette starts
// Footprint of a scattered ray relative to its lobe's width, small enough for the blur to be invisible.
const float shareOfLobe = 0.1;

// A ray with its footprint.
struct SceneRay {
    vec3 origin;
    vec3 direction;
    float width;      // of the footprint at the origin [m]
    float spread;     // growth of the footprint per metre
    float roughness;  // of the lobe that scattered it; 1: diffuse
};

// A point's projection on screen and the surface visible there.
struct OnScreen {
    bool inside;  // within the screen and in front of the camera
    ivec2 pixel;
    vec2 uv;      // of the point
    float depth;  // of the pixel, 0: sky
    vec3 shown;   // the point that the pixel shows
    vec3 normal;  // its geometric one
};

OnScreen findOnScreen(vec3 position) {
    OnScreen s;
    vec4 clip = params.view.worldToClip * vec4(position, 1.0);
    s.uv = ndcToUv(clip.xy / clip.w);
    s.inside = clip.w > 0.0 && clip.z <= clip.w && all(greaterThanEqual(s.uv, vec2(0.0))) && all(lessThan(s.uv, vec2(1.0)));
    s.pixel = s.inside ? ivec2(s.uv * params.view.size) : ivec2(0);
    s.depth = texelFetch(depth, s.pixel, 0).r;
    s.shown = uvToWorld(pixelToUv(s.pixel, params.view.pixel), max(s.depth, 1e-12), params.view.clipToWorld);
    s.normal = unpackUnitVector(texelFetch(geometricNormal, s.pixel, 0).r);
    return s;
}

// Whether the point lies on the surface that the pixel shows.
bool isShown(OnScreen s, vec3 position) {
    float away = dot(params.view.viewPlane, vec4(position, 1.0));
    float pixelWidth = params.view.pixelAngle * (params.view.eye.w > 0.0 ? away : 1.0);
    return s.inside && s.depth > 0.0 && abs(dot(position - s.shown, s.normal)) < 0.1 * pixelWidth &&
           distance(position, s.shown) < 4.0 * pixelWidth;
}

// Radiance stored on screen for a hit that is visible to the camera. Depth is sampled at the pixel's centre, so on
// slanted surfaces it may be off by half a pixel.
bool screenLight(SceneSurface at, out vec3 radiance) {
    radiance = vec3(0.0);
    OnScreen s = findOnScreen(at.position);
    if (at.hiddenBack || !isShown(s, at.position) || dot(at.geometricNormal, s.normal) <= 0.99) {
        return false;
    }
    if (params.fromPrevious == 0u) {
        radiance = imageLoad(light, s.pixel).rgb;
        return true;
    }
    vec2 uv = uvInLastFrame(s.pixel, s.uv);
    bool shown = wasShown(uv, s.pixel, s.shown, s.normal);
    if (shown) {
        radiance = imageLoad(previousLit, ivec2(uv * params.view.size)).rgb;
    }
    return shown;
}

Surface surfaceOf(SceneSurface at, vec3 toViewer) {
    if (at.unlit) {
        return blackSurface();
    }
    bool lambert = params.lights.lambertOnly != 0u;
    float nv = dot(at.normal, toViewer);
    vec2 table = lambert ? vec2(0.0) : textureLod(ggxTable, ggxTableUv(nv, at.roughness), 0.0).rg;
    vec4 dielectric = vec4(dielectricF0 * at.reflectance.rgb, at.reflectance.a);
    return makeSurface(at.baseColor, at.metallic, at.roughness, dielectric, table, lambert);
}

// Samples the next ray of a path from one of the two lobes and returns its throughput. 0: it would go below the
// surface.
vec3 scatter(LitPoint at, bool diffuseOnly, inout uint random, out SceneRay next, out bool diffuse) {
    float specularLight = dot(at.surface.specular, vec3(1.0));
    float both = specularLight + dot(at.surface.diffuse, vec3(1.0));
    float chance = both > 0.0 ? specularLight / both : 0.0;
    chance = diffuseOnly ? 0.0 : chance > 0.0 && chance < 1.0 ? clamp(chance, 0.1, 0.9) : chance;
    float choice = nextRandom(random);
    vec2 u = nextRandom2(random);
    diffuse = choice >= chance;
    mat3 frame = basisAround(at.normal);
    vec3 l;
    vec3 weight;
    float lobeWidth = 1.0;
    if (!diffuse) {
        vec3 eye = at.toViewer * frame;
        eye = normalize(vec3(eye.xy, max(eye.z, 1e-3)));
        float alpha = at.surface.roughness * at.surface.roughness;
        bool mirror = at.surface.roughness <= mirrorRoughness;
        vec3 h = mirror ? vec3(0.0, 0.0, 1.0) : sampleGgxVisible(u, eye, alpha);
        l = 2.0 * dot(eye, h) * h - eye;
        float a2 = alpha * alpha;
        float unmasked = mirror ? 1.0 : ggxVisibility(max(l.z, 0.0), eye.z, alpha) * 2.0 * max(l.z, 0.0) *
                                            (eye.z + sqrt(eye.z * eye.z * (1.0 - a2) + a2));
        weight = fresnelSchlick(at.surface.f0, at.surface.f90, dot(eye, h)) * at.surface.compensation * (unmasked / chance);
        lobeWidth = ggxConeTangent(alpha);
    } else {
        l = sampleCosineHemisphere(u);
        weight = at.surface.diffuse / (1.0 - chance);
    }
    vec3 towards = frame * l;
    next = SceneRay(at.position + at.geometricNormal * at.clearance, towards, 0.0, shareOfLobe * lobeWidth,
                    diffuse ? 1.0 : at.surface.roughness);
    return l.z > 0.0 && dot(towards, at.geometricNormal) > 0.0 ? weight : vec3(0.0);
}

const float roughest = 0.5;  // rougher lobes are taken for hemispheres

vec3 probesOrEnvironment(vec3 position, vec3 direction, float roughness, bool hemisphere) {
    ProbeQuery q = ProbeQuery(position, direction, roughness, hemisphere, ProbeParallax_depth, 1e6, -1.0);
    vec4 seen = sampleProbes(q).seen;
    if (seen.a >= 1.0) {
        return seen.rgb;
    }
    vec3 behind = hemisphere ? environmentIrradianceOverPi(direction) : environmentLobe(direction, roughness);
    return seen.rgb + (1.0 - seen.a) * behind;
}

// What arrives at the point besides light of sun and lamps, as the probes know it, reflected to the viewer.
vec3 probeLight(LitPoint at) {
    vec3 from = at.position + at.geometricNormal * at.clearance;
    vec3 around = probesOrEnvironment(from, at.normal, 0.0, true);
    vec3 mirrored = around;
    if (at.surface.roughness < roughest) {
        mirrored = probesOrEnvironment(from, reflect(-at.toViewer, at.normal), at.surface.roughness, false);
    }
    return at.surface.diffuse * around + at.surface.specular * mirrored;
}

// Whether a surface shows a path about what it shows the camera. Paths of more bounces know better.
bool looksTheSame(SceneSurface at) {
    return params.bounces <= 1u || at.roughness >= mix(0.2, roughest, at.metallic);
}

// Light of further bounces where a path ends, reflected to the viewer. known: of the cache.
vec3 lightAtEnd(LitPoint at, CachedLight known) {
    if (known.weight <= 0.0) {
        return endsInProbes != 0u ? probeLight(at) : vec3(0.0);
    }
    vec3 mirrored = known.radiance;
    if (at.surface.roughness < roughest && endsInProbes != 0u) {
        mirrored = probesOrEnvironment(at.position + at.geometricNormal * at.clearance,
                                       reflect(-at.toViewer, at.normal), at.surface.roughness, false);
    }
    return at.surface.diffuse * known.radiance + at.surface.specular * mirrored;
}

const float causticBlur = 0.3;

// The surface as sun and lamps light it for a ray that a lobe of this roughness has scattered. Rough lobes meet the
// highlights of smooth surfaces so rarely that each would be a firefly. So these are at least `causticBlur` times as
// rough as the lobe: caustics are blurred, their light is kept (Kaplanyan and Dachsbacher 2013, "Path Space
// Regularization Framework").
Surface litForLobe(Surface s, float roughness) {
    if (anyReflected != 0u && s.roughness <= smoothestMirror && roughness > smoothestMirror) {
        s.f0 = vec3(0.0);  // reflected suns bring what mirrors show of the sun to other surfaces
        s.f90 = 0.0;
    }
    s.roughness = max(s.roughness, causticBlur * roughness);
    return s;
}

// Radiance along the ray from its hit. highlighted: of the ray. hitDistance: metres; negative: miss. told: gets the cells
// that the path tells what it finds.
vec3 followPath(SceneRay ray, bool highlighted, inout uint random, inout ToldCells told, out float hitDistance) {
    vec3 radiance = vec3(0.0);
    vec3 throughput = vec3(1.0);
    hitDistance = -1.0;
    bool diffuse = lobe == lobeDiffuse;
    for (uint bounce = 0u;; ++bounce) {
        SceneHit hit;
        if (!closestHit(ray.origin, ray.direction, 0.0, sceneFar, hit)) {
            return radiance + (bounce > 0u ? throughput * environmentRadiance(ray.direction) : vec3(0.0));
        }
        hitDistance = bounce == 0u ? hit.distance : hitDistance;
        float width = params.mips != 0u ? ray.width + ray.spread * hit.distance : 0.0;
        SceneSurface found = sceneSurface(hit, ray.direction, width);
        vec3 emitted = params.view.preExposure * found.emissive;
        bool lampsStandFor = diffuse || (highlighted && bounce == 0u);
        vec3 byLamps = anyEmitters != 0u && lampsStandFor && found.emitter ? emitted : vec3(0.0);
        vec3 shown;
        if (reuseScreen != 0u && looksTheSame(found) && (bounce == 0u || params.fromPrevious != 0u) && screenLight(found, shown)) {
            return radiance + throughput * max(shown - byLamps, vec3(0.0));
        }
        LitPoint at = LitPoint(found.position, found.geometricNormal, found.normal, -ray.direction, found.clearance,
                               surfaceOf(found, -ray.direction));
        float sunVisible;
        LitPoint lit = at;
        lit.surface = litForLobe(at.surface, ray.roughness);
        radiance += throughput * (emitted - byLamps + sunAndLamps(lit, random, sunVisible));
        CachedLight known = cachedLight(at, random);
        if (endsHere(bounce, known, random)) {
            return radiance + throughput * lightAtEnd(at, known);
        }
        SceneRay next;
        throughput *= scatter(at, params.diffuseOnly != 0u, random, next, diffuse);
        next.width = width;
        if (bounce + 1u >= rouletteStart) {
            float survival = min(max(throughput.x, max(throughput.y, throughput.z)), 0.95);
            throughput = nextRandom(random) < survival ? throughput / survival : vec3(0.0);
        }
        if (throughput == vec3(0.0)) {
            return radiance;
        }
        if (diffuse) {
            tellLater(told, at, radiance, throughput);
        }
        ray = next;
    }
}

vec3 radianceAlong(SceneRay ray, bool highlighted, inout uint random, out float hitDistance) {
    ToldCells told;
    told.count = 0u;
    vec3 radiance = followPath(ray, highlighted, random, told, hitDistance);
    tellCells(told, radiance, random);
    return radiance;
}

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
    vec3 radiance = radianceAlong(traced, ray.highlighted, random, hitDistance);
    if (hitDistance < 0.0) {
        w.lost = false;
        w.clear = largestHalf;  // known to hit nothing
        return RayAnswer(vec3(0.0), 0.0, 0.0);
    }
    if (tellsMotion != 0u && w.slot.z == 0) {
        writeReflectionMotion(w.slot.xy, traced, hitDistance);
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
