// Integrates brdfTimesCosine over light directions, one ring of them per thread; or (byHalfVector) over half vectors,
// which resolves narrow lobes. The sum over the rings of a case is the integral.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/ggx.glsl"
#include "ggx_test.h"

layout(local_size_x = 64) in;
uniform sampler2D ggxTable;
layout(scalar) readonly buffer InputBlock { GgxRing items[]; } inputs;
layout(scalar) buffer OutputBlock { float items[]; } outputs;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    GgxRing c = inputs.items[i];
    vec2 table = textureLod(ggxTable, ggxTableUv(c.nv, c.material.roughness), 0.0).rg;
    Surface s = makeSurface(c.material.baseColor, c.material.metallic, c.material.roughness, standardDielectric, table, false);
    vec3 n = vec3(0.0, 0.0, 1.0);
    vec3 v = vec3(sqrt(1.0 - c.nv * c.nv), 0.0, c.nv);
    float alpha = max(c.material.roughness, minLightRoughness);
    alpha *= alpha;
    float at = (float(c.ring) + 0.5) / float(c.rings);
    float sum = 0.0;
    for (uint j = 0u; j < c.around; ++j) {
        float turn = (float(j) + 0.5) / float(2u * c.around);
        if (c.byHalfVector != 0u) {
            vec3 h = sampleGgx(vec2(at, turn), alpha);
            vec3 l = reflect(-v, h);
            float pdf = ggxDistribution(h.z, alpha) * h.z / (4.0 * dot(v, h));
            sum += dot(v, h) > 0.0 ? brdfTimesCosine(s, n, v, l).x / (pdf * float(c.rings * c.around)) : 0.0;
        } else {
            float theta = at * pi / 2.0;
            vec3 l = vec3(sin(theta) * cos(2.0 * pi * turn), sin(theta) * sin(2.0 * pi * turn), cos(theta));
            float solidAngle = sin(theta) * (pi / 2.0 / float(c.rings)) * (2.0 * pi / float(c.around));
            sum += brdfTimesCosine(s, n, v, l).x * solidAngle;
        }
    }
    outputs.items[i] = sum;
}
