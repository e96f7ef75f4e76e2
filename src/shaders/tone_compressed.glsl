// Tone-compressed radiance, YCoCg over 1 + luma: bright texels do not dominate averages, and clamping limits along its
// axes are tight. (Karis, High Quality Temporal Supersampling, SIGGRAPH 2014)
#ifndef REFLET_TONE_COMPRESSED_GLSL
#define REFLET_TONE_COMPRESSED_GLSL

vec3 toneCompress(vec3 radiance) {
    float y = dot(radiance, vec3(0.25, 0.5, 0.25));
    vec2 c = vec2(0.5 * (radiance.r - radiance.b), 0.5 * radiance.g - 0.25 * (radiance.r + radiance.b));
    return vec3(y, c) * (1.0 / (1.0 + y));
}

vec3 toneExpand(vec3 compressed) {
    vec3 v = compressed / max(1.0 - compressed.x, 1e-5);
    float base = v.x - v.z;
    return vec3(base + v.y, v.x + v.z, base - v.y);
}

#endif
