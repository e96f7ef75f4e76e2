// Follows the view rays through a layer of glass. In: the layer's depth, normals, material; what it is made of; depth and
// normals of its back faces. Out: where each ray leaves the glass, the normal and the direction there, the list of these
// rays, and the share of their light that reaches the viewer. Where the material disperses light (KHR_materials_dispersion)
// red, green and blue have a ray each.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "effects/lobe/rays.glsl"
#include "renderer/glass/glass.h"
#include "renderer/material.h"
#include "shaders/not_inlined.glsl"
#include "shaders/projection.glsl"
#include "shaders/refraction.glsl"

layout(constant_id = 0) const uint disperses = 0u;   // 1: some materials do
layout(constant_id = 1) const uint fromInside = 0u;  // 1: the camera is in a medium

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { RefractParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D material;
uniform sampler2D tint;
uniform sampler2D volume;
uniform usampler2D kind;
uniform sampler2D exitDepth;
uniform usampler2D exitNormal;
uniform sampler2D ggxTable;
layout(rgba32f) uniform writeonly image2DArray origins;
layout(r32ui) uniform writeonly uimage2D leavingNormal;
layout(rgba16f) uniform writeonly image2D share;
layout(rg32ui) uniform writeonly uimage2DArray direction;
layout(rgba16f) uniform writeonly image2DArray answer;
layout(rgba8) uniform writeonly image2DArray source;
#include "effects/lobe/rays_append.glsl"

// A ray at a boundary of the glass.
struct Crossing {
    vec3 point;
    vec3 normal;     // outward
    vec3 direction;  // of the ray inside
    float path;      // metres inside
};

struct BackFace {
    bool found;
    vec3 point;
    vec3 normal;
};

BackFace backFaceAt(ivec2 pixel, uint same) {
    BackFace b;
    float d = texelFetch(exitDepth, pixel, 0).r;
    b.found = d > 0.0 && texelFetch(kind, pixel, 0).r == same;
    b.point = uvToWorld(pixelToUv(pixel, params.view.pixel), max(d, 1e-12), params.view.clipToWorld);
    b.normal = unpackUnitVector(texelFetch(exitNormal, pixel, 0).r);
    return b;
}

// Where a ray inside leaves: the back face is taken for its tangent plane at the pixel of the last estimate, again and
// again. Without a back face: a slab.
Crossing findExit(ivec2 pixel, vec3 p, vec3 n, vec3 inside, float thickness) {
    Crossing c = Crossing(p + inside * thickness, -n, inside, thickness);
    uint exitSteps = notInlined(params.exitSteps, gl_GlobalInvocationID.x);
    if (exitSteps == 0u) {
        return c;
    }
    uint same = texelFetch(kind, pixel, 0).r;
    BackFace back = backFaceAt(pixel, same);
    float longest = back.found ? 4.0 * distance(back.point, p) : 0.0;
    for (uint i = 0u; i < exitSteps && back.found; ++i) {
        float slope = dot(inside, back.normal);
        float path = slope > 0.02 ? dot(back.point - p, back.normal) / slope : distance(back.point, p);
        path = clamp(path, 0.0, longest);
        c = Crossing(p + inside * path, back.normal, inside, path);
        vec4 clip = params.view.worldToClip * vec4(c.point, 1.0);
        vec2 uv = ndcToUv(clip.xy / clip.w);
        bool onScreen = clip.w > 0.0 && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
        back = onScreen ? backFaceAt(ivec2(uv * params.view.size), same) : BackFace(false, vec3(0.0), vec3(0.0));
    }
    return c;
}

// A ray that total reflection keeps inside is taken to leave through a face opposite to the front.
vec3 leave(inout Crossing c, vec3 n, float ior, vec4 dielectric, inout vec3 light) {
    vec3 outside;
    if (!refractAt(c.direction, c.normal, ior, outside)) {
        c.direction = reflect(c.direction, c.normal);
        c.normal = -n;
        if (!refractAt(c.direction, c.normal, ior, outside)) {
            outside = c.direction;
        }
        c.normal = outside;
        return outside;
    }
    light *= 1.0 - fresnelSchlick(dielectric.rgb, dielectric.a, dot(outside, c.normal));
    return outside;
}

// A layer of glass at a pixel.
struct Pane {
    ivec2 pixel;
    vec3 point;
    vec3 normal;  // of shading
    vec3 toEye;
    vec4 passes;  // share of the light that passes the surface, thickness [m]
    vec4 inside;  // extinction [1/m], index of refraction
    float roughness;
    vec4 dielectric;
};

struct Refracted {
    Crossing exit;
    vec3 direction;
    vec3 light;  // share that reaches the viewer
};

Refracted refractBy(Pane pane, float ior, vec3 light) {
    vec3 bent;
    refractAt(-pane.toEye, -pane.normal, 1.0 / ior, bent);
    Refracted r;
    r.exit = findExit(pane.pixel, pane.point, pane.normal, bent, pane.passes.a);
    r.light = light * pane.passes.rgb * exp(-pane.inside.rgb * r.exit.path);
    r.direction = leave(r.exit, pane.normal, ior, pane.dielectric, r.light);
    return r;
}

// Out of the medium that the camera is in. ratio: index of refraction inside over that outside.
Refracted leaveMedium(Pane pane, vec3 geometric, float ratio, vec3 light) {
    vec3 along = -pane.toEye;
    Refracted r = Refracted(Crossing(pane.point, -geometric, along, 0.0), along, light);
    if (refractAt(along, -pane.normal, ratio, r.direction)) {
        float cosine = max(dot(r.direction, -pane.normal), 0.0);
        r.light = pane.passes.rgb * (1.0 - fresnelSchlick(pane.dielectric.rgb, pane.dielectric.a, cosine));
    } else {
        r.direction = reflect(along, pane.normal);
        r.exit.normal = geometric;
    }
    return r;
}

void emitRay(Pane pane, int layer, Refracted r, float ior) {
    float spread = pane.passes.a != 0.0 ? refractedRoughness(pane.roughness, ior) : pane.roughness;
    bool frosted = spread > frostedFrom && notInlined(params.frosted, gl_GlobalInvocationID.x) != 0u;
    Ray ray = Ray(r.direction, 1.0, 1.0, frosted ? spread : 0.0, false);
    imageStore(origins, ivec3(pane.pixel, layer), vec4(r.exit.point, r.exit.path));
    imageStore(direction, ivec3(pane.pixel, layer), uvec4(packRay(ray), 0u, 0u));
    appendRay(WaitingRay(ivec3(pane.pixel, layer), 1.0, 0.0, false, vec3(0.0)));
}

void refractPixel(ivec2 pixel, float d) {
    vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
    vec3 v = directionToEye(p, params.view.eye);
    MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
    m.metallic = 0.0;
    Pane pane = Pane(pixel, p, n, v, texelFetch(tint, pixel, 0), texelFetch(volume, pixel, 0), m.roughness, dielectricAt(pixel));
    vec3 light = pane.passes.rgb * surfaceAt(pixel, vec3(1.0), m, max(dot(n, v), 1e-3), ggxTable, false).diffuse;
    vec3 geometric = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    Refracted r = Refracted(Crossing(p, -geometric, -v, 0.0), -v, light);
    float ior = max(pane.inside.a, 1.0);
    bool split = false;
    if (fromInside != 0u && pane.passes.a < 0.0) {
        r = leaveMedium(pane, geometric, ior / params.outerIor, light);
    }
    if (pane.passes.a > 0.0) {
        r = refractBy(pane, ior, light);
        float dispersion = disperses != 0u ? float(texelFetch(kind, pixel, 0).r >> glassKindBits) / glassDispersionSteps : 0.0;
        split = dispersion > 0.0;
        for (int side = -1; split && side <= 1; side += 2) {
            float other = dispersedIndex(ior, dispersion, float(side));
            Refracted o = refractBy(pane, other, light);
            emitRay(pane, side + 1, o, other);
            r.light = side < 0 ? vec3(o.light.r, r.light.gb) : vec3(r.light.rg, o.light.b);
        }
    }
    emitRay(pane, split ? 1 : 0, r, ior);
    imageStore(leavingNormal, pixel, uvec4(packUnitVector(r.exit.normal), 0u, 0u, 0u));
    imageStore(share, pixel, vec4(r.light, split ? 3.0 : 1.0));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    for (int i = 0; i < (disperses != 0u ? 3 : 1); ++i) {
        imageStore(answer, ivec3(pixel, i), vec4(0.0));
        imageStore(source, ivec3(pixel, i), vec4(0.0));
    }
    float d = texelFetch(depth, pixel, 0).r;
    if (d > 0.0) {
        refractPixel(pixel, d);
    }
}
