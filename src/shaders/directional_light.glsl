// How a surface's diffuse light changes with its normal: in luminance, light(n) = a + dot(rgb, n), a constant and a
// linear part (Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001: what they leave
// out is 1 % of the light, or less, for most). Both are sums over rays, so that means of it over neighbours and frames are
// what it means for them. It lets neighbours with other normals share light, and coarse light follow fine normals.
#ifndef REFLET_DIRECTIONAL_LIGHT_GLSL
#define REFLET_DIRECTIONAL_LIGHT_GLSL

// Rays that graze the surface count as if they came at this cosine: few of them stand for much, which would be noise.
const float grazingCosine = 0.1;
const float mostTurned = 3.0;  // by which turning the normal may change light

// Of one ray that was drawn by the cosine; light: its luminance times its weight.
vec4 directionalOf(float light, vec3 direction, vec3 normal) {
    return light / max(dot(direction, normal), grazingCosine) * vec4(0.5 * direction, 0.25);
}

// The same for light that comes from everywhere alike.
vec4 directionalOfAll(float light) { return vec4(vec3(0.0), light); }

// Factor on light where `from` is the mean of the normals that it is for, and `to` that of who shows it.
float turned(vec4 directional, vec3 from, vec3 to) {
    float before = directional.a + dot(directional.rgb, from);
    float after = directional.a + dot(directional.rgb, to);
    return before > 1e-6 ? clamp(after / before, 1.0 / mostTurned, mostTurned) : 1.0;
}

#endif
