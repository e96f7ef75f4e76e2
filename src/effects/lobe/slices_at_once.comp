// Gathers diffuse light, or ambient visibility, by slices: the light of what covers them, and of the environment where they are
// open.
// In: depth and both normals, blue noise, tiles; packed surfaces (light) or depth (ambient); the environment. Out: as trace_at_once.comp.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "base/strips.h"
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/rays.glsl"
#include "effects/lobe/trace_slices.h"

layout(constant_id = 0) const uint lobe = lobeDiffuse;
layout(constant_id = 1) const uint noise = RayNoise_blue;
layout(constant_id = 2) const uint distribution = RayDistribution_cosine;
layout(constant_id = 3) const uint ambient = 0u;  // white light from everywhere, and black surfaces
layout(constant_id = 4) const uint countSteps = 0u;
layout(constant_id = 5) const uint hasDirectional = 0u;
layout(constant_id = 6) const uint adds = 0u;
layout(constant_id = 8) const uint environmentLights = 0u;
layout(constant_id = 7) const uint spreads = 0u;
const uint adaptive = 0u;
layout(constant_id = 9) const uint sliceHorizon = 0u;
layout(constant_id = 10) const uint sliceThickness = 0u;
layout(constant_id = 11) const uint rejectsBackfaces = 0u;
layout(constant_id = 12) const uint sliceLight = 1u;  // 0: only what is covered

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { TraceSlicesParams params; };
layout(scalar) uniform RayBlock { GenerateRaysParams rayParams; };
layout(scalar) uniform EnvironmentAnswerBlock { AnswerEnvironmentParams environmentAnswer; };
uniform sampler2D ownDepth;
uniform usampler2D ownNormal;
uniform usampler2D ownGeometricNormal;
uniform sampler2D ownMaterial;
uniform sampler2D backDepth;
layout(scalar) readonly buffer BlueNoiseBlock { uint texels[]; } blueNoise;
layout(rg32f) uniform readonly image2D tiles;
layout(rgba32ui) uniform readonly uimage2D packed;
layout(rgba16f) uniform image2D radiance;
layout(rgba16f) uniform image2D meanSource;
layout(r32f) uniform image2D meanSteps;
layout(rgba16f) uniform image2D directional;
#include "effects/lobe/environment_answer.glsl"
#include "effects/lobe/resolve_ray.glsl"
#include "effects/lobe/slice_pixel.glsl"

void addSlice(inout RaySum mean, SliceOrigin from, SliceLight found) {
    RayAnswer sky = RayAnswer(vec3(1.0), 1.0, params.slice.radius);
    if (ambient == 0u) {
        sky = answerOfEnvironment(found.ray, texelFetch(ownMaterial, from.pixel, 0).b, found.behind, vec3(0.0));
    }
    AnswerSum sum = AnswerSum(found.covered, (1.0 - found.open) * sourceScreen);
    addAnswer(sum, sky, found.open, sourceEnvironment);
    mean.light += sum.light;
    mean.colors += sum.colors;
    mean.steps += 2.0 * float(params.slice.steps);
    if (ambient != 0u) {
        // What is covered is missing from a hemisphere of white light: less noise than one open direction has.
        mean.turning += directionalFromHemisphere(1.0, from.normal) - found.turned;
    } else {
        float bright = found.open * luminance(clampToHalf(sky.radiance));
        mean.turning += found.turned + directionalFromRay(bright, found.ray.direction, from.normal);
    }
}

void tracePixel(ivec2 pixel, uint count, float share) {
    SliceOrigin from = sliceOrigin(pixel);
    RaySum mean = noRays();
    uint end = from.depth > 0.0 ? min(rayParams.firstRay + rayParams.rayCount, count) : 0u;
    for (uint i = rayParams.firstRay; i < end; ++i) {
        addSlice(mean, from, traceSlice(from, RayNumber(pixel, i, count)));
    }
    storeMean(pixel, mean, count, share);
}

void main() {
    ivec2 pixel = pixelInStrips();
    if (all(lessThan(pixel, ivec2(own.size)))) {
        float share = imageLoad(tiles, pixel / int(rayTileSide)).r;
        tracePixel(pixel, pixelRays(share, uvec2(pixel), own.frame), share);
    }
}
