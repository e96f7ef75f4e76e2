// Refraction of directions.
#ifndef REFLET_REFRACTION_GLSL
#define REFLET_REFRACTION_GLSL

// A ray that crosses a boundary. along, normal: unit, dot(along, normal) > 0; ratio: index of refraction on the ray's
// side over that on the other side. False: total internal reflection.
bool refractAt(vec3 along, vec3 normal, float ratio, out vec3 refracted) {
    float cosine = dot(along, normal);
    float rest = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    refracted = normalize(ratio * along + (sqrt(max(rest, 0.0)) - ratio * cosine) * normal);
    return rest > 0.0;
}

// Perceptual roughness of the reflection that spreads light as much as refraction through a volume does: a facet that
// is tilted by x turns a reflection by 2 x, and refraction by about (ior - 1) x at both boundaries, independently.
float refractedRoughness(float roughness, float ior) {
    return roughness * sqrt(min(0.7071 * (ior - 1.0), 1.0));
}

// Index of refraction of red (side -1), green (0) and blue light (1): those of red and blue differ by (ior - 1) over the
// Abbe number. dispersion: of KHR_materials_dispersion, 20 over the Abbe number.
float dispersedIndex(float ior, float dispersion, float side) {
    return max(ior + side * (ior - 1.0) * dispersion * 0.025, 1.0);
}

#endif
