// Gathers both layers in the tiles of a list. In: the layers with their mips, reach of the tiles, the list. Out: the blurred
// background, and the near layer with its coverage.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"
#include "effects/depth_of_field/dof_shape.glsl"
#include "effects/depth_of_field/dof_tile_lists.glsl"

layout(constant_id = 1) const uint coarse = 0u;  // 1: large disks, at a quarter of the picture's size; 0: the rest, and both together
layout(constant_id = 2) const uint hasFront = 0u;   // 1: tiles that disks of the near layer reach

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofGatherParams params; };
layout(rgba16f) uniform readonly image2D ground;
layout(rg16f) uniform readonly image2D groundBlur;
layout(rgba16f) uniform readonly image2D front;
layout(rg16f) uniform readonly image2D frontBlur;
layout(rgba16f) uniform readonly image2D reach;
layout(rgba16f) uniform readonly image2D groundCoarse;  // of the pass with coarse = 1
layout(rgba16f) uniform readonly image2D frontCoarse;
layout(rgba16f) uniform writeonly image2D groundOut;  // radiance, blurred share
layout(rgba16f) uniform writeonly image2D frontOut;   // radiance · coverage, coverage
layout(r32ui) uniform readonly uimage2D tileLists;

ivec2 cells = ivec2(params.half2);
const float leastRadius = 0.25;  // smaller disks are points
float pixelSide = float(1u + coarse);  // in pixels of half resolution

Ground loadGround(ivec2 cell, int level) {
    ivec2 at = levelPlace(cell, level, cells);
    vec4 light = imageLoad(ground, at);
    vec2 blur = imageLoad(groundBlur, at).rg;
    return Ground(light.rgb, light.a, blur.x, blur.y);
}

Front loadFront(ivec2 cell, int level) {
    ivec2 at = levelPlace(cell, level, cells);
    return Front(imageLoad(front, at), imageLoad(frontBlur, at).r);
}

// The background of a cell of a level; where the near layer hides it, that of coarser levels.
Ground filledGround(ivec2 cell, int ownLevel) {
    Ground own = loadGround(cell, ownLevel);
    // Levels are looked up only in a hole.
    int from = own.presence < 0.999 ? int(dofLevels) - 1 : ownLevel;
    vec2 at = (vec2(cell) + 0.5) * float(1 << ownLevel);
    vec4 light = vec4(0.0);  // radiance, how much of it is known
    vec2 blur = vec2(0.0);
    for (int level = from; level > ownLevel; --level) {
        vec2 place = at / float(1 << level) - 0.5;
        vec2 part = fract(place);
        ivec2 last = levelSize(cells, level) - 1;
        GroundSum sum = GroundSum(vec4(0.0), vec3(0.0), 0.0);
        for (int i = 0; i < 4; ++i) {
            ivec2 corner = ivec2(i & 1, i >> 1);
            vec2 w = mix(1.0 - part, part, vec2(corner));
            Ground g = loadGround(clamp(ivec2(floor(place)) + corner, ivec2(0), last), level);
            g.presence *= w.x * w.y;
            add(sum, g);
        }
        Ground g = meanOf(sum, 1.0);
        float known = min(2.0 * g.presence, 1.0);
        light = mix(light, vec4(g.light, 1.0), known);
        blur = mix(blur, vec2(g.coc, g.far), known);
    }
    float hole = light.a > 0.0 ? 1.0 - min(own.presence * 2.0, 1.0) : 0.0;
    return Ground(mix(own.light, light.rgb / max(light.a, 1e-6), hole), own.presence, mix(own.coc, blur.x, hole),
                  mix(own.far, blur.y, hole));
}

// The cells of mips that are looked up for disks up to a radius. All that a disk may cover are, each once: so disks are even, and
// keep their light.
struct Disk {
    int level;     // of the mips
    float side;    // of a cell, in pixels of half resolution
    ivec2 first;   // cell that steps start from
    vec2 toFirst;  // its centre, from the pixel's
    float area;    // of a cell over that of the aperture's shape with radius 1
    float blur;    // squared radius by which cells and upsampling widen a disk's second moment
    float reach;   // from the pixel to the centres of the farthest cells; negative: there are none
};

// From the pixel to its cell's centre, at most, and half a disk's edge, in cells.
const float margin = 0.7072 + 0.5;
const float mostReach = 7.1;  // cells; cuts disks that are too large for the coarsest level

// Radius of a disk that is made smaller by as much as it is blurred; smaller ones would show the cells.
float spreadRadius(Disk d, float radius) { return sqrt(max(radius * radius - d.blur, 0.5 * d.side * d.side)); }

// at: in pixels of half resolution.
Disk diskOf(vec2 at, float radius) {
    Disk d;
    float most = sqrt(float(params.samples) * 0.31831) - margin;
    d.level = int(clamp(ceil(log2(max(radius, 0.01) / most)), 0.0, float(dofLevels - 1u)));
    d.side = float(1 << d.level);
    d.first = ivec2(at) >> d.level;
    d.toFirst = (vec2(d.first) + 0.5) * d.side - at;
    d.area = params.disk * d.side * d.side;
    d.blur = 0.75 * d.side * d.side + 0.6667 * pixelSide * pixelSide;  // the last: upsampling
    d.reach = radius < leastRadius ? -1.0 : min(spreadRadius(d, radius) + 0.5 * d.side, mostReach * d.side);
    return d;
}

// A disk that a cell's light is spread over. `weight`: the cell's area over its own.
struct Spread {
    float radius;
    float weight;
};

Spread spreadOf(Disk d, float radius) {
    float edge = 0.5 * d.side;
    float spread = spreadRadius(d, radius);
    return Spread(spread, d.area / (spread * spread + 0.3333 * edge * edge));
}

// How much of a cell's light reaches a point that is so far away.
float reaches(Spread s, float away, float perSide) { return s.weight * clamp((s.radius - away) * perSide + 0.5, 0.0, 1.0); }

// Steps over the cells of a disk, row by row. Computed, as CPU devices read tables of steps slower than images.
struct Step {
    vec2 go;    // cells from the first
    float end;  // last of the row
};

Step rowOf(Disk d, float y) {
    vec2 way = d.toFirst / d.side;
    float reach = d.reach / d.side;
    float width = sqrt(max(reach * reach - (way.y + y) * (way.y + y), 0.0));
    return Step(vec2(ceil(-width - way.x), y), floor(width - way.x));
}

Step firstStep(Disk d) { return rowOf(d, ceil(-(d.reach + d.toFirst.y) / d.side)); }

bool within(Disk d, Step s) { return s.go.y * d.side + d.toFirst.y <= d.reach; }

Step next(Disk d, Step s) {
    Step row = rowOf(d, s.go.y + 1.0);
    return s.go.x < s.end ? Step(s.go + vec2(1.0, 0.0), s.end) : row;
}

ivec2 cellAfter(Disk d, Step s) { return clamp(d.first + ivec2(s.go), ivec2(0), levelSize(cells, d.level) - 1); }

vec2 wayAfter(Disk d, Step s) { return d.toFirst + d.side * s.go; }

// The background, composited by distance: what is not farther than the point has the coverage of its disks, and what is farther
// shows through the rest. What is sharp, or hidden, counts as unknown.
vec3 blurredGround(vec2 at, Ground own, float most) {
    bool inRange = coarse != 0u ? own.coc > large.x : own.coc < large.y;
    float radius = own.far > 0.0 && inRange ? min(max(own.coc, most), 2.0 * own.coc) : 0.0;
    Disk d = diskOf(at, radius);
    Spread ownSpread = spreadOf(d, own.coc);
    float perSide = 1.0 / d.side;
    vec2 isBehind = vec2(1.0, -1.1 * own.coc - 0.25) / (0.2 * own.coc + 0.5);
    vec4 here = vec4(0.0);
    vec4 behind = vec4(0.0);
    float known = 0.0;
    float whole = 1e-6;
    for (Step go = firstStep(d); within(d, go); go = next(d, go)) {
        // The pixel is on the other side of the cell's disk.
        float away = shapeLength(-wayAfter(d, go), params.turn, params.blades);
        Ground g = loadGround(cellAfter(d, go), d.level);
        float seen = g.presence * g.far;
        float weight = seen * reaches(spreadOf(d, g.coc), away, perSide);
        vec4 light = weight * vec4(g.light, 1.0);
        vec4 farther = clamp(g.coc * isBehind.x + isBehind.y, 0.0, 1.0) * light;
        here += light - farther;
        behind += farther;
        float inside = reaches(ownSpread, away, perSide);
        known += seen * inside;
        whole += inside;
    }
    here /= max(known, 0.25 * whole);
    here *= min(2.0 / max(here.a, 1e-6), 1.0);
    float open = max(1.0 - here.a, 0.0);
    vec3 blurred = behind.a > 1e-4 ? here.rgb + open * behind.rgb / behind.a : here.rgb / clamp(here.a, 1e-4, 1.0);
    return here.a + behind.a > 1e-3 ? blurred : own.light;
}

// most: largest radius of the disks that reach the tile; mostSmall: the same of small ones.
vec4 blurredFront(vec2 at, float most, float mostSmall) {
    float radius = coarse == 0u ? mostSmall : most > large.x ? most : 0.0;
    Disk d = diskOf(at, radius);
    Spread largest = spreadOf(d, radius);
    float perSide = 1.0 / d.side;
    vec4 sum = vec4(0.0);
    float whole = 1e-6;
    for (Step go = firstStep(d); within(d, go); go = next(d, go)) {
        float away = shapeLength(wayAfter(d, go), params.turn, params.blades);  // disks in front of the plane of focus are turned by half a turn
        Front n = loadFront(cellAfter(d, go), d.level);
        float isLarge = largeShare(n.coc);
        sum += (coarse != 0u ? isLarge : 1.0 - isLarge) * reaches(spreadOf(d, n.coc), away, perSide) * n.light;
        whole += reaches(largest, away, perSide);
    }
    sum /= whole;
    return sum / max(sum.a, 1.0);
}

// Adds what the pass of large disks has found, upsampled.
void addCoarse(ivec2 pixel, float coc, float mostNear, inout vec3 light, inout vec4 front) {
    ivec2 last = levelSize(cells, 1) - 1;
    ivec2 corner = (pixel - 1) >> 1;
    vec2 part = 0.75 - 0.5 * vec2(pixel & 1);
    vec4 behind = vec4(0.0);
    vec4 before = vec4(0.0);
    int end = max(coc - large.x, mostNear - large.x) > 0.0 ? 4 : 0;
    for (int i = 0; i < end; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        ivec2 from = clamp(corner + side, ivec2(0), last);
        vec2 w = mix(1.0 - part, part, vec2(side));
        vec4 g = imageLoad(groundCoarse, from);
        behind += w.x * w.y * (sharpWeight + g.a) * vec4(g.rgb, 1.0);
        before += w.x * w.y * imageLoad(frontCoarse, from);
    }
    light = coc > large.x ? mix(light, behind.rgb / max(behind.a, 1e-9), largeShare(coc)) : light;
    front = mostNear > large.x ? before + (1.0 - before.a) * front : front;  // larger disks are nearer
}

// The pixel of this thread; false: none. Large disks: a group has some tiles of fewer pixels.
bool listedPixel(out ivec2 pixel) {
    uint index = gl_LocalInvocationIndex;
    ivec2 place = ivec2(gl_WorkGroupID.xy);
    uvec2 local = gl_LocalInvocationID.xy;
    if (coarse != 0u) {
        place.x = place.x * int(dofGroupTiles) + int(index >> 4u);
        local = uvec2(index & 3u, (index >> 2u) & 3u);
    }
    place.y += listStart((coarse != 0u ? dofGatherLarge : dofGather) + hasFront, imageSize(tileLists).y);
    uint item = imageLoad(tileLists, place).r;
    pixel = unpackTile(item) * int(dofTile >> coarse) + ivec2(local);
    return item != dofNoTile && all(lessThan(pixel, levelSize(cells, int(coarse))));
}

void main() {
    ivec2 pixel;
    if (!listedPixel(pixel)) {
        return;
    }
    vec2 at = (vec2(pixel) + 0.5) * pixelSide;
    vec3 radii = imageLoad(reach, min(ivec2(at), cells - 1) / int(dofTile)).rgb;
    Ground own = loadGround(pixel, int(coarse));
    vec4 front = vec4(0.0);
    if (hasFront != 0u) {
        own = filledGround(pixel, int(coarse));
        front = blurredFront(at, radii.x, radii.z);
    }
    vec3 light = blurredGround(at, own, radii.y);
    if (coarse == 0u) {
        addCoarse(pixel, own.coc, radii.x, light, front);
    }
    // Of large disks, only where they are the ones that count.
    float far = coarse != 0u && own.coc <= large.x ? 0.0 : own.far;
    imageStore(groundOut, pixel, vec4(light, far));
    imageStore(frontOut, pixel, front);
}
