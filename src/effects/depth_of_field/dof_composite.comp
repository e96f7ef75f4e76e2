// Puts the layers together at full size. In: radiance, circle of confusion, blurred layers, highlights. Out: radiance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"
#include "effects/depth_of_field/dof_shape.glsl"
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

const int tileSide = 2 * int(dofTile);  // in pixels
const int steps = 2 * int(around) + 1;

// Light of the highlights at a pixel with a circle of confusion of that radius: behind and in front of the plane of focus.
struct Highlights {
    vec3 far;
    vec3 near;
};

// tiles: that have highlights that reach the pixel's.
Highlights highlightsAt(vec2 at, float coc, int tiles) {
    Highlights sum = Highlights(vec3(0.0), vec3(0.0));
    float own = max(coc, 0.0);
    // What is farther than the pixel's surface is hidden by it.
    vec2 isBehind = vec2(1.0, -1.1 * own - 0.25) / (0.2 * own + 0.5);
    float open = nearShare(coc);
    int side = tileBlocks(params.block);
    int shift = findMSB(side);
    ivec2 first = ivec2(at) / tileSide * steps;
    for (int t = 0; t < tiles; ++t) {
        int row = int((float(t) + 0.5) / float(steps));  // CPU devices divide integers slowly
        int index = int(imageLoad(drawnTiles, first + ivec2(t - row * steps, row)).r);
        ivec2 tile = ivec2(index & 1023, index >> 10);
        vec2 corner = vec2(tile * tileSide);
        vec2 list = imageLoad(lists, tile).rg;
        vec2 apart = max(max(corner - at, at - corner - float(tileSide)), 0.0);
        int count = dot(apart, apart) < list.y * list.y ? int(list.x) : 0;
        for (int i = 0; i < count; ++i) {
            ivec2 place = tile * side + ivec2(i & (side - 1), i >> shift);
            vec4 light = imageLoad(highlights, place);
            vec4 shape = imageLoad(highlightShape, place);
            vec2 way = at - corner - shape.xy;
            // Disks in front of the plane of focus are turned by half a turn.
            float away = shapeLength(way * sign(light.a), params.turn, params.blades);
            vec3 lit = clamp((shape.z - away) * shape.w + 0.5, 0.0, 1.0) * light.rgb;
            float hidden = clamp(light.a * isBehind.x + isBehind.y, 0.0, 1.0);
            sum.far += light.a > 0.0 ? max(1.0 - hidden, open) * lit : vec3(0.0);
            sum.near += light.a > 0.0 ? vec3(0.0) : lit;
        }
    }
    return sum;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.size)))) {
        return;
    }
    vec4 sharp = texelFetch(radiance, pixel, 0);
    sharp.rgb = clampToHalf(sharp.rgb);
    float c = imageLoad(coc, min(ivec2((vec2(pixel) + 0.5) * params.toDepth), imageSize(coc) - 1)).r;
    ivec2 tile = pixel / tileSide;
    int tiles = int(imageLoad(drawn, tile).r);
    int some = min(tiles, 1);  // CPU devices run both sides of a branch
    for (int i = 0; i < some; ++i) {
        sharp.rgb *= 1.0 - highlightShare(sharp.rgb, c, imageLoad(lists, tile).b, params.block);
    }
    Highlights apart = highlightsAt(vec2(pixel) + 0.5, c, tiles);
    // Bilinear; blurred cells before sharp ones, whose light must not leak.
    ivec2 corner = (pixel - 1) >> 1;
    vec2 part = 0.75 - 0.5 * vec2(pixel & 1);
    ivec2 last = ivec2(params.half2) - 1;
    float blurred = blurredShare(c);
    vec4 behind = vec4(0.0);
    vec4 before = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        ivec2 cell = clamp(corner + side, ivec2(0), last);
        vec2 w = mix(1.0 - part, part, vec2(side));
        float weight = w.x * w.y;
        vec4 g = imageLoad(groundOut, cell);
        behind += weight * (sharpWeight + g.a) * vec4(g.rgb, 1.0);
        before += weight * imageLoad(frontOut, cell);
    }
    vec3 light = blurred > 0.0 ? mix(sharp.rgb, behind.rgb / behind.a, blurred) : sharp.rgb;
    light = (light + apart.far) * (1.0 - before.a) + before.rgb + apart.near;
    imageStore(result, pixel, vec4(min(light, 65504.0), sharp.a));
}
