// Brings a lamp's 2D shadow map, or its tiles in an atlas of the host, into tiles of Reflet's atlas. In: the host's map.
// Out: near / distance along the tile's axis, 0: nothing.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/import/finite.glsl"
#include "effects/shadow/import_lamp_map.h"
#include "shaders/not_inlined.glsl"

layout(scalar) uniform ParamsBlock { ImportLampParams params; };
uniform sampler2D hostMap;

// The host's face that shows the direction nearest to its centre.
uint hostFaceOf(vec3 direction) {
    uint best = 0u;
    float nearest = 1e30;
    for (uint i = 0u; i < notInlined(params.hostFaces, gl_GlobalInvocationID.x); ++i) {
        vec4 clip = params.worldToClip[i] * vec4(direction, 0.0);
        float off = clip.w > 0.0 ? max(abs(clip.x), abs(clip.y)) / clip.w : 1e30;
        best = off < nearest ? i : best;
        nearest = min(off, nearest);
    }
    return best;
}

float metresAlong(vec3 direction) {
    uint face = hostFaceOf(direction);
    mat4 toClip = params.worldToClip[face];
    vec4 along = toClip * vec4(direction, 0.0);
    vec2 ndc = along.xy / max(along.w, 1e-12);
    // Directions at a texel's centre are off it by rounding: they may not change the texel.
    vec2 at = (0.5 * ndc + 0.5) * params.tiles[face].zw;
    if (along.w <= 0.0 || any(lessThan(at, vec2(-1e-3))) || any(greaterThan(at, params.tiles[face].zw + 1e-3))) {
        return 0.0;
    }
    ivec2 texel = clamp(ivec2(floor(at)), ivec2(0), ivec2(params.tiles[face].zw) - 1);
    float stored = texelFetch(hostMap, ivec2(params.tiles[face].xy) + texel, 0).r;
    uint depth = notInlined(params.depth, gl_GlobalInvocationID.x);
    if (depth == lampDistance) {
        return stored * params.distanceScale / length(direction);
    }
    bool nothing = depth == lampDepthReversed ? stored <= 0.0 : stored >= 1.0;
    vec4 from = toClip * vec4(params.position.xyz, 1.0);
    float metres = (stored * from.w - from.z) / (along.z - stored * along.w);
    return nothing ? 0.0 : metres;
}
#include "effects/shadow/import_lamp_map.glsl"
