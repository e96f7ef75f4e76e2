// Splits the picture at half resolution. In: radiance, circle of confusion. Out: background and near layer.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"
#include "shaders/half_float.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };
uniform sampler2D radiance;
layout(r32f) uniform readonly image2D coc;
layout(rgba16f) uniform writeonly image2D ground;      // radiance, presence
layout(rg16f) uniform writeonly image2D groundBlur;    // radius, blurred share
layout(rgba16f) uniform writeonly image2D front;       // radiance · coverage, coverage
layout(r32f) uniform writeonly image2D frontBlur;      // radius

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, ivec2(params.half2)))) {
        return;
    }
    GroundSum behind = GroundSum(vec4(0.0), vec3(0.0), 0.0);
    FrontSum before = FrontSum(vec4(0.0), vec2(0.0));
    ivec2 last = ivec2(params.size) - 1;
    ivec2 lastDepth = imageSize(coc) - 1;
    for (int i = 0; i < 4; ++i) {
        ivec2 pixel = min(2 * cell + ivec2(i & 1, i >> 1), last);
        vec3 light = clampToHalf(texelFetch(radiance, pixel, 0).rgb);
        float c = imageLoad(coc, min(ivec2((vec2(pixel) + 0.5) * params.toDepth), lastDepth)).r;
        float near = nearShare(c);
        add(behind, Ground(light, 1.0 - near, 0.5 * max(c, 0.0), farShare(c)));
        add(before, Front(near * vec4(light, 1.0), -0.5 * c));
    }
    Ground g = meanOf(behind, 4.0);
    Front n = meanOf(before, 4.0);
    imageStore(ground, cell, vec4(g.light, g.presence));
    imageStore(groundBlur, cell, vec4(g.coc, g.far, 0.0, 0.0));
    imageStore(front, cell, n.light);
    imageStore(frontBlur, cell, vec4(n.coc));
}
