// Adds a source's result to a ray of a list. The includer declares the images `answer` and `source`.
#ifndef REFLET_RAYS_ANSWER_GLSL
#define REFLET_RAYS_ANSWER_GLSL

// rest: the ray's weight left by the previous sources. Returns the weight left after this one.
float addAnswer(ivec3 slot, RayAnswer a, float rest, vec4 color) {
    if (rest * a.confidence <= 0.0) {
        return rest;
    }
    AnswerSum sum = AnswerSum(imageLoad(answer, slot), imageLoad(source, slot));
    float left = addAnswer(sum, a, rest, color);
    imageStore(answer, slot, sum.light);
    imageStore(source, slot, sum.colors);
    return left;
}

#endif
