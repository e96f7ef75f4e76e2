// Packs what slices read of a surface into one texel, so that a look-up is one load. In: depth and geometric normal of the
// surfaces that slices start from; back depth; what screen_light.glsl reads. Out: depth, normal, radiance and thickness.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/lobe/ray_surfaces.h"
#include "effects/lobe/screen_light.glsl"

layout(constant_id = 21) const uint secondLayer = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform PickBlock { PickSurfacesParams picks; };
uniform sampler2D backDepth;
uniform sampler2D ownDepth;
uniform usampler2D ownGeometricNormal;
layout(rgba32ui) uniform writeonly uimage2D packed;

// Distance from the surface to its back face along the view; without one, the settings' thickness.
float thicknessAt(ivec2 pixel, float d) {
    float back = texelFetch(backDepth, pixel, 0).r;
    vec4 toDistance = params.view.depthToDistance;
    return back > 0.0 ? depthToViewDistance(back, toDistance) - depthToViewDistance(d, toDistance)
                      : params.settings.thickness;
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, ivec2(picks.picked)))) {
        return;
    }
    ivec2 pixel = min(at * int(picks.scale) + int(picks.blockOffset), ivec2(params.view.size) - 1);
    float d = texelFetch(ownDepth, at, 0).r;
    vec4 seen = vec4(0.0);
    if (d > 0.0) {
        seen = vec4(clampToHalf(lightAt(pixel, 1.0, false)), params.settings.thickness);
        if (secondLayer != 0u) {
            seen.a = min(thicknessAt(pixel, d), largestHalf);
        }
    }
    imageStore(packed, at,
               uvec4(floatBitsToUint(d), texelFetch(ownGeometricNormal, at, 0).r, packHalf2x16(seen.rg), packHalf2x16(seen.ba)));
}
