// Where the texels of a resampled image lie. The includer declares params as RescaleParams.
#ifndef REFLET_EFFECTS_RESCALE_GLSL
#define REFLET_EFFECTS_RESCALE_GLSL

bool isInside(ivec2 pixel) { return all(lessThan(pixel, ivec2(params.to))); }

// In texels of `from`; texel centres are at halves.
vec2 sourceOf(ivec2 pixel) { return (vec2(pixel) + params.centre) * params.ratio - params.centre + 0.5; }

ivec2 clampedTexel(ivec2 at) { return clamp(at, ivec2(0), ivec2(params.from) - 1); }

ivec2 nearestOf(ivec2 pixel) { return clampedTexel(ivec2(sourceOf(pixel))); }

// Relative difference of what tells surfaces apart, a distance or a history length, up to which texels count in full, and
// from which not at all.
const vec2 alike = vec2(0.5, 0.75);

// How much a texel counts beside the nearest one. The mean must not mix a surface with its background. On one surface all
// texels must count in full: weights that fall with every difference move the result toward the nearest texel, and over
// frames of ever another size the light wanders.
float likeness(float guide, float nearest) {
    float off = abs(guide - nearest) / max(max(abs(guide), abs(nearest)), 1e-6);
    return clamp((alike.y - off) / (alike.y - alike.x), 0.0, 1.0);
}

#endif
