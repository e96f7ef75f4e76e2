// Puts the layers together at full size, in the tiles of a list. In: radiance, circle of confusion, blurred layers, highlights, the
// list. Out: radiance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"
#include "effects/depth_of_field/dof_shape.glsl"
#include "effects/depth_of_field/dof_tile_lists.glsl"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };
uniform sampler2D radiance;
layout(r32f) uniform readonly image2D coc;
layout(rgba16f) uniform readonly image2D groundOut;
layout(rgba16f) uniform readonly image2D frontOut;
layout(rgba16f) uniform readonly image2D highlights;  // as dof_highlights.comp, dof_lists.comp and dof_reach.comp write them
layout(rgba16f) uniform readonly image2D highlightShape;
layout(rgba16f) uniform readonly image2D lists;
layout(r32f) uniform readonly image2D drawn;
layout(r32f) uniform readonly image2D drawnTiles;
layout(constant_id = 1) const uint around = 1u;  // as in dof_reach.comp
layout(rgba16f) uniform writeonly image2D result;

layout(constant_id = 2) const uint list = dofComposite;
layout(rgba16f) uniform readonly image2D reach;
layout(r32ui) uniform readonly uimage2D tileLists;

// Also right for dofCopy: dofCopy - dofComposite has neither bit. (glslang computes && of constants where it is used first only.)
const bool hasHighlights = ((list - dofComposite) & dofHighlights) != 0u;
const bool hasSmall = ((list - dofComposite) & dofSmall) != 0u;

const int tileSide = 2 * int(dofTile);  // in pixels
const int steps = 2 * int(around) + 1;

// A thread composites the four pixels of a cell: a column each.
const vec4 pixelX = vec4(0.0, 1.0, 0.0, 1.0);
const vec4 pixelY = vec4(0.0, 0.0, 1.0, 1.0);

float nearShareAt(float coc) { return nearShare(coc, params.fullDisk); }

// Light of highlights behind and in front of the plane of focus.
struct Highlights {
    mat4x3 far;
    mat4x3 near;
};

// at: centre of the first pixel. tiles: that have highlights that reach the pixels' tile.
Highlights highlightsAt(vec2 at, vec4 coc, int tiles) {
    Highlights sum = Highlights(mat4x3(0.0), mat4x3(0.0));
    // What is farther than the pixel's surface is hidden by it.
    vec4 own = max(coc, 0.0);
    vec4 perCoc = 1.0 / (0.2 * own + 0.5);
    vec4 from = (1.1 * own + 0.25) * perCoc;
    vec4 open = vec4(nearShareAt(coc.x), nearShareAt(coc.y), nearShareAt(coc.z), nearShareAt(coc.w));
    int side = tileBlocks(params.block);
    int shift = findMSB(side);
    ivec2 first = ivec2(at) / tileSide * steps;
    for (int t = 0; t < tiles; ++t) {
        int row = int((float(t) + 0.5) / float(steps));  // CPU devices divide integers slowly
        int index = int(imageLoad(drawnTiles, first + ivec2(t - row * steps, row)).r);
        ivec2 tile = ivec2(index & 1023, index >> 10);
        vec2 corner = vec2(tile * tileSide);
        vec2 list = imageLoad(lists, tile).rg;
        vec2 apart = max(max(corner - at - 1.0, at - corner - float(tileSide)), 0.0);
        int count = dot(apart, apart) < list.y * list.y ? int(list.x) : 0;
        for (int i = 0; i < count; ++i) {
            ivec2 place = tile * side + ivec2(i & (side - 1), i >> shift);
            vec4 light = imageLoad(highlights, place);
            vec4 shape = imageLoad(highlightShape, place);
            vec2 way = at - corner - shape.xy;
            // Disks in front of the plane of focus are turned by half a turn.
            vec4 x = (way.x + pixelX) * sign(light.a);
            vec4 y = (way.y + pixelY) * sign(light.a);
            vec4 away = shapeLengths(x, y, params.turn, params.blades);
            vec4 lit = clamp((shape.z - away) * shape.w + 0.5, 0.0, 1.0);
            vec4 hidden = clamp(light.a * perCoc - from, 0.0, 1.0);
            sum.far += outerProduct(light.rgb, light.a > 0.0 ? max(1.0 - hidden, open) * lit : vec4(0.0));
            sum.near += outerProduct(light.rgb, light.a > 0.0 ? vec4(0.0) : lit);
        }
    }
    return sum;
}

float cocAt(ivec2 pixel) {
    return imageLoad(coc, min(ivec2((vec2(pixel) + 0.5) * params.toDepth), imageSize(coc) - 1)).r;
}

// CPU devices sample faster than they fetch.
vec4 sharpAt(ivec2 pixel) {
    vec4 sharp = textureLod(radiance, (vec2(pixel) + 0.5) / vec2(params.size), 0.0);
    return vec4(clampToHalf(sharp.rgb), sharp.a);
}

// Disks that half resolution has too few cells for, at full resolution.
struct SmallDisks {
    mat4 own;   // mean over the pixel's own disk of what is not nearer: radiance · share of full resolution, that share
    mat4 over;  // what is nearer: radiance · coverage, coverage
};

// largest: radius of the small disks that may reach the pixels.
SmallDisks smallDisks(ivec2 first, vec4 coc, float largest) {
    SmallDisks sum = SmallDisks(mat4(0.0), mat4(0.0));
    vec4 whole = vec4(0.0);
    vec4 radius = clamp(abs(coc), 0.5, params.fullDisk);
    ivec2 last = ivec2(params.size) - 1;
    int n = int(ceil(largest + 0.5)) - 1;
    for (int y = -n; y <= n + 1; ++y) {
        for (int x = -n; x <= n + 1; ++x) {
            ivec2 pixel = clamp(first + ivec2(x, y), ivec2(0), last);
            float c = cocAt(pixel);
            vec3 sharp = sharpAt(pixel).rgb;
            float apart = 0.0;
            if (hasHighlights && abs(c) > leastHighlight(params.block)) {
                apart = highlightShare(sharp, c, imageLoad(lists, pixel / tileSide).b, params.block);
            }
            vec4 light = (1.0 - blurredShare(c, params.fullDisk)) * vec4((1.0 - apart) * sharp, 1.0);
            // Disks in front of the plane of focus are turned by half a turn.
            float turned = c < 0.0 ? -1.0 : 1.0;
            vec4 away = shapeLengths(turned * (pixelX - float(x)), turned * (pixelY - float(y)), params.turn, params.blades);
            vec4 nearer = clamp(2.0 * (coc - c) - 0.5, 0.0, 1.0);
            vec4 inside = (1.0 - nearer) * clamp(radius - away + 0.5, 0.0, 1.0);
            float r = clamp(abs(c), 0.5, params.fullDisk);
            vec4 covered = nearer * clamp(r - away + 0.5, 0.0, 1.0) * params.disk / (r * r + 0.0833);
            sum.own += outerProduct(light, inside);
            sum.over += outerProduct(light, covered);
            whole += inside;
        }
    }
    for (int i = 0; i < 4; ++i) {
        sum.own[i] /= whole[i];
        sum.over[i] /= max(sum.over[i].a, 1.0);
    }
    return sum;
}

// The layers at the four pixels of a cell.
struct Layers {
    mat4 behind;  // radiance · weight, weight
    mat4 before;  // radiance · coverage, coverage
};

vec4 groundAt(ivec2 cell) {
    vec4 g = imageLoad(groundOut, cell);
    return (sharpWeight + g.a) * vec4(g.rgb, 1.0);  // blurred cells before sharp ones, whose light must not leak
}

// Bilinear. top, bottom: weight of a row of cells for the upper and the lower pixels.
void addRow(inout Layers sum, ivec2 cell, float top, float bottom) {
    ivec2 last = ivec2(params.half2) - 1;
    ivec2 middle = clamp(cell, ivec2(0), last);
    ivec2 left = ivec2(max(cell.x - 1, 0), middle.y);
    ivec2 right = ivec2(min(cell.x + 1, last.x), middle.y);
    vec4 g = 0.75 * groundAt(middle);
    vec4 gl = g + 0.25 * groundAt(left);
    vec4 gr = g + 0.25 * groundAt(right);
    sum.behind += mat4(top * gl, top * gr, bottom * gl, bottom * gr);
    vec4 f = 0.75 * imageLoad(frontOut, middle);
    vec4 fl = f + 0.25 * imageLoad(frontOut, left);
    vec4 fr = f + 0.25 * imageLoad(frontOut, right);
    sum.before += mat4(top * fl, top * fr, bottom * fl, bottom * fr);
}

void main() {
    uint item = imageLoad(tileLists, ivec2(gl_WorkGroupID.xy) + ivec2(0, listStart(list, imageSize(tileLists).y))).r;
    ivec2 tile = unpackTile(item);
    ivec2 cell = tile * int(dofTile) + ivec2(gl_LocalInvocationID.xy);
    if (item == dofNoTile || any(greaterThanEqual(cell, ivec2(params.half2)))) {
        return;
    }
    ivec2 first = 2 * cell;
    Layers layers = Layers(mat4(0.0), mat4(0.0));
    Highlights apart = Highlights(mat4x3(0.0), mat4x3(0.0));
    vec4 cocs = vec4(0.0);
    float darkness = 0.0;
    if (list != dofCopy) {
        cocs = vec4(cocAt(first), cocAt(first + ivec2(1, 0)), cocAt(first + ivec2(0, 1)), cocAt(first + 1));
        addRow(layers, cell - ivec2(0, 1), 0.25, 0.0);
        addRow(layers, cell, 0.75, 0.75);
        addRow(layers, cell + ivec2(0, 1), 0.0, 0.25);
    }
    SmallDisks small = SmallDisks(mat4(0.0), mat4(0.0));
    if (hasSmall) {
        small = smallDisks(first, cocs, imageLoad(reach, tile).a);
    }
    if (hasHighlights) {
        darkness = imageLoad(lists, tile).b;
        apart = highlightsAt(vec2(first) + 0.5, cocs, int(imageLoad(drawn, tile).r));
    }
    for (int i = 0; i < 4; ++i) {
        ivec2 pixel = first + ivec2(i & 1, i >> 1);
        vec4 sharp = sharpAt(pixel);
        vec3 light = sharp.rgb;
        if (list != dofCopy) {
            light *= 1.0 - highlightShare(light, cocs[i], darkness, params.block);
            vec4 behind = layers.behind[i];
            vec4 before = layers.before[i];
            float blurred = blurredShare(cocs[i], params.fullDisk);
            vec3 layer = behind.rgb / behind.a;
            if (hasSmall) {
                light = small.own[i].rgb + (1.0 - small.own[i].a) * layer;
            }
            // Behind the plane of focus, the mean over small disks has the layer's share already.
            blurred = hasSmall && cocs[i] > 0.0 ? 0.0 : blurred;
            light = blurred > 0.0 ? mix(light, layer, blurred) : light;
            if (hasSmall) {
                light = small.over[i].rgb + (1.0 - small.over[i].a) * light;
            }
            light = (light + apart.far[i]) * (1.0 - before.a) + before.rgb + apart.near[i];
        }
        imageStore(result, pixel, vec4(min(light, largestHalf), sharp.a));
    }
}
