// Gathers both layers. In: the layers with their mips, reach of the tiles, positions of samples. Out: the blurred background,
// and the near layer with its coverage.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofGatherParams params; };
// Position of a sample in a disk of area pi · number of samples; its distance in the shape of the near disks, and of those behind the
// plane of focus.
layout(scalar) uniform SamplesBlock { vec4 at[dofMostSamples]; } taps;
layout(rgba16f) uniform readonly image2D ground;
layout(rg16f) uniform readonly image2D groundBlur;
layout(rgba16f) uniform readonly image2D front;
layout(r32f) uniform readonly image2D frontBlur;
layout(rgba16f) uniform readonly image2D groundMips;
layout(rg16f) uniform readonly image2D groundBlurMips;
layout(rgba16f) uniform readonly image2D frontMips;
layout(r32f) uniform readonly image2D frontBlurMips;
layout(rg16f) uniform readonly image2D reach;
layout(rgba16f) uniform writeonly image2D groundOut;  // radiance, blurred share
layout(rgba16f) uniform writeonly image2D frontOut;   // radiance · coverage, coverage

ivec2 cells = ivec2(params.half2);
const float leastRadius = 0.25;  // smaller disks are points

Ground loadGround(ivec2 cell, int level) {
    vec4 light;
    vec2 blur;
    if (level == 0) {
        light = imageLoad(ground, cell);
        blur = imageLoad(groundBlur, cell).rg;
    } else {
        cell.y += levelRow(cells, level);
        light = imageLoad(groundMips, cell);
        blur = imageLoad(groundBlurMips, cell).rg;
    }
    return Ground(light.rgb, light.a, blur.x, blur.y);
}

Front loadFront(ivec2 cell, int level) {
    if (level == 0) {
        return Front(imageLoad(front, cell), imageLoad(frontBlur, cell).r);
    }
    cell.y += levelRow(cells, level);
    return Front(imageLoad(frontMips, cell), imageLoad(frontBlurMips, cell).r);
}

// The background here; where the near layer hides it, that of coarser levels.
Ground filledGround(ivec2 cell) {
    Ground own = loadGround(cell, 0);
    // Levels are looked up only in a hole.
    int from = own.presence < 0.999 ? int(dofLevels) - 1 : 0;
    vec4 light = vec4(0.0);  // radiance, how much of it is known
    vec2 blur = vec2(0.0);
    for (int level = from; level > 0; --level) {
        vec2 place = (vec2(cell) + 0.5) / float(1 << level) - 0.5;
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

// The samples of disks up to a radius.
struct Disk {
    uint count;
    float scale;    // pixels per unit of the samples' positions
    float soft;     // half the width of a disk's edge: half a sample's own width
    int level;      // of the mips to look up
    float area;     // a sample's area over that of the aperture's shape with radius 1
    float blur;     // squared radius by which edges and cells widen a disk's second moment
};

Disk diskOf(float radius) {
    Disk d;
    float area = 3.14159265 * radius * radius;
    d.count = radius < leastRadius ? 0u : uint(clamp(area, float(dofFewestSamples), float(params.samples)));
    float n = float(max(d.count, 1u));
    // The outermost samples lie beyond the edge, by half of what they stand for.
    float all = radius / (1.0 - 0.5 * sqrt(3.14159265 / n));
    d.scale = all * inversesqrt(n);
    float apart = 1.7724539 * d.scale;
    d.soft = 0.5 * max(apart, 1.0);
    d.level = int(clamp(log2(max(apart, 1.0)) + 0.3, 0.0, float(dofLevels - 1u)));
    d.area = params.disk * d.scale * d.scale;
    float side = float(1 << d.level);
    d.blur = 1.6667 * d.soft * d.soft + 0.3333 * side * side + 0.6667;  // the last: upsampling
    return d;
}

// How much of a sample's light reaches the pixel: its area over its disk's, if it is within it. Disks are made smaller by as
// much as they are blurred.
float reaches(Disk d, float away, float radius) {
    float r2 = max(radius * radius - d.blur, d.soft * d.soft);
    return d.area / (r2 + 0.3333 * d.soft * d.soft) * clamp((sqrt(r2) - away) / (2.0 * d.soft) + 0.5, 0.0, 1.0);
}

ivec2 cellAt(ivec2 from, vec2 offset, int level) {
    ivec2 at = clamp(ivec2(vec2(from) + 0.5 + offset), ivec2(0), cells - 1);
    return at >> level;
}

// The background, composited by distance: what is not farther than the point has the coverage of its disks, and what is farther
// shows through the rest. What is sharp, or hidden, counts as unknown.
vec3 blurredGround(ivec2 cell, Ground own, float most) {
    float radius = own.far > 0.0 ? min(max(own.coc, most), 2.0 * own.coc) : 0.0;
    Disk d = diskOf(radius);
    vec4 here = vec4(0.0);
    vec4 behind = vec4(0.0);
    float known = 1e-6;
    for (uint i = 0u; i < d.count; ++i) {
        vec4 tap = taps.at[i];
        float away = tap.w * d.scale;
        Ground g = loadGround(cellAt(cell, tap.xy * d.scale, d.level), d.level);
        float seen = g.presence * g.far;
        float weight = seen * reaches(d, away, g.coc);
        float isBehind = clamp((g.coc - 1.1 * own.coc - 0.25) / (0.2 * own.coc + 0.5), 0.0, 1.0);
        here += (1.0 - isBehind) * weight * vec4(g.light, 1.0);
        behind += isBehind * weight * vec4(g.light, 1.0);
        known += seen * reaches(d, away, own.coc);
    }
    here /= known;
    float open = max(1.0 - here.a, 0.0);
    vec3 blurred = behind.a > 1e-4 ? here.rgb + open * behind.rgb / behind.a : here.rgb / clamp(here.a, 1e-4, 1.0);
    return here.a + behind.a > 1e-3 ? blurred : own.light;
}

vec4 blurredFront(ivec2 cell, float most) {
    Disk d = diskOf(most);
    vec4 sum = vec4(0.0);
    float whole = 1e-6;
    for (uint i = 0u; i < d.count; ++i) {
        vec4 tap = taps.at[i];
        Front n = loadFront(cellAt(cell, tap.xy * d.scale, d.level), d.level);
        sum += n.light * reaches(d, tap.z * d.scale, n.coc);
        whole += reaches(d, tap.z * d.scale, most);
    }
    sum /= whole;
    return sum / max(sum.a, 1.0);
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, cells))) {
        return;
    }
    vec2 radii = imageLoad(reach, cell / int(dofTile)).rg;
    Ground own = filledGround(cell);
    vec3 light = blurredGround(cell, own, radii.y);
    imageStore(groundOut, cell, vec4(light, own.far));
    imageStore(frontOut, cell, blurredFront(cell, radii.x));
}
