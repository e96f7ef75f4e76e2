// The normal of the geometry itself, from depth: what shadow biases need, because a normal map or a smoothed normal
// does not say how depth changes along the surface.
// The includer defines, before it includes this: vec3 loadPosition(ivec2 pixel, out bool known) (world space).
#ifndef REFLET_SURFACE_NORMAL_GLSL
#define REFLET_SURFACE_NORMAL_GLSL

// From p toward the neighbour on whichever side the surface goes on more smoothly; false: on neither.
bool surfaceTangent(ivec2 pixel, ivec2 along, vec3 p, vec3 eyeDirection, out vec3 tangent) {
    bool knownA;
    bool knownB;
    vec3 a = loadPosition(pixel + along, knownA) - p;
    vec3 b = p - loadPosition(pixel - along, knownB);
    float awayA = knownA ? abs(dot(a, eyeDirection)) : 1e30;
    float awayB = knownB ? abs(dot(b, eyeDirection)) : 1e30;
    tangent = awayA < awayB ? a : b;
    return knownA || knownB;
}

// p: the pixel's own position. Falls back on the shading normal where depth gives none, or one that cannot be right
// because it is far from the shading normal or faces away from the eye.
vec3 surfaceNormal(ivec2 pixel, vec3 p, vec3 eyeDirection, vec3 shadingNormal) {
    vec3 x;
    vec3 y;
    bool knownX = surfaceTangent(pixel, ivec2(1, 0), p, eyeDirection, x);
    bool knownY = surfaceTangent(pixel, ivec2(0, 1), p, eyeDirection, y);
    vec3 n = cross(y, x);
    float square = dot(n, n);
    if (!knownX || !knownY || square < 1e-24) {
        return shadingNormal;
    }
    n *= inversesqrt(square);
    n = dot(n, eyeDirection) < 0.0 ? -n : n;
    return dot(n, shadingNormal) > 0.3 ? n : shadingNormal;
}

#endif
