// The longest half streak of each tile and the eight around it that may reach it. In: of each tile. Out: of tiles with those around.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D tiles;
layout(rg16f) uniform writeonly image2D around;

void main() {
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(tiles, 0);
    if (any(greaterThanEqual(tile, size))) {
        return;
    }
    vec2 most = vec2(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 to = ivec2(i % 3, i / 3) - 1;
        vec2 streak = texelFetch(tiles, clamp(tile + to, ivec2(0), size - 1), 0).rg;
        // What moves along the other diagonal passes the corner by.
        bool reaches = to.x * to.y == 0 || streak.x * streak.y * float(to.x * to.y) > 0.0;
        most = reaches && dot(streak, streak) > dot(most, most) ? streak : most;
    }
    imageStore(around, tile, vec4(most, 0.0, 0.0));
}
