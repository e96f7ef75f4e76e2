// A pixel's reflected light, upsampled if it was traced at reduced resolution. Reads `depth` and `normal` of the G-buffer.
#ifndef REFLET_UPSAMPLE_SPECULAR_GLSL
#define REFLET_UPSAMPLE_SPECULAR_GLSL

#include "effects/lobe/upsample.glsl"
#include "shaders/octahedral.glsl"

layout(constant_id = 1) const uint specularScale = 1u;  // pixels along a block's side; 0: the lobe is black

layout(rgba16f) uniform readonly image2D specular;  // LobeLight.radiance
layout(r32f) uniform readonly image2D specularDepth;
layout(r32ui) uniform readonly uimage2D specularNormal;

// Mean radiance of the lobe, and mean hit distance [m]. blockOffset: blockPixelOffset of specularScale. shift: LobeLight.shift.
vec4 specularLight(Shown shown, uint blockOffset, vec2 shift) {
    if (specularScale == 0u) {
        return vec4(0.0);
    }
    if (specularScale == 1u && shift == vec2(0.0)) {
        return imageLoad(specular, shown.pixel);
    }
    ivec2 size = imageSize(specular);
    Blocks b = blocksAt(shown, specularScale, blockOffset, shift, size);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 block = blockAt(b, i, size);
        vec2 away = vec2(block * int(specularScale) + int(blockOffset) - shown.pixel);
        float d = specularScale == 1u ? texelFetch(depth, block, 0).r : imageLoad(specularDepth, block).r;
        vec3 n = unpackUnitVector(specularScale == 1u ? texelFetch(normal, block, 0).r : imageLoad(specularNormal, block).r);
        float same = onSameSurface(shown, away, d) * facingLike(n, shown.normal, false);
        float weight = weighed(b.weights[i], same, d);
        sum += weight * imageLoad(specular, block);
        weights += weight;
    }
    return sum * (1.0 / max(weights, 1e-12));
}

#endif
