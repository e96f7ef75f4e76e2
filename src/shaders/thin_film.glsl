// Reflectance of a thin film over a surface: L. Belcour, P. Barla, A Practical Extension to Microfacet Theory for the
// Modeling of Varying Iridescence, SIGGRAPH 2017, with the simplifications of KHR_materials_iridescence: Schlick's
// approximation at both interfaces, and two orders of interference.
#ifndef REFLET_THIN_FILM_GLSL
#define REFLET_THIN_FILM_GLSL

const float filmPi = 3.14159265358979;

float filmSchlick(float f0, float cosine) { return f0 + (1.0 - f0) * pow(clamp(1.0 - cosine, 0.0, 1.0), 5.0); }
vec3 filmSchlick(vec3 f0, float cosine) { return f0 + (1.0 - f0) * pow(clamp(1.0 - cosine, 0.0, 1.0), 5.0); }

float filmF0(float inner, float outer) {
    float root = (inner - outer) / (inner + outer);
    return root * root;
}

// Sensitivity of linear RGB at an optical path difference [m] with a phase shift: Gaussians in Fourier space, fitted to
// the CIE colour matching functions in that paper.
vec3 filmSensitivity(float path, vec3 shift) {
    float phase = 2.0 * filmPi * path;
    vec3 height = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13);
    vec3 middle = vec3(1.6810e6, 1.7953e6, 2.2084e6);
    vec3 variance = vec3(4.3278e9, 9.3046e9, 6.6121e9);
    vec3 xyz = height * sqrt(2.0 * filmPi * variance) * cos(middle * phase + shift) * exp(-variance * phase * phase);
    float second = 9.7470e-14 * sqrt(2.0 * filmPi * 4.5282e9);
    xyz.x += second * cos(2.2399e6 * phase + shift.x) * exp(-4.5282e9 * phase * phase);
    xyz /= 1.0685e-7;
    const mat3 toRgb = mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560,
                            1.0572252);
    return toRgb * xyz;
}

// Reflectance at an angle of incidence in air. thickness [nm]; f0: of the surface beneath, in air.
vec3 filmReflectance(float cosine, float ior, float thickness, vec3 f0) {
    float film = mix(1.0, ior, smoothstep(0.0, 30.0, thickness));  // a film that vanishes is none
    float sine2 = (1.0 - cosine * cosine) / (film * film);
    if (sine2 >= 1.0) {
        return vec3(1.0);
    }
    float inside = sqrt(1.0 - sine2);
    float outer = filmSchlick(filmF0(film, 1.0), cosine);
    vec3 root = sqrt(clamp(f0, vec3(0.0), vec3(0.9999)));
    vec3 base = (1.0 + root) / (1.0 - root);
    vec3 inner0 = (base - film) / (base + film);
    vec3 inner = filmSchlick(inner0 * inner0, inside);
    vec3 shift = filmPi + mix(vec3(0.0), vec3(filmPi), lessThan(base, vec3(film)));
    vec3 both = clamp(outer * inner, vec3(1e-5), vec3(0.9999));
    float passes = 1.0 - outer;
    vec3 often = passes * passes * inner / (1.0 - both);
    vec3 sum = outer + often;
    vec3 order = often - passes;
    float path = 2.0 * film * thickness * 1e-9 * inside;
    for (int m = 1; m <= 2; ++m) {
        order *= sqrt(both);
        sum += order * 2.0 * filmSensitivity(float(m) * path, float(m) * shift);
    }
    return clamp(sum, vec3(0.0), vec3(1.0));
}

// The F0 with which Schlick's approximation, with an F90 of 1, gives the film's reflectance at that angle.
vec3 filmF0At(float cosine, float ior, float thickness, vec3 f0) {
    float edge = min(pow(clamp(1.0 - cosine, 0.0, 1.0), 5.0), 0.999);
    return clamp((filmReflectance(cosine, ior, thickness, f0) - edge) / (1.0 - edge), vec3(0.0), vec3(1.0));
}

#endif
