// Adds a source's result to a ray. The includer declares the images `answer` and `source`.
#ifndef REFLET_RAYS_ANSWER_GLSL
#define REFLET_RAYS_ANSWER_GLSL

// rest: the ray's weight left by the previous sources. Returns the weight left after this one.
float addAnswer(ivec3 slot, RayAnswer a, float rest, vec4 color) {
    float weight = rest * clamp(a.confidence, 0.0, 1.0);
    if (weight > 0.0) {
        vec4 sum = imageLoad(answer, slot) + weight * vec4(clampToHalf(a.radiance), a.hitDistance);
        imageStore(answer, slot, min(sum, vec4(largestHalf)));
        vec4 sources = imageLoad(source, slot) + weight * color;
        imageStore(source, slot, sources);
    }
    return rest - weight;
}

#endif
