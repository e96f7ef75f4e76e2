// White noise by hashing: PCG (Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 2020).
#ifndef REFLET_NOISE_GLSL
#define REFLET_NOISE_GLSL

uint hashPcg(uint v) {
    uint state = v * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Hash of a pixel, a stream (which ray, which use) and a frame.
uint hashPixel(uvec2 pixel, uint stream, uint frame) {
    return hashPcg(pixel.x + hashPcg(pixel.y + hashPcg(stream + hashPcg(frame))));
}

// The 24 high bits as a number in [0, 1): every value is exact, and 1 is never reached.
float hashToUnit(uint h) { return float(h >> 8u) * (1.0 / 16777216.0); }

// Two independent numbers in [0, 1).
vec2 hashToUnit2(uint h) { return vec2(hashToUnit(h), hashToUnit(hashPcg(h ^ 0x9e3779b9u))); }

#endif
