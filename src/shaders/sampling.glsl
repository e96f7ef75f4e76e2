// Sampling of directions around +Z from pairs of numbers in [0, 1), and the tangent frame of a normal.
#ifndef REFLET_SAMPLING_GLSL
#define REFLET_SAMPLING_GLSL

const float pi = 3.14159265358979;

// Branchless tangent frame (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 2017). Columns: tangent,
// bitangent, normal.
mat3 basisAround(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// pdf = z / pi.
vec3 sampleCosineHemisphere(vec2 u) {
    float r = sqrt(u.x);
    float phi = 2.0 * pi * u.y;
    return vec3(r * cos(phi), r * sin(phi), sqrt(1.0 - u.x));
}

// pdf = 1 / (2 pi).
vec3 sampleUniformHemisphere(vec2 u) {
    float z = 1.0 - u.x;
    float r = sqrt(max(1.0 - z * z, 0.0));
    float phi = 2.0 * pi * u.y;
    return vec3(r * cos(phi), r * sin(phi), z);
}

// Half vector of the GGX distribution, pdf = D · z. alpha: roughness squared. (Walter et al. 2007)
vec3 sampleGgx(vec2 u, float alpha) {
    float z2 = (1.0 - u.x) / (1.0 + (alpha * alpha - 1.0) * u.x);
    float r = sqrt(max(1.0 - z2, 0.0));
    float phi = 2.0 * pi * u.y;
    return vec3(r * cos(phi), r * sin(phi), sqrt(z2));
}

// Half vector from the distribution of GGX normals visible from v (unit, v.z > 0); alpha: along x and y. pdf = D · max(dot(v, h), 0) · G1(v)
// / v.z. (Dupuy and Benyoub, Sampling Visible GGX Normals with Spherical Caps, HPG 2023)
vec3 sampleGgxVisible(vec2 u, vec3 v, vec2 alpha) {
    vec3 stretched = normalize(vec3(alpha * v.xy, v.z));
    float phi = 2.0 * pi * u.y;
    float z = (1.0 - u.x) * (1.0 + stretched.z) - stretched.z;
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + stretched;
    return normalize(vec3(alpha * h.xy, max(h.z, 0.0)));
}
vec3 sampleGgxVisible(vec2 u, vec3 v, float alpha) { return sampleGgxVisible(u, v, vec2(alpha)); }

#endif
