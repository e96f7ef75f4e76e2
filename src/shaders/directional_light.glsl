// Directional diffuse light: the dependence of a surface's irradiance on its normal, in luminance, light(n) = a +
// dot(rgb, n), a constant and a linear term (Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance
// Environment Maps, 2001; the terms that are left out are mostly 1 % of the light or less). Both terms are sums over
// rays, so they can be averaged over neighbours and frames. It lets neighbours with different normals share light, and
// low-resolution light follow full-resolution normals.
#ifndef REFLET_DIRECTIONAL_LIGHT_GLSL
#define REFLET_DIRECTIONAL_LIGHT_GLSL

// Clamp of the cosine of grazing rays: each would stand for much of the light, and be noisy.
const float grazingCosine = 0.1;
const float maxRelightFactor = 3.0;  // bounds the change of light by another normal

// From one cosine-distributed ray. light: its luminance times its weight.
vec4 directionalFromRay(float light, vec3 direction, vec3 normal) {
    return light / max(dot(direction, normal), grazingCosine) * vec4(0.5 * direction, 0.25);
}

// The mean of that for rays with the same light from all directions.
vec4 directionalFromHemisphere(float light, vec3 normal) { return light * vec4(0.498 * normal, 0.475); }

// The same for light that is equal from all directions.
vec4 directionalFromAmbient(float light) { return vec4(vec3(0.0), light); }

// Factor on light that was gathered for the mean normal `from`, to show it on a surface with normal `to`.
float relightFactor(vec4 directional, vec3 from, vec3 to) {
    float before = directional.a + dot(directional.rgb, from);
    float after = directional.a + dot(directional.rgb, to);
    return before > 1e-6 ? clamp(after / before, 1.0 / maxRelightFactor, maxRelightFactor) : 1.0;
}

#endif
