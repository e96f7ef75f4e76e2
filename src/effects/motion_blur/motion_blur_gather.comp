// Gathers along the longest half streak around and the pixel's own. In: picture, half streaks, tiles. Out: the blurred picture.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/motion_blur/motion_blur.h"
#include "shaders/noise.glsl"
#include "shaders/not_inlined.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { MotionBlurGatherParams params; };
uniform sampler2D radiance;
uniform sampler2D streaks;
uniform sampler2D tiles;
layout(rgba16f) uniform writeonly image2D result;

const float shortest = 0.5;     // half streaks [pixels] that are seen
const float sameDistance = 0.05;  // relative; surfaces this near to each other are one
const float largestShare = 4.0;   // of a sample

// Half streak, its length and the distance of what is seen at a place of the picture.
struct Streak {
    vec2 streak;
    float pixels;
    float z;
};

Streak streakAt(vec2 place) {
    ivec2 at = clamp(ivec2(place * params.toDepth), ivec2(0), textureSize(streaks, 0) - 1);
    vec4 texel = texelFetch(streaks, at, 0);
    return Streak(texel.rg, texel.b, texel.a);
}

// 0: not nearer; 1: nearer by sameDistance or more.
float nearer(float z, float than) { return clamp((than / z - 1.0) / sameDistance, 0.0, 1.0); }

vec4 colorAt(vec2 place) { return textureLod(radiance, place / vec2(params.size), 0.0); }

// Share of a sample that sweeps over the pixel. away: its distance [pixels]; along: unit.
float sweeps(Streak other, Streak own, float away, vec2 along) {
    float front = nearer(other.z, own.z);
    float faster = clamp(2.0 - 2.0 * own.pixels / max(other.pixels, 1e-3), 0.0, 1.0);
    float reach = clamp(other.pixels - away + 0.5, 0.0, 1.0);
    float straight = abs(dot(other.streak, along)) / max(other.pixels, 1e-3);
    return reach * straight * max(front, (1.0 - nearer(own.z, other.z)) * faster);
}

// Whether a sample along the pixel's own half streak shows its surface, or what that reveals: not what is in front and moves otherwise.
float isOwn(Streak other, Streak own) {
    float unlike = length(other.streak - own.streak) / max(0.5 * own.pixels, shortest);
    return 1.0 - nearer(other.z, own.z) * clamp(unlike, 0.0, 1.0);
}

// The tile that is asked: near its edges, by chance, one beside it, so that no edges of tiles show.
vec2 longestAround(vec2 place, vec2 chance) {
    ivec2 tile = ivec2(place * params.toTiles + 0.5 * (chance - 0.5));
    return texelFetch(tiles, clamp(tile, ivec2(0), textureSize(tiles, 0) - 1), 0).rg;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.size)))) {
        return;
    }
    vec2 place = vec2(pixel) + 0.5;
    uint hash = hashPixel(uvec2(pixel), 0u, params.frame);
    vec2 most = longestAround(place, hashToUnit2(hash));
    float reach = length(most);
    Streak own = streakAt(place);
    vec4 center = texelFetch(radiance, pixel, 0);
    // A sample per pixel of the streak suffices.
    float wanted = reach > shortest ? min(ceil(2.0 * reach) + 1.0, float(params.samples)) : 0.0;
    int count = int(notInlined(uint(wanted), gl_GlobalInvocationID.x));
    vec2 along = most / max(reach, 1e-3);
    float phase = hashToUnit(hashPcg(hash ^ 0x5bd1e995u));
    vec4 over = vec4(0.0);                      // what sweeps over the pixel, and its coverage
    vec4 beneath = vec4(center.rgb, 1.0) * 1e-3;  // its own surface and what is behind
    for (int i = 0; i < count; ++i) {
        float at = 2.0 * (float(i) + phase) / wanted - 1.0;
        vec2 to = place + at * most;
        Streak other = streakAt(to);
        float share = sweeps(other, own, abs(at) * reach, along) * min(reach / max(other.pixels, shortest), largestShare);
        over += share * vec4(colorAt(to).rgb, 1.0);
        to = place + at * own.streak;
        float weight = isOwn(streakAt(to), own);
        beneath += weight * vec4(colorAt(to).rgb, 1.0);
    }
    over /= max(wanted, 1.0);
    over /= max(over.a, 1.0);
    vec3 color = over.rgb + (1.0 - over.a) * beneath.rgb / beneath.a;
    imageStore(result, pixel, vec4(count > 0 ? color : center.rgb, center.a));
}
