// Surfaces made as the renderer makes them, and light that they reflect.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/ggx.glsl"
#include "ggx_test.h"

layout(local_size_x = 64) in;
uniform sampler2D ggxTable;
layout(scalar) readonly buffer InputBlock { GgxCase items[]; } inputs;
layout(scalar) buffer OutputBlock { GgxResult items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    GgxCase c = inputs.items[i];
    GgxResult o;
    o.table = textureLod(ggxTable, ggxTableUv(c.v.z, c.material.roughness), 0.0).rg;
    Surface s = makeSurface(c.material.baseColor, c.material.metallic, c.material.roughness, standardDielectric, o.table,
                            c.material.lambert != 0u);
    o.reflected = brdfTimesCosine(s, vec3(0.0, 0.0, 1.0), c.v, c.l);
    o.diffuse = s.diffuse;
    o.specular = s.specular;
    o.singleScattering = (o.reflected - s.diffuse * c.l.z / pi) / (s.compensation * c.l.z);
    outputs.items[i] = o;
}
