// Distributes a ray budget over tiles by their noise. Every group first finds the ray count for a noise of 1 that
// spends the budget; then each thread handles a tile. In: the histogram, material class and noise class per tile. Out:
// rays per pixel of each tile, the list of tiles with rays.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/adaptive_rays.h"
#include "effects/lobe/rays.h"

layout(constant_id = 0) const uint lobe = 0u;

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { ShareRaysParams params; };
layout(scalar) readonly buffer HistogramBlock { uint pixels[histogramSize]; } histogram;
layout(rg32f) uniform readonly image2D noise;
layout(rg32f) uniform writeonly image2D tiles;
layout(scalar) buffer ListBlock {
    uint groups[3];
    uint count;
    uint items[];
} list;
#include "effects/lobe/ray_tiles_append.glsl"

// Ray counts are proportional to noise to this power. 1 would be optimal for known noise, but an estimate from few
// frames is not reliable: with 1 (and a minimum of a quarter of the mean) the error of an evenly noisy image, cave
// after 8 frames of one ray, rose by 13 %.
const float follow = 0.5;

shared uint best;

// Rays per pixel of a noise class. scale: log2 of the rays for a noise of 1.
float raysOf(uint level, float scale) {
    float rays = exp2(scale + follow * (float(level) - noiseClassOfOne) / noiseClassesPerOctave);
    return floor(clamp(rays, params.least, params.most) * float(rayShares)) / float(rayShares);
}

// Whether this scale stays within the budget.
bool withinBudget(float scale) {
    float spent = 0.0;
    float noisy = 0.0;
    for (uint i = 0u; i < noiseClasses; ++i) {
        float pixels = float(histogram.pixels[i]);
        spent += pixels * raysOf(i, scale);
        noisy += pixels;
    }
    float mirrors = float(histogram.pixels[noiseClasses]);
    return spent <= noisy * float(params.mean) + mirrors * (float(params.mean) - float(params.mirror));
}

// The largest scale within the budget, by a 64-ary search.
float findScale() {
    uint thread = gl_LocalInvocationIndex;
    float scale = -16.0;
    for (float stepSize = 0.5; stepSize > 1e-4; stepSize /= 64.0) {
        if (thread == 0u) {
            best = 0u;
        }
        barrier();
        if (withinBudget(scale + float(thread) * stepSize)) {
            atomicMax(best, thread);
        }
        barrier();
        scale += float(best) * stepSize;
        barrier();
    }
    return scale;
}

void main() {
    float scale = findScale();
    uvec2 tile = uvec2(gl_GlobalInvocationID.x % params.tiles.x, gl_GlobalInvocationID.x / params.tiles.x);
    if (tile.y >= params.tiles.y) {
        return;
    }
    vec2 known = imageLoad(noise, ivec2(tile)).rg;
    uint kind = uint(known.x);
    float rays = kind == tileSky || (lobe == lobeSpecular && kind == tileMatt) ? 0.0 : raysOf(uint(known.y), scale);
    if (lobe == lobeSpecular && kind == tileMirror) {
        rays = float(params.mirror);
    }
    imageStore(tiles, ivec2(tile), vec4(rays, kind, 0.0, 0.0));
    if (rays > 0.0) {
        appendTile(tile);
    }
}
