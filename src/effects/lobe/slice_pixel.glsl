// A slice of a pixel: where it starts, and what it reads. The includer declares what diffuse_ray.glsl requires, params
// (TraceSlicesParams), the images ownDepth, ownNormal, ownGeometricNormal, backDepth and packed, and the constants ambient,
// sliceHorizon, sliceThickness and rejectsBackfaces.
#ifndef REFLET_SLICE_PIXEL_GLSL
#define REFLET_SLICE_PIXEL_GLSL

#include "effects/lobe/diffuse_ray.glsl"

ViewParams own = rayParams.view;
#include "effects/lobe/slice.glsl"

bool coversFromBehind() { return ambient != 0u || rejectsBackfaces == 0u; }

float loadSliceDepth(ivec2 pixel) { return texelFetch(ownDepth, pixel, 0).r; }
vec3 loadSliceNormal(ivec2 pixel) { return unpackUnitVector(texelFetch(ownGeometricNormal, pixel, 0).r); }

SliceTexel loadSlice(ivec2 pixel) {
    if (ambient != 0u) {
        SliceTexel t = SliceTexel(texelFetch(ownDepth, pixel, 0).r, params.slice.thickness,
                                  unpackUnitVector(texelFetch(ownGeometricNormal, pixel, 0).r), vec3(0.0));
        if (sliceThickness == sliceThicknessLayer) {
            float back = texelFetch(backDepth, pixel * int(params.scale) + int(params.blockOffset), 0).r;
            float away = depthToViewDistance(back, own.depthToDistance) - depthToViewDistance(t.depth, own.depthToDistance);
            t.thickness = back > 0.0 ? away : t.thickness;
        }
        return t;
    }
    uvec4 bits = imageLoad(packed, pixel);
    vec2 ba = unpackHalf2x16(bits.w);
    return SliceTexel(uintBitsToFloat(bits.x), ba.y, unpackUnitVector(bits.y), vec3(unpackHalf2x16(bits.z), ba.x));
}

#include "effects/lobe/slice_horizon.glsl"

// What all slices of a pixel start from.
struct SliceOrigin {
    ivec2 pixel;
    float depth;
    vec3 point;
    vec3 normal;  // of shading
    vec3 geometric;
};

SliceOrigin sliceOrigin(ivec2 pixel) {
    float d = texelFetch(ownDepth, pixel, 0).r;
    vec3 p = uvToWorld(pixelToUv(pixel, own.pixel), max(d, 1e-12), own.clipToWorld);
    return SliceOrigin(pixel, d, p, unpackUnitVector(texelFetch(ownNormal, pixel, 0).r),
                       unpackUnitVector(texelFetch(ownGeometricNormal, pixel, 0).r));
}

// What a slice found.
struct SliceLight {
    vec4 covered;  // radiance · share, distance · share of what covers it
    vec4 turned;   // variation of that light with the normal
    float open;    // share of its directions
    Ray ray;       // into these, one at random
    bool behind;   // it passes behind a visible surface
};

SliceLight traceSlice(SliceOrigin from, RayNumber number) {
    vec3 direction = diffuseRay(number, from.normal).direction;
    Slice s = sliceThrough(from.point, pixelToUv(from.pixel, own.pixel), from.depth, from.normal, from.geometric, direction);
    uint hash = hashPixel(uvec2(from.pixel), number.index * 2u + 1u + hashPcg(own.seed), own.frame);
    vec2 u = hashToUnit2(hash);
    vec2 shift = hashToUnit2(hashPcg(hash ^ 0x68bc21ebu));
    SliceSide ahead;
    SliceSide back;
    if (ambient != 0u && sliceHorizon != 0u) {
        ahead = walkHorizon(s, 1.0, from.pixel, from.depth, from.normal, params.slice, shift.x, u.x);
        back = walkHorizon(s, -1.0, from.pixel, from.depth, from.normal, params.slice, shift.y, u.x);
    } else {
        ahead = walkSide(s, 1.0, from.pixel, from.depth, from.normal, params.slice, shift.x, u.x);
        back = walkSide(s, -1.0, from.pixel, from.depth, from.normal, params.slice, shift.y, u.x);
    }
    SliceRest rest = restOf(s, ahead, back, u.x, u.y);
    vec4 covered = ahead.light + back.light;
    return SliceLight(vec4(clampToHalf(covered.rgb), covered.a), ahead.turning + back.turning, rest.open,
                      Ray(raiseAbove(rest.direction, from.geometric), 1.0, 1.0, 0.0, false), rest.behind);
}

#endif
