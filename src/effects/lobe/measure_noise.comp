// Estimates a lobe's remaining noise in each tile, relative to the lit image, and builds a histogram of noise classes.
// One thread per tile.
// In: depth, material, base colour, motion; of the last frame the denoiser's history, the lit image, rays per tile.
// Out: material class and noise class of each tile; the histogram.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/adaptive_rays.h"
#include "effects/lobe/rays.h"
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "shaders/luminance.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint lobe = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { MeasureNoiseParams params; };
uniform sampler2D depth;
uniform sampler2D material;
uniform sampler2D baseColor;
uniform sampler2D motion;
layout(rgba16f) uniform readonly image2D previousLight;
layout(rg32ui) uniform readonly uimage2D previousSurface;
layout(rg16f) uniform readonly image2D previousMoments;
layout(rgba16f) uniform readonly image2D previousLit;
layout(rg32f) uniform readonly image2D previousTiles;
layout(rg32f) uniform writeonly image2D noise;
layout(scalar) buffer HistogramBlock { uint pixels[histogramSize]; } histogram;

float loadDepth(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
MaterialTexel loadMaterial(ivec2 pixel) { return unpackMaterial(texelFetch(material, pixel, 0)); }
#include "effects/lobe/tile_kind.glsl"

const float darkness = 0.1;      // luminance below which absolute instead of relative noise counts
const int around = 20;           // grid pixels around a tile in which its noise is measured
const int apart = 8;             // spacing of the samples there, in pixels
const float sameDistance = 0.1;  // tolerance for the distance of a reprojected surface, relative


// Approximate reflectance of the surface for the lobe.
float reflectance(ivec2 pixel) {
    MaterialTexel m = loadMaterial(pixel);
    if (isUnlit(m)) {
        return 0.0;
    }
    float base = luminance(unpackBaseColor(texelFetch(baseColor, pixel, 0).rgb));
    float dielectric = mayReflectUnusually() ? luminance(dielectricAt(pixel).rgb) : dielectricF0;
    return lobe == lobeDiffuse ? base * (1.0 - m.metallic) : mix(dielectric, base, m.metallic);
}

// Reprojects to the last frame's pixel; negative if there is none.
ivec2 previousPixelOf(ivec2 pixel, float d) {
    ivec2 home = ivec2(round(vec2(pixel) - texelFetch(motion, pixel, 0).rg * params.motionToPixels));
    if (params.hasHistory == 0u || any(lessThan(home, ivec2(0))) || any(greaterThanEqual(home, ivec2(params.view.size)))) {
        return ivec2(-1);
    }
    vec4 before = params.view.previousWorldToClip *
                  vec4(uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld), 1.0);
    float there = uintBitsToFloat(imageLoad(previousSurface, home).x);
    return abs(there * before.w / max(before.z, 1e-20) - 1.0) < sameDistance ? home : ivec2(-1);
}

// Whether the pixel has the lobe.
bool hasLobe(ivec2 pixel, float d) {
    return d > 0.0 && (lobe == lobeDiffuse || (loadMaterial(pixel).flags & materialFlagLambert) == 0u);
}

// Variance per ray of the lobe's reflected light, divided by the squared luminance of the lit image.
float varianceAt(ivec2 pixel, ivec2 home, vec2 moments) {
    float mean = min(luminance(imageLoad(previousLight, home).rgb), 255.0);
    float rays = max(imageLoad(previousTiles, home / int(rayTileSide)).r, 1.0);  // per frame
    float variance = max(moments.y - mean * mean, 0.0) * rays;
    ivec2 shown = min(home * int(params.scale) + int(params.blockOffset), ivec2(params.picture) - 1);
    float lit = luminance(imageLoad(previousLit, shown).rgb);
    float sent = reflectance(pixel);
    return variance * sent * sent / (lit * lit + darkness * darkness);
}

// The mean over the tile's surroundings: with a tile's own low sample count, the estimate often misses the cause of the
// noise or overrates it.
float varianceAround(ivec2 first) {
    ivec2 size = ivec2(params.view.size);
    ivec2 begin = max(first - around, ivec2(0));
    ivec2 end = min(first + int(rayTileSide) + around, size);
    float sum = 0.0;
    float found = 0.0;
    for (int y = begin.y + apart / 2; y < end.y; y += apart) {
        for (int x = begin.x + apart / 2; x < end.x; x += apart) {
            float d = loadDepth(ivec2(x, y));
            ivec2 home = hasLobe(ivec2(x, y), d) ? previousPixelOf(ivec2(x, y), d) : ivec2(-1);
            vec2 moments = home.x >= 0 ? imageLoad(previousMoments, home).xy : vec2(0.0);
            if (moments.x > 1.5) {
                sum += varianceAt(ivec2(x, y), home, moments);
                found += 1.0;
            }
        }
    }
    return found > 0.0 ? sum / found : 1.0;
}

// The expected change of a pixel by one more ray; it shrinks with the history length.
float noiseOfTile(ivec2 first, ivec2 end) {
    float squares = 0.0;
    float found = 0.0;
    for (int y = first.y; y < end.y; y += 2) {
        for (int x = first.x; x < end.x; x += 2) {
            ivec2 pixel = ivec2(x, y);
            float d = loadDepth(pixel);
            if (hasLobe(pixel, d)) {
                ivec2 home = previousPixelOf(pixel, d);
                float share = 1.0 / ((home.x >= 0 ? imageLoad(previousMoments, home).x : 0.0) + 1.0);
                squares += share * share;
                found += 1.0;
            }
        }
    }
    return sqrt(varianceAround(first) * (found > 0.0 ? squares / found : 1.0));
}

void main() {
    uvec2 tile = gl_GlobalInvocationID.xy;
    ivec2 first = ivec2(tile * rayTileSide);
    ivec2 size = ivec2(params.view.size);
    if (any(greaterThanEqual(first, size))) {
        return;
    }
    ivec2 end = min(first + int(rayTileSide), size);
    TileContent content = tileContent(first, end);
    uint level = 0u;
    uint pixels = content.pixels[lobe];
    if (lobe == lobeSpecular && content.kind == tileMirror) {
        atomicAdd(histogram.pixels[noiseClasses], pixels);
    } else if (pixels > 0u) {
        float octaves = log2(max(noiseOfTile(first, end), 1e-12));
        level = uint(clamp(round(noiseClassOfOne + noiseClassesPerOctave * octaves), 0.0, float(noiseClasses - 1u)));
        atomicAdd(histogram.pixels[level], pixels);
    }
    imageStore(noise, ivec2(tile), vec4(content.kind, level, 0.0, 0.0));
}
