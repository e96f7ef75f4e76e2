// Directional albedo of the single-scattering GGX lobe as A · F0 + B, by quadrature over the visible half vectors;
// texel coordinates are (nv, roughness). (Karis, Real Shading in Unreal Engine 4, 2013, with exact visibility.)
// And that of a white sheen. Out: table (A, B, sheen).
#version 460
#include "shaders/ggx.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f) uniform writeonly image2D table;

const uint sampleCount = 32u;  // per axis

// By quadrature over half of the hemisphere; the other half is the same.
float sheenAlbedo(float nv, float roughness) {
    const uint steps = 20u;  // per axis: the lobe is wide
    vec3 v = vec3(sqrt(1.0 - nv * nv), 0.0, nv);
    float sum = 0.0;
    for (uint i = 0u; i < steps * steps; ++i) {
        vec2 u = (vec2(i % steps, i / steps) + 0.5) / float(steps);
        vec3 l = sampleUniformHemisphere(vec2(u.x, 0.5 * u.y));
        sum += sheenBrdf(l.z, nv, normalize(v + l).z, roughness) * l.z;
    }
    return min(sum * 2.0 * pi / float(steps * steps), 1.0);
}

void main() {
    vec2 size = vec2(imageSize(table));
    vec2 at = vec2(gl_GlobalInvocationID.xy);
    float nv = max(at.x / (size.x - 1.0), 1e-3);
    float roughness = at.y / (size.y - 1.0);
    float alpha = max(roughness * roughness, 1e-4);
    vec3 v = vec3(sqrt(1.0 - nv * nv), 0.0, nv);
    vec2 sum = vec2(0.0);
    for (uint i = 0u; i < sampleCount * sampleCount; ++i) {
        vec2 u = (vec2(i % sampleCount, i / sampleCount) + 0.5) / float(sampleCount);
        vec3 h = sampleGgxVisible(u, v, alpha);
        float vh = dot(v, h);
        float nl = 2.0 * vh * h.z - v.z;
        if (nl > 0.0) {
            // BRDF · nl / pdf: G2 / G1 (v), that is V · 4 nl nv / G1.
            float a2 = alpha * alpha;
            float weight = ggxVisibility(nl, nv, alpha) * 2.0 * nl * (nv + sqrt(nv * nv * (1.0 - a2) + a2));
            float fresnel = fresnelSchlick(vec3(0.0), vh).x;
            sum += weight * vec2(1.0 - fresnel, fresnel);
        }
    }
    imageStore(table, ivec2(gl_GlobalInvocationID.xy), vec4(sum / float(sampleCount * sampleCount), sheenAlbedo(nv, roughness), 0.0));
}
