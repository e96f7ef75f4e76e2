// Paths through the scene. Included by trace_scene.glsl after what it binds.
#ifndef REFLET_SCENE_PATH_GLSL
#define REFLET_SCENE_PATH_GLSL

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

#include "renderer/trace_scene/scene_glass.glsl"

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

// Whether a surface shows a path about what it shows the camera. Paths of one bounce follow what metals mirror alone.
bool looksTheSame(SceneSurface at) {
    float dielectric = params.bounces <= 1u ? 0.0 : 0.2;
    return at.roughness >= mix(dielectric, roughestView, at.metallic);
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

// How far a path has come.
struct Path {
    SceneRay ray;
    vec3 radiance;  // found so far
    vec3 throughput;
    bool diffuse;   // the lobe that scattered it last
    uint bounces;   // boundaries of glass are none
    Media media;
};

#include "renderer/trace_scene/split_hit.glsl"

bool isGlass(SceneSurface s) { return throughGlass != glassStraight && s.transmission > 0.0; }

// Radiance of the hit toward the path without that of further bounces. byLamps: emission that lamps stand for.
vec3 lightOfHit(Path path, SceneSurface found, LitPoint at, vec3 byLamps, inout uint random) {
    float sunVisible;
    at.surface = litForLobe(at.surface, path.ray.roughness);
    return params.view.preExposure * found.emissive - byLamps + sunAndLamps(at, random, sunVisible);
}

// Scatters the path by a lobe of the surface, or through the boundary of glass; only by this if onlyThrough.
void scatterPath(inout Path path, SceneSurface found, LitPoint at, GlassShares shares, bool onlyThrough, inout uint random) {
    float through = 0.0;
    if (isGlass(found)) {
        float glass = dot(shares.transmitted, vec3(1.0)) + 3.0 * shares.reflected;
        float rest = onlyThrough ? 0.0 : dot(at.surface.specular + at.surface.diffuse, vec3(1.0));
        through = rest > 0.0 ? clamp(glass / (glass + rest), 0.1, 0.9) : 1.0;
        if (nextRandom(random) < through) {
            path.throughput *= passGlass(at, found, shares, path.media, random, path.ray) / through;
            return;
        }
    }
    SceneRay next;
    path.throughput *= scatter(at, params.diffuseOnly != 0u, random, next, path.diffuse) / (1.0 - through);
    path.ray = next;
    ++path.bounces;
}

// Russian roulette by the path's throughput, which may become 0.
void playRoulette(inout Path path, inout uint random) {
    float survival = min(max(path.throughput.x, max(path.throughput.y, path.throughput.z)), 0.95);
    path.throughput = nextRandom(random) < survival ? path.throughput / survival : vec3(0.0);
}

// Whether the path takes the light on the screen for that of its hit.
bool endsOnScreen(Path path, SceneSurface found, inout uint random, out vec3 shown) {
    bool reuses = reuseScreen != 0u && (path.bounces == 0u || params.fromPrevious != 0u);
    // A lens magnifies the screen's pixels: at rest, less and less of it.
    reuses = reuses && (throughGlass != glassOfView || nextRandom(random) < 16.0 / (16.0 + float(params.own.rest)));
    return reuses && looksTheSame(found) && !isGlass(found) && screenLight(found, shown);
}

// Radiance along the ray from its hit. highlighted: of the ray. hitDistance: metres; negative: miss. told: gets the cells
// that the path tells what it finds. channel: of Media.chosen. split: if it is followed, the radiance is of what is split.
vec3 followPath(SceneRay ray, bool highlighted, uint channel, inout uint random, inout ToldCells told, inout SplitHit split,
                out float hitDistance) {
    Path path = Path(ray, vec3(0.0), vec3(1.0), lobe == lobeDiffuse, 0u, noMedia(channel));
    hitDistance = -1.0;
    for (uint vertex = 0u;; ++vertex) {
        SceneHit hit;
        if (!closestHit(path.ray.origin, path.ray.direction, 0.0, sceneFar, hit)) {
            hitDistance = throughGlass == glassOfView && vertex > 0u && path.bounces == 0u ? largestHalf : hitDistance;
            vec3 sky = vertex > 0u ? environmentRadiance(path.ray.direction) : vec3(0.0);
            return path.radiance + path.throughput * sky;
        }
        if (throughGlass == glassOfView && path.bounces == 0u) {
            hitDistance = vertex == 0u ? 0.0 : hitDistance + hit.distance;  // behind the glass
        } else if (vertex == 0u) {
            hitDistance = hit.distance;
        }
        float width = params.mips != 0u ? path.ray.width + path.ray.spread * hit.distance : 0.0;
        SceneSurface found = sceneSurface(hit, path.ray.direction, width);
        path.throughput *= throughGlass != glassStraight ? transmittance(path.media, hit.distance) : vec3(1.0);
        bool ofLayer = throughGlass == glassOfView && vertex == 0u && found.transmissive;  // has coverage, tint and own light
        if (!ofLayer && isGlass(found) && found.coverage < 1.0 && nextRandom(random) >= found.coverage) {
            path.ray.origin = found.position - found.geometricNormal * found.clearance;
            continue;
        }
        bool lampsStandFor = path.diffuse || (highlighted && vertex == 0u);
        vec3 byLamps = anyEmitters != 0u && lampsStandFor && found.emitter ? params.view.preExposure * found.emissive : vec3(0.0);
        vec3 shown;
        if (endsOnScreen(path, found, random, shown)) {
            return path.radiance + path.throughput * max(shown - byLamps, vec3(0.0));
        }
        LitPoint at = LitPoint(found.position, found.geometricNormal, found.normal, -path.ray.direction, found.clearance,
                               surfaceOf(found, -path.ray.direction));
        GlassShares shares = GlassShares(vec3(0.0), 0.0);
        if (isGlass(found)) {
            found.passed = ofLayer ? vec3(1.0) : found.passed;
            shares = glassShares(path.media, found, dot(at.normal, at.toViewer), at.surface);
        }
        if (ofLayer && !isGlass(found)) {
            return vec3(0.0);
        }
        if (!ofLayer) {
            path.radiance += path.throughput * lightOfHit(path, found, at, byLamps, random);
            CachedLight known = cachedLight(at, random);
            if (!isGlass(found) && endsHere(path.bounces, known, random)) {
                return path.radiance + path.throughput * lightAtEnd(at, known);
            }
        }
        Path before = path;
        scatterPath(path, found, at, shares, ofLayer, random);
        path.ray.width = width;
        splitPath(path, before, at, split);
        if (vertex + 1u >= rouletteStart) {
            playRoulette(path, random);
        }
        if (path.throughput == vec3(0.0)) {
            return path.radiance;
        }
        if (path.diffuse) {
            tellLater(told, at, path.radiance, path.throughput);
        }
    }
}

// hitLight: what is split, without its factor; the radiance is without it.
vec3 radianceAlong(SceneRay ray, bool highlighted, uint channel, inout uint random, out SplitHit split, out vec3 hitLight,
                   out float hitDistance) {
    ToldCells told;
    told.count = 0u;
    split = noSplit();
    vec3 radiance = followPath(ray, highlighted, channel, random, told, split, hitDistance);
    tellCells(told, radiance, random);
    hitLight = split.followed ? radiance : vec3(0.0);
    return split.followed ? split.radiance : radiance;
}

#endif
