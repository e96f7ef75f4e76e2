// Ambient occlusion of prefiltered light: of a hemisphere, or of a reflection's cone. Bound by bindAmbientOcclusion. The includer
// declares the constant lobe.
#ifndef REFLET_AMBIENT_VISIBILITY_GLSL
#define REFLET_AMBIENT_VISIBILITY_GLSL

#include "effects/lobe/rays.glsl"
#include "shaders/ggx.glsl"

layout(constant_id = 30) const uint ambientOcclusionScale = 0u;  // full-resolution pixels per pixel; 0: no AO
layout(rgba16f) uniform readonly image2D ambientOcclusion;

// Share of a cone around `direction` that lies in the cone of what is open: the overlap of two caps (Oat and Sander, Ambient
// Aperture Lighting, 2007). The open cone is that around the bent normal with as much cosine-weighted light.
float coneVisibility(vec4 open, vec3 direction, float roughness) {
    float openAngle = acos(sqrt(1.0 - open.a));
    float coneAngle = atan(ggxConeTangent(roughness * roughness));
    float apart = acos(clamp(dot(open.xyz, direction), -1.0, 1.0));
    float smaller = min(openAngle, coneAngle);
    float whole = (1.0 - cos(smaller)) / max(1.0 - cos(coneAngle), 1e-6);
    return whole * (1.0 - smoothstep(abs(openAngle - coneAngle), max(openAngle + coneAngle, 1e-4), apart));
}

// Visibility of prefiltered light along a ray of this pixel; 1 for rays of a single direction, which trace their occluders.
float ambientVisibility(ivec2 pixel, Ray ray) {
    if (ambientOcclusionScale == 0u || ray.spread == 0.0) {
        return 1.0;
    }
    vec4 open = imageLoad(ambientOcclusion, pixel * int(ambientOcclusionScale) + int(ambientOcclusionScale - 1u) / 2);
    if (lobe == lobeDiffuse) {
        return open.a;
    }
    return coneVisibility(vec4(open.xyz, clamp(open.a, 0.0, 1.0)), ray.direction, ray.spread);
}

#endif
