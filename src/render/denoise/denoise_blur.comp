// One blur over neighbours on the same surface, on a disk that is turned from pixel to pixel. Its radius follows how long
// the light is remembered, how far its rays went and how wide the lobe is; what differs by more than noise does not count.
// In: light with hit distance, surfaces, moments, geometric normals. Out: light, blurred; where little is remembered, the
// next frame remembers that instead.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "render/denoise/denoise.glsl"
#include "shaders/ggx.glsl"
#include "shaders/noise.glsl"

layout(constant_id = 0) const uint lobe = 0u;
layout(constant_id = 1) const uint feedsBack = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { DenoiseBlurParams params; };
layout(set = 0, binding = 1, rgba16f) uniform readonly image2D from;
layout(set = 0, binding = 2, rg32ui) uniform readonly uimage2D surface;
layout(set = 0, binding = 3, rg16f) uniform readonly image2D moments;
layout(set = 0, binding = 4) uniform usampler2D geometricNormal;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D nextLight;
layout(set = 0, binding = 6, rgba16f) uniform writeonly image2D blurred;

const int taps = 8;
const float goldenAngle = 2.39996323;
// Of what a ray spans on the way to what it hit, the share over which it brings about the same.
const float shareOfWay = 0.3;
const float rememberedLong = 4.0;  // frames, from which on the past is kept as it is

// Pixels of the grid.
float radiusAt(float d, float roughness, float hitDistance, float frames) {
    float away = depthToViewDistance(d, params.view.depthToDistance);
    float pixelWidth = params.gridAngle * (params.view.eye.w > 0.0 ? away : 1.0);
    float lobeWidth = lobe == 0u ? 1.0 : ggxHalfTangent(roughness * roughness);
    float way = shareOfWay * lobeWidth * hitDistance / pixelWidth;
    return min(params.radius, way) * inversesqrt(max(frames, 1.0));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(params.view.size);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    vec4 middle = imageLoad(from, pixel);
    KeptSurface own = unpackSurface(imageLoad(surface, pixel).xy);
    vec2 m = imageLoad(moments, pixel).xy;
    float radius = own.depth > 0.0 ? radiusAt(own.depth, own.roughness, middle.a, m.x) : 0.0;
    if (radius < 0.5) {
        imageStore(blurred, pixel, middle);
        return;
    }
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), own.depth, params.view.clipToWorld);
    vec3 geometric = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    ScreenPlane plane = screenPlane(p, geometric, params.view.clipToWorld, params.view.pixel, params.view.pixelAngle);
    float turn = 6.2831853 * hashToUnit(hashPixel(uvec2(pixel), params.pass + 31u + 2u * lobe, params.view.frame));
    vec4 sum = middle;
    float weights = 1.0;
    for (int i = 0; i < taps; ++i) {
        float angle = turn + float(i) * goldenAngle;
        float reach = sqrt((float(i) + 0.5) / float(taps));
        ivec2 at = pixel + ivec2(round(radius * reach * vec2(cos(angle), sin(angle))));
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) {
            continue;
        }
        KeptSurface there = unpackSurface(imageLoad(surface, at).xy);
        vec2 o = vec2(at - pixel);
        if (there.depth > 0.0 && onSurface(plane, o, there.depth - own.depth)) {
                        float weight = exp(-1.5 * reach * reach) * alike(own, there, lobe);
            sum += weight * imageLoad(from, at);
            weights += weight;
        }
    }
    vec4 mean = roundToHalf(min(sum / weights, vec4(largestHalf)));
    imageStore(blurred, pixel, mean);
    if (feedsBack != 0u && m.x < rememberedLong) {
        imageStore(nextLight, pixel, mean);
    }
}
