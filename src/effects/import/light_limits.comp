// How bright each tile of a host's light may be. In: the last frame's peaks, the brightest of these. Out: luminance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/import/bound_light.h"
#include "shaders/not_inlined.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { LightLimitsParams params; };
layout(r32f) uniform readonly image2D peaks;
layout(r32f) uniform readonly image2D framePeak;
layout(r32f) uniform writeonly image2D limits;

const float darkest = 1.0 / 64.0;        // light that may always appear, where what is lit is about 1
const float shareOfPicture = 1.0 / 8.0;  // of the picture's peak that may appear anywhere at rest: thin bright lines

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = ivec2(params.tiles) - 1;
    if (any(greaterThan(tile, last))) {
        return;
    }
    float picture = max(params.exposureChange * imageLoad(framePeak, ivec2(0)).r, darkest);
    float around = shareOfPicture * picture;
    for (int i = 0; i < 9; ++i) {
        ivec2 neighbour = clamp(tile + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
        around = max(around, params.exposureChange * imageLoad(peaks, neighbour).r);
    }
    float limit = params.whole * picture + params.near * around;
    imageStore(limits, tile, vec4(notInlined(params.unbounded, gl_GlobalInvocationID.x) != 0u ? 1e30 : limit));
}
