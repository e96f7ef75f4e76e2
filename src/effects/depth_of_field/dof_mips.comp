// Makes one level of both layers from the one below. In: level 0. In and out: the other levels, as in effects/levels.h.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };
layout(rgba16f) uniform readonly image2D ground;
layout(rg16f) uniform readonly image2D groundBlur;
layout(rgba16f) uniform readonly image2D front;
layout(r32f) uniform readonly image2D frontBlur;
layout(rgba16f) uniform image2D groundMips;
layout(rg16f) uniform image2D groundBlurMips;
layout(rgba16f) uniform image2D frontMips;
layout(r32f) uniform image2D frontBlurMips;

ivec2 cells = ivec2(params.half2);
int level = int(params.level);

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, levelSize(cells, level)))) {
        return;
    }
    GroundSum behind = GroundSum(vec4(0.0), vec3(0.0), 0.0);
    FrontSum before = FrontSum(vec4(0.0), vec2(0.0));
    ivec2 last = levelSize(cells, level - 1) - 1;
    for (int i = 0; i < 4; ++i) {
        ivec2 from = min(2 * cell + ivec2(i & 1, i >> 1), last);
        vec4 g;
        vec2 gb;
        vec4 n;
        float nb;
        if (level == 1) {
            g = imageLoad(ground, from);
            gb = imageLoad(groundBlur, from).rg;
            n = imageLoad(front, from);
            nb = imageLoad(frontBlur, from).r;
        } else {
            from.y += levelRow(cells, level - 1);
            g = imageLoad(groundMips, from);
            gb = imageLoad(groundBlurMips, from).rg;
            n = imageLoad(frontMips, from);
            nb = imageLoad(frontBlurMips, from).r;
        }
        add(behind, Ground(g.rgb, g.a, gb.x, gb.y));
        add(before, Front(n, nb));
    }
    Ground g = meanOf(behind, 4.0);
    Front n = meanOf(before, 4.0);
    ivec2 to = cell + ivec2(0, levelRow(cells, level));
    imageStore(groundMips, to, vec4(g.light, g.presence));
    imageStore(groundBlurMips, to, vec4(g.coc, g.far, 0.0, 0.0));
    imageStore(frontMips, to, n.light);
    imageStore(frontBlurMips, to, vec4(n.coc));
}
