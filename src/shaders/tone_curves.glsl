// Tone curves: linear Rec. 709 in, linear display light in 0..1 out; and the sRGB encoding.
#ifndef REFLET_TONE_CURVES_GLSL
#define REFLET_TONE_CURVES_GLSL

// What a dielectric surface reflects at normal incidence; the neutral curve takes it off again.
const float dielectricReflectance = 0.04;

// IEC 61966-2-1.
vec3 encodeSrgb(vec3 c) {
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

// The ACES reference rendering and output transforms for Rec. 709, as fitted by S. Hill (2016).
vec3 toneAces(vec3 c) {
    const mat3 toRrt = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 toDisplay = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = toRrt * c;
    vec3 a = v * (v + 0.0245786) - 0.000090537;
    vec3 b = v * (0.983729 * v + 0.4329510) + 0.238081;
    return clamp(toDisplay * (a / b), 0.0, 1.0);
}

// One side of a sigmoid through a pivot with a given slope there, that reaches the corner `room` away.
vec3 sigmoidSide(vec3 x, vec2 room, float slope, float power) {
    float scale = pow(pow(slope * room.x, -power) * (pow(slope * room.x / room.y, power) - 1.0), -1.0 / power);
    vec3 term = slope * x / scale;
    return scale * term / pow(1.0 + pow(term, vec3(power)), vec3(1.0 / power));
}

// AgX (T. Sobotka, 2022): a compressed gamut, a sigmoid over 16.5 stops in log space, and back.
vec3 toneAgx(vec3 c) {
    const mat3 inset = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992,
                            0.878468636469772, 0.0784336, 0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const float lowest = -12.47393;
    const float highest = 4.026069;
    const vec2 pivot = vec2(10.0 / 16.5, 0.489437);  // middle grey: 0.18 to the power of 1 / 2.4
    const float slope = 2.0;
    vec3 x = clamp((log2(max(inset * c, vec3(1e-10))) - lowest) / (highest - lowest), 0.0, 1.0);
    vec3 shoulder = pivot.y + sigmoidSide(max(x - pivot.x, 0.0), 1.0 - pivot, slope, 3.25);
    vec3 toe = pivot.y - sigmoidSide(max(pivot.x - x, 0.0), pivot, slope, 3.0);
    vec3 curve = mix(toe, shoulder, greaterThan(x, vec3(pivot.x)));
    return pow(clamp(inverse(inset) * curve, 0.0, 1.0), vec3(2.2));
}

// Khronos PBR Neutral (2024): base colours up to 0.8 stay as they are, highlights are compressed and desaturated.
vec3 toneNeutral(vec3 c) {
    const float start = 0.8 - dielectricReflectance;
    const float desaturation = 0.15;
    float lowest = min(c.r, min(c.g, c.b));
    c -= lowest < 2.0 * dielectricReflectance
             ? lowest - lowest * lowest / (4.0 * dielectricReflectance)
             : dielectricReflectance;
    float peak = max(c.r, max(c.g, c.b));
    if (peak < start) {
        return c;
    }
    float room = 1.0 - start;
    float compressed = 1.0 - room * room / (peak + room - start);
    float grey = 1.0 - 1.0 / (desaturation * (peak - compressed) + 1.0);
    return mix(c * (compressed / peak), vec3(compressed), grey);
}

#endif
