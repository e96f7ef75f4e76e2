// Makes one level of both layers from the one below. In and out: the layers.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/dof_layers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofSizes params; };
layout(rgba16f) uniform image2D ground;
layout(rg16f) uniform image2D groundBlur;
layout(rgba16f) uniform image2D front;
layout(rg16f) uniform image2D frontBlur;

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
        ivec2 from = levelPlace(min(2 * cell + ivec2(i & 1, i >> 1), last), level - 1, cells);
        vec4 g = imageLoad(ground, from);
        vec2 gb = imageLoad(groundBlur, from).rg;
        add(behind, Ground(g.rgb, g.a, gb.x, gb.y));
        add(before, Front(imageLoad(front, from), imageLoad(frontBlur, from).r));
    }
    Ground g = meanOf(behind, 4.0);
    Front n = meanOf(before, 4.0);
    ivec2 to = levelPlace(cell, level, cells);
    imageStore(ground, to, vec4(g.light, g.presence));
    imageStore(groundBlur, to, vec4(g.coc, g.far, 0.0, 0.0));
    imageStore(front, to, n.light);
    imageStore(frontBlur, to, vec4(n.coc));
}
