// Adds a source's result to a ray. The includer declares the images `answer` and `source`.
#ifndef REFLET_RAYS_ANSWER_GLSL
#define REFLET_RAYS_ANSWER_GLSL

// rest: the ray's weight left by the previous sources. Returns the weight left after this one.
float addAnswer(ivec3 slot, RayAnswer a, float rest, vec4 color) {
    float weight = rest * clamp(a.confidence, 0.0, 1.0);
    if (weight > 0.0) {
        vec4 sum = weight * vec4(clampToHalf(a.radiance), a.hitDistance);
        vec4 sources = weight * color;
        if (rest < 1.0) {  // else it is the ray's first answer: what the images hold is of another frame
            sum += imageLoad(answer, slot);
            sources += imageLoad(source, slot);
        }
        imageStore(answer, slot, min(sum, vec4(largestHalf)));
        imageStore(source, slot, sources);
    }
    return rest - weight;
}

#endif
