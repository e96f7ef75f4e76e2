// The sharp picture, and its split into the layers at half resolution. The pass has params.size and params.toDepth.
#ifndef REFLET_DOF_PICTURE_GLSL
#define REFLET_DOF_PICTURE_GLSL

#include "effects/depth_of_field/dof_layers.glsl"
#include "shaders/half_float.glsl"

uniform sampler2D radiance;
layout(r32f) uniform readonly image2D coc;
layout(rgba16f) uniform writeonly image2D ground;   // radiance, presence
layout(rg16f) uniform writeonly image2D groundBlur; // radius, blurred share
layout(rgba16f) uniform writeonly image2D front;    // radiance · coverage, coverage
layout(rg16f) uniform writeonly image2D frontBlur;  // radius; of level 0: largest fullRadius of the pixels

// CPU devices sample faster than they fetch.
vec3 lightAt(ivec2 pixel) { return clampToHalf(textureLod(radiance, (vec2(pixel) + 0.5) / vec2(params.size), 0.0).rgb); }

float cocAt(ivec2 pixel) {
    return imageLoad(coc, min(ivec2((vec2(pixel) + 0.5) * params.toDepth), imageSize(coc) - 1)).r;
}

// darkness: of the tile (highlightShare).
void splitCell(ivec2 cell, float darkness) {
    GroundSum behind = GroundSum(vec4(0.0), vec3(0.0), 0.0);
    FrontSum before = FrontSum(vec4(0.0), vec2(0.0));
    float small = 0.0;
    ivec2 last = ivec2(params.size) - 1;
    for (int i = 0; i < 4; ++i) {
        ivec2 pixel = min(2 * cell + ivec2(i & 1, i >> 1), last);
        float c = cocAt(pixel);
        vec3 light = lightAt(pixel);
        light *= 1.0 - highlightShare(light, c, darkness, params.block);
        small = max(small, fullRadius(c, params.fullDisk));
        float near = nearShare(c, params.fullDisk);
        add(behind, Ground(light, 1.0 - near, 0.5 * max(c, 0.0), farShare(c, params.fullDisk)));
        add(before, Front(near * vec4(light, 1.0), -0.5 * c));
    }
    Ground g = meanOf(behind, 4.0);
    Front n = meanOf(before, 4.0);
    imageStore(ground, cell, vec4(g.light, g.presence));
    imageStore(groundBlur, cell, vec4(g.coc, g.far, 0.0, 0.0));
    imageStore(front, cell, n.light);
    imageStore(frontBlur, cell, vec4(n.coc, small, 0.0, 0.0));
}

#endif
