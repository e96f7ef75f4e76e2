// The signed circle of confusion. In: depth; with a history: motion, last frame's. Out: its radius in pixels of the picture.
//
// Subpixel jitter moves edges of the depth buffer from frame to frame, but not those of the antialiased picture. So a pixel keeps
// its radius as long as a surface of that radius is beside it.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/depth_of_field.h"
#include "shaders/not_inlined.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofCocParams params; };
uniform sampler2D depth;
uniform sampler2D motion;
layout(r32f) uniform readonly image2D previous;
layout(r32f) uniform writeonly image2D coc;

const float steady = 0.02;  // a smaller change of the radius [pixels] is not seen

float radiusOf(float d) {
    float z = depthToViewDistance(d, params.depthToDistance);
    vec4 lens = params.lens;
    // Perspective: the image of a disk shrinks with the distance.
    float defocus = lens.z > 0.0 ? z * lens.y - 1.0 : 1.0 - 1.0 / max(z * lens.y, 1e-9);
    return clamp(lens.x * defocus, -lens.w, lens.w);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = ivec2(params.size) - 1;
    if (any(greaterThan(pixel, last))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    float radius = radiusOf(d);
    bool hasPrevious = notInlined(params.hasPrevious, gl_GlobalInvocationID.x) != 0u;
    if (hasPrevious) {
        vec2 moved = texelFetch(motion, pixel, 0).rg * vec2(params.size);
        ivec2 before = ivec2(floor(vec2(pixel) - moved + 0.5));
        bool known = all(equal(before, clamp(before, ivec2(0), last)));
        float held = imageLoad(previous, clamp(before, ivec2(0), last)).r;
        // Neighbours are looked up only where the radius changes. CPU devices run both sides of a branch.
        int end = hasPrevious && known && abs(held - radius) > steady ? 9 : 0;
        float nearest = d;
        float farthest = d;
        for (int i = 0; i < end; ++i) {
            float other = texelFetch(depth, clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), last), 0).r;
            nearest = max(nearest, other);
            farthest = min(farthest, other);
        }
        float beside = end > 0 ? clamp(held, radiusOf(nearest), radiusOf(farthest)) : held;
        radius = known ? beside : radius;
    }
    imageStore(coc, pixel, vec4(radius));
}
