// Surfaces of any F0 and F90, and the integral of their brdfTimesCosine over half vectors.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "shaders/ggx.glsl"
#include "ggx_dielectric_test.h"

layout(local_size_x = 64) in;
uniform sampler2D ggxTable;
layout(scalar) readonly buffer InputBlock { DielectricCase items[]; } inputs;
layout(scalar) buffer OutputBlock { DielectricResult items[]; } outputs;

const uint steps = 128u;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    DielectricCase c = inputs.items[i];
    vec2 table = textureLod(ggxTable, ggxTableUv(c.nv, c.roughness), 0.0).rg;
    Surface s = makeSurface(c.baseColor, c.metallic, c.roughness, c.dielectric, table, false);
    vec3 n = vec3(0.0, 0.0, 1.0);
    vec3 v = vec3(sqrt(1.0 - c.nv * c.nv), 0.0, c.nv);
    float alpha = max(c.roughness, minLightRoughness);
    alpha *= alpha;
    vec3 diffuse = s.diffuse;
    s.diffuse = vec3(0.0);
    vec3 sum = diffuse;
    for (uint k = 0u; k < steps * steps; ++k) {
        vec2 u = (vec2(k % steps, k / steps) + 0.5) / float(steps);
        vec3 h = sampleGgx(vec2(u.x, 0.5 * u.y), alpha);
        vec3 l = reflect(-v, h);
        float pdf = ggxDistribution(h.z, alpha) * h.z / (4.0 * dot(v, h));
        sum += dot(v, h) > 0.0 ? brdfTimesCosine(s, n, v, l) / (pdf * float(steps * steps)) : vec3(0.0);
    }
    outputs.items[i] = DielectricResult(diffuse, s.specular, sum, s.f0, s.f90);
}
