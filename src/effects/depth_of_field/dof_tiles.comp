// How far the layers of each tile reach. In: both layers. Out: the largest radius of the near layer, of the background, and of small
// disks of the near layer.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };
layout(rg16f) uniform readonly image2D groundBlur;
layout(r32f) uniform readonly image2D frontBlur;
layout(rgba16f) uniform writeonly image2D tiles;

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 first = tile * int(dofTile);
    ivec2 end = min(first + int(dofTile), ivec2(params.half2));
    if (any(greaterThanEqual(first, ivec2(params.half2)))) {
        return;
    }
    vec3 largest = vec3(0.0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            // The radius of an empty near cell is 0.
            float near = imageLoad(frontBlur, ivec2(x, y)).r;
            vec2 far = imageLoad(groundBlur, ivec2(x, y)).rg;
            float small = near < large.y ? near : 0.0;
            largest = max(largest, vec3(near, far.g > 0.0 ? far.r : 0.0, small));
        }
    }
    imageStore(tiles, tile, vec4(largest, 0.0));
}
