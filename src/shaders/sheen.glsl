// The lobe of fibres (KHR_materials_sheen): A. C. Estevez, C. Kulla, Production Friendly Microfacet Sheen BRDF, SIGGRAPH
// 2017 course.
#ifndef REFLET_SHEEN_GLSL
#define REFLET_SHEEN_GLSL

#include "shaders/sampling.glsl"

// Below this perceptual roughness a sheen is seen at the silhouette alone.
const float leastSheenRoughness = 0.07;

float sheenAlpha(float roughness) {
    float r = max(roughness, leastSheenRoughness);
    return r * r;
}

// The authors' fit of log(Lambda), between alpha 1 and 0 by (1 - alpha)^2.
float sheenLambdaCurve(float x, float t) {
    return mix(21.5473, 25.3245, t) / (1.0 + mix(3.82987, 3.32435, t) * pow(x, mix(0.19823, 0.16801, t))) +
           mix(-1.97760, -1.27393, t) * x + mix(-4.32054, -4.85967, t);
}

float sheenLambda(float cosine, float alpha) {
    float t = (1.0 - alpha) * (1.0 - alpha);
    return exp(cosine < 0.5 ? sheenLambdaCurve(cosine, t)
                            : 2.0 * sheenLambdaCurve(0.5, t) - sheenLambdaCurve(1.0 - cosine, t));
}

// BRDF of a white sheen. nl, nv > 0; nh: cosine between normal and half vector.
float sheenBrdf(float nl, float nv, float nh, float roughness) {
    float alpha = sheenAlpha(roughness);
    float sine = sqrt(max(1.0 - nh * nh, 0.0));
    float density = (2.0 + 1.0 / alpha) * pow(sine, 1.0 / alpha) / (2.0 * pi);
    return density / ((1.0 + sheenLambda(nv, alpha) + sheenLambda(nl, alpha)) * 4.0 * max(nv * nl, 1e-6));
}

#endif
