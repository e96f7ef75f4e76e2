// Downsamples the G-buffer by taking one pixel of each block, for tracing at reduced resolution. In: G-buffer. Out: the
// same, smaller.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/ray_surfaces.h"
#include "effects/gbuffer/gbuffer_surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { PickSurfacesParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D baseColor;
uniform sampler2D material;
uniform sampler2D motion;
layout(r32f) uniform writeonly image2D pickedDepth;
layout(r32ui) uniform writeonly uimage2D pickedNormal;
layout(r32ui) uniform writeonly uimage2D pickedGeometricNormal;
layout(rgba8) uniform writeonly image2D pickedBaseColor;
layout(rgba8) uniform writeonly image2D pickedMaterial;
layout(rg16f) uniform writeonly image2D pickedMotion;
layout(rgba16f) uniform writeonly image2D pickedReflectance;
layout(rg32ui) uniform writeonly uimage2D pickedLayers;

void main() {
    ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(block), params.picked))) {
        return;
    }
    ivec2 pixel = block * int(params.scale) + int(params.blockOffset);
    bool inside = all(lessThan(pixel, ivec2(params.size)));
    pixel = min(pixel, ivec2(params.size) - 1);
    imageStore(pickedDepth, block, inside ? texelFetch(depth, pixel, 0) : vec4(0.0));
    imageStore(pickedNormal, block, texelFetch(normal, pixel, 0));
    imageStore(pickedGeometricNormal, block, texelFetch(geometricNormal, pixel, 0));
    imageStore(pickedBaseColor, block, texelFetch(baseColor, pixel, 0));
    imageStore(pickedMaterial, block, texelFetch(material, pixel, 0));
    imageStore(pickedMotion, block, texelFetch(motion, pixel, 0));
    if (mayReflectUnusually()) {
        imageStore(pickedReflectance, block, texelFetch(surfaceReflectance, pixel, 0));
    }
    if (mayHaveSheen() || mayBeAnisotropic()) {
        imageStore(pickedLayers, block, texelFetch(surfaceLayers, pixel, 0));
    }
}
