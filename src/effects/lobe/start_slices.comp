// Gathers the diffuse light of what covers slices, and leaves one ray per slice to the next source, into what is open.
// In: depth and both normals, blue noise, tiles; packed surfaces. Out: direction, answer and source of the rays, correction of their directional
// term, steps, and the list of rays.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "base/strips.h"
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/rays.glsl"
#include "effects/lobe/trace_slices.h"

layout(constant_id = 0) const uint lobe = lobeDiffuse;
layout(constant_id = 1) const uint noise = RayNoise_blue;
layout(constant_id = 2) const uint distribution = RayDistribution_cosine;
layout(constant_id = 3) const uint ambient = 0u;  // white light from everywhere, and black surfaces
layout(constant_id = 4) const uint countSteps = 0u;
layout(constant_id = 5) const uint hasDirectional = 0u;
const uint adaptive = 0u;
layout(constant_id = 9) const uint sliceHorizon = 0u;
layout(constant_id = 10) const uint sliceThickness = 0u;
layout(constant_id = 11) const uint rejectsBackfaces = 0u;
layout(constant_id = 12) const uint sliceLight = 1u;  // 0: only what is covered

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { TraceSlicesParams params; };
layout(scalar) uniform RayBlock { GenerateRaysParams rayParams; };
uniform sampler2D ownDepth;
uniform usampler2D ownNormal;
uniform usampler2D ownGeometricNormal;
uniform sampler2D backDepth;
layout(scalar) readonly buffer BlueNoiseBlock { uint texels[]; } blueNoise;
layout(rg32f) uniform readonly image2D tiles;
layout(rgba32ui) uniform readonly uimage2D packed;
layout(rg32ui) uniform writeonly uimage2DArray direction;
layout(rgba16f) uniform writeonly image2DArray answer;
layout(rgba8) uniform writeonly image2DArray source;
layout(rgba16f) uniform writeonly image2DArray turning;
layout(r32f) uniform writeonly image2DArray steps;
#include "effects/lobe/rays_append.glsl"
#include "effects/lobe/slice_pixel.glsl"

const SliceLight noLight =
    SliceLight(vec4(0.0), vec4(0.0), 0.0, Ray(vec3(0.0, 0.0, 1.0), 0.0, 0.0, 0.0, false), false);

void store(ivec3 slot, SliceOrigin from, SliceLight found) {
    imageStore(direction, slot, uvec4(packRay(found.ray), 0u, 0u));
    imageStore(answer, slot, min(found.covered, vec4(largestHalf)));
    imageStore(source, slot, from.depth > 0.0 ? (1.0 - found.open) * sourceScreen : vec4(0.0));
    if (hasDirectional != 0u) {
        // resolve_rays.comp takes the ray's direction for that of all light of the slice.
        vec4 taken = directionalFromRay(luminance(found.covered.rgb), found.ray.direction, from.normal);
        imageStore(turning, slot, clamp(found.turned - taken, -largestHalf, largestHalf));
    }
    if (countSteps != 0u) {
        imageStore(steps, slot, vec4(from.depth > 0.0 ? 2.0 * float(params.slice.steps) : 0.0));
    }
    if (found.open > 0.0) {
        appendRay(WaitingRay(slot, found.open, 0.0, found.behind, vec3(0.0)));
    }
}

void tracePixel(ivec2 pixel, uint count) {
    SliceOrigin from = sliceOrigin(pixel);
    uint end = min(rayParams.firstRay + rayParams.rayCount, count);
    for (uint i = rayParams.firstRay; i < end; ++i) {
        ivec3 slot = ivec3(pixel, i - rayParams.firstRay);
        if (from.depth > 0.0) {
            store(slot, from, traceSlice(from, RayNumber(pixel, i, count)));
        } else {
            store(slot, from, noLight);
        }
    }
}

void main() {
    ivec2 pixel = pixelInStrips();
    if (all(lessThan(pixel, ivec2(own.size)))) {
        float share = imageLoad(tiles, pixel / int(rayTileSide)).r;
        tracePixel(pixel, pixelRays(share, uvec2(pixel), own.frame));
    }
}
