// Octahedral encoding of unit vectors in two 16-bit numbers (Cigolle et al., A Survey of Efficient Representations for
// Independent Unit Vectors, JCGT 2014). Largest error about 0.004 degrees.
#ifndef REFLET_OCTAHEDRAL_GLSL
#define REFLET_OCTAHEDRAL_GLSL

// Like sign(), but never 0, so that the seams of the octahedron are unambiguous.
vec2 signNotZero(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

// Unit vector to [-1, 1]².
vec2 octahedralEncode(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * signNotZero(p);
}

vec3 octahedralDecode(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) {
        n.xy = (1.0 - abs(n.yx)) * signNotZero(n.xy);
    }
    return normalize(n);
}

uint packUnitVector(vec3 n) { return packSnorm2x16(octahedralEncode(n)); }
vec3 unpackUnitVector(uint bits) { return octahedralDecode(unpackSnorm2x16(bits)); }

#endif
