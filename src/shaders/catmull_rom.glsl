// Taps and weights of a Catmull-Rom filter: it interpolates the texels and stays sharp under repeated resampling.
// (Catmull and Rom, A Class of Local Interpolating Splines, 1974)
#ifndef REFLET_CATMULL_ROM_GLSL
#define REFLET_CATMULL_ROM_GLSL

struct CatmullRom {
    ivec2 corner;
    ivec2 first;  // range of taps around the corner: -1 to 2, or only 0 at a texel's centre
    ivec2 last;
    vec4 x;  // weights of the taps from -1 on; their sum is 1
    vec4 y;
};

vec4 catmullRomWeights(float f) {
    float g = 1.0 - f;
    float before = -0.5 * f * g * g;
    float after = -0.5 * g * f * f;
    float second = f * (0.5 + f * (2.0 - 1.5 * f));
    return vec4(before, 1.0 - before - after - second, second, after);
}

// at: position in texels, relative to the centre of the first. Positions within 1/64 of a texel's centre snap to it.
CatmullRom catmullRom(vec2 at) {
    vec2 whole = floor(at + 0.5);
    bvec2 onCentre = lessThan(abs(at - whole), vec2(1.0 / 64.0));
    vec2 corner = mix(floor(at), whole, onCentre);
    vec2 f = mix(at - corner, vec2(0.0), onCentre);
    ivec2 off = ivec2(not(onCentre));
    return CatmullRom(ivec2(corner), -off, 2 * off, catmullRomWeights(f.x), catmullRomWeights(f.y));
}

#endif
