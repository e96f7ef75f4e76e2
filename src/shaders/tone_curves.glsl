// Tone curves: linear Rec. 709 in, linear display light in 0..1 out.
// C++ too: effects/tonemap/tone_map_image.cpp includes this among GLM's names, which is why numbers end in f.
#ifndef REFLET_TONE_CURVES_GLSL
#define REFLET_TONE_CURVES_GLSL

// Reflectance of a dielectric at normal incidence; the neutral curve subtracts it.
const float dielectricReflectance = 0.04f;

// The ACES reference rendering and output transforms for Rec. 709, as fitted by S. Hill (2016).
vec3 toneAces(vec3 c) {
    const mat3 toRrt = mat3(0.59719f, 0.07600f, 0.02840f, 0.35458f, 0.90834f, 0.13383f, 0.04823f, 0.01566f, 0.83777f);
    const mat3 toDisplay =
        mat3(1.60475f, -0.10208f, -0.00327f, -0.53108f, 1.10813f, -0.07276f, -0.07367f, -0.00605f, 1.07602f);
    vec3 v = toRrt * c;
    vec3 a = v * (v + 0.0245786f) - 0.000090537f;
    vec3 b = v * (0.983729f * v + 0.4329510f) + 0.238081f;
    return clamp(toDisplay * (a / b), 0.0f, 1.0f);
}

// One side of a sigmoid through a pivot with a given slope there; it reaches the corner `room` away.
vec3 sigmoidSide(vec3 x, vec2 room, float slope, float power) {
    float scale = pow(pow(slope * room.x, -power) * (pow(slope * room.x / room.y, power) - 1.0f), -1.0f / power);
    vec3 term = slope * x / scale;
    return scale * term / pow(1.0f + pow(term, vec3(power)), vec3(1.0f / power));
}

// AgX (T. Sobotka, 2022): gamut compression, a sigmoid over 16.5 stops in log space, and back.
vec3 toneAgx(vec3 c) {
    const mat3 inset =
        mat3(0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f, 0.0784335999999992f, 0.878468636469772f,
             0.0784336f, 0.0792237451477643f, 0.0791661274605434f, 0.879142973793104f);
    const float lowest = -12.47393f;
    const float highest = 4.026069f;
    const vec2 pivot = vec2(10.0f / 16.5f, 0.489437f);  // middle grey: 0.18 to the power of 1 / 2.4
    const float slope = 2.0f;
    vec3 x = clamp((log2(max(inset * c, vec3(1e-10f))) - lowest) / (highest - lowest), 0.0f, 1.0f);
    vec3 shoulder = pivot.y + sigmoidSide(max(x - pivot.x, 0.0f), 1.0f - pivot, slope, 3.25f);
    vec3 toe = pivot.y - sigmoidSide(max(pivot.x - x, 0.0f), pivot, slope, 3.0f);
    vec3 curve = mix(toe, shoulder, greaterThan(x, vec3(pivot.x)));
    return pow(clamp(inverse(inset) * curve, 0.0f, 1.0f), vec3(2.2f));
}

// Khronos PBR Neutral (2024): base colours up to 0.8 are unchanged, highlights are compressed and desaturated. `most`:
// what they approach; 1 in the original.
vec3 toneNeutralTo(vec3 c, float most) {
    const float start = 0.8f - dielectricReflectance;
    const float desaturation = 0.15f;
    float lowest = min(c.r, min(c.g, c.b));
    c -= lowest < 2.0f * dielectricReflectance
             ? lowest - lowest * lowest / (4.0f * dielectricReflectance)
             : dielectricReflectance;
    float peak = max(c.r, max(c.g, c.b));
    if (peak < start) {
        return c;
    }
    float room = most - start;
    float compressed = most - room * room / (peak + room - start);
    float grey = 1.0f - 1.0f / (desaturation * (peak - compressed) + 1.0f);
    return mix(c * (compressed / peak), vec3(compressed), grey);
}

vec3 toneNeutral(vec3 c) { return toneNeutralTo(c, 1.0f); }

#endif
