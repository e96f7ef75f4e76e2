// The two layers of depth of field: what is in front of the plane of focus, and the rest.
#ifndef REFLET_DOF_LAYERS_GLSL
#define REFLET_DOF_LAYERS_GLSL

#include "effects/depth_of_field/depth_of_field.h"
#include "effects/levels.glsl"

// Squared radius, in pixels of half resolution, of the smallest disk that the layers can make.
const float leastDisk = 1.42;

// Share of the layers in a pixel with a circle of confusion of this radius; the rest is drawn at full resolution. full: largest
// radius there (DofSizes). Between that and the layers' smallest disk both are mixed, with the right second moment.
float blurredShare(float coc, float full) {
    float least = max(4.0 * leastDisk, (full + 0.5) * (full + 0.5));
    return clamp((coc * coc - full * full) / (least - full * full), 0.0, 1.0);
}

// Radius of what is drawn at full resolution; 0: in focus, or nothing is.
float fullRadius(float coc, float full) {
    return abs(coc) > 0.5 && blurredShare(coc, full) < 1.0 ? min(abs(coc), full) : 0.0;
}

// Share of a pixel that belongs to the near layer, and share that is blurred of what is in the background.
float nearShare(float coc, float full) { return coc < 0.0 ? blurredShare(coc, full) : 0.0; }
float farShare(float coc, float full) { return coc > 0.0 ? blurredShare(coc, full) : 0.0; }

// Sharp content has this weight against blurred content of the same cell.
const float sharpWeight = 1e-4;

// Between these radii [pixels of half resolution] disks change from small to large.
const vec2 large = vec2(4.0, 5.5);
float largeShare(float radius) { return clamp((radius - large.x) / (large.y - large.x), 0.0, 1.0); }

// A cell of the background.
struct Ground {
    vec3 light;      // radiance
    float presence;  // share of the cell that the background covers
    float coc;       // radius [pixels of half resolution], not negative
    float far;       // share of what is present that is blurred
};

// A cell of the near layer.
struct Front {
    vec4 light;  // radiance · coverage, coverage
    float coc;   // radius [pixels of half resolution], positive
};

// Sums up cells.
struct GroundSum {
    vec4 light;  // radiance · weight, weight
    vec3 rest;   // coc · its weight, that weight; far · presence
    float presence;
};

struct FrontSum {
    vec4 light;
    vec2 coc;  // · weight, weight
};

// The radius of a mixed cell is that of its bright content, which is seen to be blurred.
float brightness(vec3 light) { return 1e-3 + max(light.r, max(light.g, light.b)); }

// Highlights are brighter than the tile's darkness by the first factor, and keep as much as the second leaves.
const vec2 highlight = vec2(16.0, 2.0);
// Radius [pixels of the picture]: disks of neighbouring blocks that are smaller would not join. block: side of a block.
float leastHighlight(uint block) { return 0.75 * float(block); }

// Share of a pixel's light that is drawn apart, at full resolution. darkness: harmonic mean of the tile's brightness; 0: none is.
float highlightShare(vec3 light, float coc, float darkness, uint block) {
    float bright = brightness(light);
    bool apart = darkness > 0.0 && bright > highlight.x * darkness && abs(coc) > leastHighlight(block);
    return apart ? 1.0 - highlight.y * darkness / bright : 0.0;
}

// Blocks along the side of a tile.
int tileBlocks(uint block) { return int(2u * dofTile / block); }

void add(inout GroundSum sum, Ground g) {
    float weight = g.presence * (sharpWeight + (1.0 - sharpWeight) * g.far);
    float bright = weight * brightness(g.light);
    sum.light += weight * vec4(g.light, 1.0);
    sum.rest += vec3(bright * g.coc, bright, g.presence * g.far);
    sum.presence += g.presence;
}

void add(inout FrontSum sum, Front n) {
    float bright = brightness(n.light.rgb) * n.light.a;
    sum.light += n.light;
    sum.coc += bright * vec2(n.coc, 1.0);
}

// cells: that a mean is taken over, with those that are empty.
Ground meanOf(GroundSum sum, float cells) {
    float some = max(sum.presence, 1e-12);
    return Ground(sum.light.rgb / max(sum.light.a, 1e-12), sum.presence / cells, sum.rest.x / max(sum.rest.y, 1e-12),
                  sum.rest.z / some);
}

Front meanOf(FrontSum sum, float cells) { return Front(sum.light / cells, sum.coc.x / max(sum.coc.y, 1e-20)); }

#endif
