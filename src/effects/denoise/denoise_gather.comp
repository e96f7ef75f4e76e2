// First denoising pass: firefly clamp with the excess spread over neighbours, then temporal accumulation with the
// reprojected history.
// In: firefly limits, surfaces, motion, radiance with hit distance, motion of reflected images, history. Out: the mean,
// with hit distance; the same as history; surfaces; moments: history length, mean squared luminance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/ray_tiles.glsl"
#include "effects/denoise/denoise.glsl"
#include "effects/denoise/keeps_jitter.glsl"
#include "effects/gbuffer/gbuffer.h"
#include "shaders/noise.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 1) const uint hasImageMotion = 0u;
// 0: all pixels have the same ray count. Else the mean count of adaptive sampling: pixels are weighted by their count,
// and pixels without rays have a negative hit distance.
layout(constant_id = 2) const uint meanRays = 0u;

layout(constant_id = 3) const uint hasDirectional = 0u;
layout(constant_id = 4) const uint hasRemembered = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DenoiseGatherParams params; };
layout(rg32f) uniform readonly image2D limits;
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D material;
uniform sampler2D motion;
layout(rg16f) uniform readonly image2D imageMotion;
layout(rgba16f) uniform readonly image2D radiance;
layout(rgba16f) uniform readonly image2D previousLight;
layout(rg32ui) uniform readonly uimage2D previousSurface;
layout(rg16f) uniform readonly image2D previousMoments;
layout(rgba16f) uniform writeonly image2D nextLight;
layout(rg32ui) uniform writeonly uimage2D surface;
layout(rg16f) uniform writeonly image2D moments;
layout(rgba16f) uniform writeonly image2D gathered;
layout(rg32f) uniform readonly image2D tiles;
layout(rgba16f) uniform readonly image2D directional;
layout(rgba16f) uniform readonly image2D remembered;
layout(rgba16f) uniform readonly image2D previousDirectional;
layout(rgba16f) uniform writeonly image2D nextDirectional;
layout(rgba16f) uniform writeonly image2D gatheredDirectional;

const float heightSlack = 4.0;     // tolerance for the height of a history surface off this one, relative to that of neighbours
const float distanceSlack = 0.02;  // or relative to its distance, for moving objects
// Reflections up to the first perceptual roughness are reprojected by their virtual image, those above the second by
// their surface.
const float movesAsImage = 0.25;
const float movesAsSurface = 0.6;

// Relative difference in hit distance above which a mirror shows another object. It grows with roughness, as hit
// distances become noisy; above movesAsImage there is no limit.
const float sameThing = 0.15;
const float sameThingRough = 3.0;
// Maximum history length of moving reflections. A mirror's history is blurred by every interpolation and has no noise,
// so it is short; rougher reflections have more noise than detail.
const float framesInMotion = 1.0;
const float framesInMotionRough = 64.0;

// This frame's light of the pixel and its neighbours on the same surface.
struct Neighbourhood {
    vec4 light;     // firefly-clamped, plus the excess of neighbouring fireflies; the neighbourhood's mean hit distance, or nearness
    vec3 mean;      // of the neighbourhood
    vec3 variance;  // per pixel
    vec4 directional;  // of the light
    float found;    // pixels of the neighbourhood with rays in this frame
    bool traced;    // whether the pixel itself has rays
};

// Reprojected history.
struct HistorySample {
    vec4 light;
    float frames;  // 0: nothing
    float square;  // mean squared luminance
    vec4 directional;
};

const HistorySample noHistory = HistorySample(vec4(0.0), 0.0, 0.0, vec4(0.0));

Neighbourhood gatherNeighbourhood(ivec2 pixel, float d, ScreenPlane plane) {
    ivec2 last = ivec2(params.view.size) - 1;
    Neighbourhood s;
    s.light = vec4(0.0);
    s.directional = vec4(0.0);
    vec3 spread = vec3(0.0);
    vec3 sum = vec3(0.0);
    vec3 squares = vec3(0.0);
    float traced = 0.0;
    float away = 0.0;
    float viewDistance = depthToViewDistance(d, params.view.depthToDistance);
    float pixelWidth = params.gridAngle * (params.view.eye.w > 0.0 ? viewDistance : 1.0);
    s.found = 0.0;
    s.traced = false;
    for (int i = 0; i < 9; ++i) {
        ivec2 o = ivec2(i % 3, i / 3) - 1;
        // Beyond the image's edge its outermost pixels once more, so that each pixel's excess is taken nine times everywhere.
        ivec2 at = clamp(pixel + o, ivec2(0), last);
        vec4 texel = imageLoad(radiance, at);
        float limit = imageLoad(limits, ivec2(uvec2(at) / denoiseTileSide)).r;
        float depthStep = texelFetch(depth, at, 0).r - d;
        vec3 light = clampToHalf(texel.rgb);
        float bright = luminance(light);
        float kept = bright > limit ? limit / bright : 1.0;
        bool hasRays = meanRays == 0u || texel.a >= 0.0;
        traced += hasRays ? 1.0 : 0.0;
        spread += hasRays ? light * (1.0 - kept) : vec3(0.0);
        light *= kept;
        if (i == 4 && hasRays) {
            s.light.rgb = light;
            s.directional = hasDirectional != 0u ? kept * imageLoad(directional, at) : vec4(0.0);
            s.traced = true;
        }
        if (hasRays && at == pixel + o && onSurface(plane, vec2(o), depthStep)) {
            sum += light;
            squares += light * light;
            s.found += 1.0;
            away += clamp(lobe == 0u ? nearnessOf(texel.a, pixelWidth) : texel.a, 0.0, largestHalf);
        }
    }
    float found = max(s.found, 1.0);
    // Only pixels with rays in this frame take the excess.
    s.light.rgb += spread / (meanRays > 0u ? max(traced, 1.0) : 9.0);
    s.light.a = away / found;
    s.mean = sum / found;
    s.variance = max(squares / found - s.mean * s.mean, imageLoad(limits, pixel / int(denoiseTileSide)).g);
    return s;
}

// Whether a reflection showed the same object, by its hit distance.
bool isSameReflectedObject(float now, float before, float roughness) {
    float rough = min(roughness / movesAsImage, 1.0);
    float allowed = mix(sameThing, sameThingRough, rough * rough);
    return roughness > movesAsImage || max(now, before) <= (1.0 + allowed) * min(now, before) + 1e-3;
}

// Where a pixel's history is looked up.
struct HistoryLookup {
    vec2 at;         // pixels of the grid
    vec2 home;       // pixel of the surface point in the last frame
    float expected;  // its depth there
    float away;      // hit distance of the reflection [m]; negative: ignore it
    float most;      // maximum history length if the image moves
};

// Adds the weight of a pixel of the history and its light to the sums, if it shows a similar surface.
void addHistory(HistoryLookup w, KeptSurface own, ScreenPlane plane, ivec2 texel, float weight, inout HistorySample sum,
                inout float weights) {
    KeptSurface there = unpackSurface(imageLoad(previousSurface, texel).xy);
    vec2 away = vec2(texel) - w.home;
    float height = heightAbove(plane, away, there.depth - w.expected) / max(length(away), 1.0);
    vec4 light = imageLoad(previousLight, texel);
    // At rest what a rough mirror shows is the same, however much the distances of single rays differ.
    bool same = w.away < 0.0 || params.view.rest > 0u || isSameReflectedObject(w.away, light.a, own.roughness);
    // Directional light fits other normals, too.
    float alike = hasDirectional != 0u ? normalSimilarity(own, there) : surfaceSimilarity(own, there, lobe, 0.0);
    float allowed = heightSlack + distanceSlack / params.view.pixelAngle;
    if (!same || there.depth <= 0.0 || abs(height) > allowed || alike <= 0.3) {
        return;
    }
    vec2 m = imageLoad(previousMoments, texel).xy;
    float exposed = params.view.exposureChange;
    sum.light += weight * vec4(exposed * light.rgb, light.a);
    sum.frames += weight * m.x;
    sum.square += weight * exposed * exposed * m.y;
    if (hasDirectional != 0u) {
        sum.directional += weight * exposed * imageLoad(previousDirectional, texel);
    }
    weights += weight;
}

// Bilinear history lookup, restricted to similar surfaces. Where it finds none, the mean of the similar ones among
// 3 x 3 pixels (Schied et al. 2017): with jitter, a pixel at an edge shows one surface in some frames and another in
// others, and its neighbours know both.
HistorySample historyAt(HistoryLookup w, KeptSurface own, ScreenPlane plane) {
    ivec2 size = ivec2(params.view.size);
    vec2 nearest = round(w.at);
    // Without motion the lookup is exact.
    vec2 at = all(lessThan(abs(w.at - nearest), vec2(1.0 / 64.0))) ? nearest : w.at;
    ivec2 corner = ivec2(floor(at));
    vec2 f = at - vec2(corner);
    HistorySample sum = noHistory;
    float weights = 0.0;
    // The trip counts are dynamic on purpose: see hardVisibility (shadow_map.glsl).
    int taps = f == vec2(0.0) ? 1 : 4;
    for (int i = 0; i < taps; ++i) {
        ivec2 o = ivec2(i & 1, i >> 1);
        ivec2 texel = corner + o;
        vec2 share = mix(1.0 - f, f, vec2(o));
        if (all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, size)) && share.x * share.y > 0.0) {
            addHistory(w, own, plane, texel, share.x * share.y, sum, weights);
        }
    }
    // A mirror's history has no noise, so its neighbours would only blur it.
    int around = weights < 0.01 && w.away < 0.0 ? 9 : 0;
    for (int i = 0; i < around; ++i) {
        ivec2 texel = ivec2(nearest) + ivec2(i % 3, i / 3) - 1;
        if (all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, size))) {
            addHistory(w, own, plane, texel, 1.0, sum, weights);
        }
    }
    if (weights < 0.01) {
        return noHistory;
    }
    float frames = sum.frames / weights;
    bool jittered = params.view.jitterChange != vec2(0.0);
    float sharp = w.away < 0.0 || !jittered ? 0.0 : keepsJitter(own.roughness);
    float most = f == vec2(0.0) ? 1.0 / max(sharp, 1e-6) : w.most;
    return HistorySample(sum.light / weights, min(frames, most), sum.square / weights, sum.directional / weights);
}

vec2 pixelOf(vec4 clip) { return ndcToUv(clip.xy / clip.w) * params.view.size - 0.5; }

// Reflections are reprojected by their virtual image behind the mirror, including the reflected object's own motion;
// diffuse light and rough reflections by the surface.
HistorySample reprojectHistory(ivec2 pixel, vec3 p, KeptSurface own, ScreenPlane plane, float hitDistance) {
    vec4 before = params.view.previousWorldToClip * vec4(p, 1.0);
    float expected = before.z / before.w;
    vec2 home = vec2(pixel) - texelFetch(motion, pixel, 0).rg * params.motionToPixels;
    float asImage = lobe == 1u ? 1.0 - smoothstep(movesAsImage, movesAsSurface, own.roughness) : 0.0;
    HistorySample image = noHistory;
    if (asImage > 0.0) {
        vec3 behind = p - directionToEye(p, params.view.eye) * hitDistance;
        vec4 clip = params.view.previousWorldToClip * vec4(behind, 1.0);
        if (clip.w > 0.0) {
            vec2 at = pixelOf(clip);
            if (hasImageMotion != 0u) {
                at -= imageLoad(imageMotion, pixel).xy * params.motionToPixels;
            }
            float rough = min(own.roughness / movesAsImage, 1.0);
            float most = mix(framesInMotion, framesInMotionRough, rough * rough);
            image = historyAt(HistoryLookup(at, home, expected, hitDistance, most), own, plane);
        }
    }
    if (asImage == 1.0) {
        return image;
    }
    HistorySample still = historyAt(HistoryLookup(home, home, expected, -1.0, 1e6), own, plane);
    if (image.frames == 0.0 || still.frames == 0.0) {
        still.frames *= 1.0 - asImage;
        return image.frames > 0.0 ? image : still;
    }
    return HistorySample(mix(still.light, image.light, asImage), mix(still.frames, image.frames, asImage),
                mix(still.square, image.square, asImage), vec4(0.0));  // only reflections get here
}

// In place of a history: what the light's source knows, with the noise that the variance of single frames would have.
HistorySample rememberedHistory(ivec2 pixel, float away) {
    vec4 known = imageLoad(remembered, pixel);
    float bright = min(luminance(known.rgb), 255.0);
    return HistorySample(vec4(known.rgb, away), known.a, 2.0 * bright * bright, directionalFromAmbient(bright));
}

// History clip (variance clipping): limits the history to current neighbours, within their noise. Clipped history
// counts as fewer frames.
void clipHistory(Neighbourhood seen, inout HistorySample past) {
    float ownVariance = max(past.square - luminance(past.light.rgb) * luminance(past.light.rgb), 0.0);
    vec3 deviation = params.settings.clip * sqrt(max(seen.variance, vec3(ownVariance)));
    vec3 held = clamp(past.light.rgb, seen.mean - deviation, seen.mean + deviation);
    float moved = luminance(abs(held - past.light.rgb)) / max(luminance(past.light.rgb), 1e-6);
    past.frames *= max(1.0 - moved, 0.0);
    past.directional *= luminance(held) / max(luminance(past.light.rgb), 1e-6);
    past.light.rgb = held;
    past.square = luminance(held) * luminance(held) + ownVariance;
}

void keep(ivec2 pixel, vec4 light, vec4 turning, KeptSurface own, vec2 m) {
    uint random = hashPixel(uvec2(pixel), 71u + lobe, params.view.frame);
    light = vec4(ditherToHalf(clampToHalf(light.rgb), random), roundToHalf(light).a);
    imageStore(gathered, pixel, light);
    imageStore(surface, pixel, uvec4(packSurface(own), 0u, 0u));
    imageStore(moments, pixel, roundToHalf(vec4(m, 0.0, 0.0)));
    if (params.settings.history > 0u) {
        imageStore(nextLight, pixel, light);
    }
    if (hasDirectional != 0u) {
        turning = roundToHalf(clamp(turning, -largestHalf, largestHalf));
        imageStore(gatheredDirectional, pixel, turning);
        if (params.settings.history > 0u) {
            imageStore(nextDirectional, pixel, turning);
        }
    }
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    vec4 m = texelFetch(material, pixel, 0);
    KeptSurface own = KeptSurface(d, unpackUnitVector(texelFetch(normal, pixel, 0).r), m.r);
    if (d <= 0.0 || (lobe == 1u && (uint(m.a * 255.0 + 0.5) & materialFlagLambert) != 0u)) {
        own.depth = 0.0;
        keep(pixel, vec4(0.0), vec4(0.0), own, vec2(0.0));
        return;
    }
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    vec3 geometric = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    ScreenPlane plane = screenPlane(p, geometric, params.view.clipToWorld, params.view.pixel, params.view.pixelAngle);
    Neighbourhood seen = gatherNeighbourhood(pixel, d, plane);
    float bright = min(luminance(seen.light.rgb), 255.0);  // so that its square fits a half float
    HistorySample past = params.hasPrevious != 0u ? reprojectHistory(pixel, p, own, plane, seen.light.a) : noHistory;
    if (hasRemembered != 0u && past.frames == 0.0) {
        past = rememberedHistory(pixel, seen.light.a);
    } else if (past.frames > 0.0 && params.settings.clip > 0.0 && (meanRays == 0u || seen.found > 0.0)) {
        clipHistory(seen, past);
    }
    float count = 1.0;  // weight of this frame, in frames
    float most = float(params.settings.history);
    if (meanRays > 0u) {
        float rays = imageLoad(tiles, pixel / int(rayTileSide)).r;
        count = float(pixelRays(rays, uvec2(pixel), params.view.frame)) / float(meanRays);
        most *= rays / float(meanRays);
        if (!seen.traced) {
            // Keep the history unchanged; without one, show the neighbours' mean but do not store it.
            bool known = past.frames > 0.0;
            keep(pixel, known ? past.light : vec4(seen.mean, seen.light.a), past.directional, own,
                 known ? vec2(past.frames, past.square) : vec2(0.0));
            return;
        }
    }
    past.frames = min(past.frames, max(most - count, 0.0));
    float share = count / (past.frames + count);
    float frames = past.frames + count;
    keep(pixel, mix(past.light, seen.light, share), mix(past.directional, seen.directional, share), own,
         vec2(frames, mix(past.square, bright * bright, share)));
}
