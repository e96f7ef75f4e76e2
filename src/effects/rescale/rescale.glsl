// Where the texels of a resampled image lie. The includer declares params as RescaleParams.
#ifndef REFLET_EFFECTS_RESCALE_GLSL
#define REFLET_EFFECTS_RESCALE_GLSL

bool isInside(ivec2 pixel) { return all(lessThan(pixel, ivec2(params.to))); }

// In texels of `from`; texel centres are at halves.
vec2 sourceOf(ivec2 pixel) { return (vec2(pixel) + 0.5) * params.ratio; }

ivec2 clampedTexel(ivec2 at) { return clamp(at, ivec2(0), ivec2(params.from) - 1); }

ivec2 nearestOf(ivec2 pixel) { return clampedTexel(ivec2(sourceOf(pixel))); }

// How much a texel counts beside the nearest one, by what tells surfaces apart: a distance, or a history length. The mean
// must not mix a surface with its background.
float likeness(float guide, float nearest) {
    return max(1.0 - 2.0 * abs(guide - nearest) / max(max(abs(guide), abs(nearest)), 1e-6), 0.0);
}

#endif
