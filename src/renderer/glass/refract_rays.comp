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

const uint innerReflections = 4u;  // that a ray is followed through
const uint searchSteps = 8u;       // until a face is found that the ray meets

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

// A ray at a boundary of the glass.
struct Crossing {
    vec3 point;
    vec3 normal;     // outward
    vec3 direction;  // of the ray inside
    float path;      // metres inside
};

float distanceToEye(vec3 p) { return params.view.eye.w > 0.0 ? distance(p, params.view.eye.xyz) : 1.0; }

struct Face {
    bool found;
    vec3 point;
    vec3 normal;  // outward
};

const Face noFace = Face(false, vec3(0.0), vec3(0.0));

// The back face of the glass at a pixel, or its front.
Face faceAt(ivec2 pixel, uint same, bool front) {
    float d = front ? texelFetch(depth, pixel, 0).r : texelFetch(exitDepth, pixel, 0).r;
    uint n = front ? texelFetch(normal, pixel, 0).r : texelFetch(exitNormal, pixel, 0).r;
    vec3 point = uvToWorld(pixelToUv(pixel, params.view.pixel), max(d, 1e-12), params.view.clipToWorld);
    return Face(d > 0.0 && texelFetch(kind, pixel, 0).r == same, point, unpackUnitVector(n));
}

Face faceAround(vec3 point, uint same, bool front) {
    vec4 clip = params.view.worldToClip * vec4(point, 1.0);
    vec2 uv = ndcToUv(clip.xy / clip.w);
    bool onScreen = clip.w > 0.0 && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)));
    return onScreen ? faceAt(ivec2(uv * params.view.size), same, front) : noFace;
}

// Where a ray inside meets a face: that at the last estimate is taken for its tangent plane, again and again. Near the
// silhouette the first one faces away from the ray, which goes to the other side of the glass: the estimate then moves
// on, twice as far each time, until one faces it, and half way back where there is no glass. Returns false if none does.
bool follow(inout Crossing c, float guess, uint same, bool front) {
    uint exitSteps = notInlined(params.exitSteps, gl_GlobalInvocationID.x);
    vec3 p = c.point;
    float least = 2.0 * params.view.pixelAngle * distanceToEye(p);
    float longest = max(4.0 * guess, 0.25 * params.view.size.y * 0.5 * least);
    float path = guess;
    float within = 0.0;
    uint planes = 0u;
    for (uint i = 0u; i < exitSteps + searchSteps && planes < exitSteps; ++i) {
        Face face = faceAround(p + c.direction * path, same, front);
        float slope = dot(c.direction, face.normal);
        float ahead = dot(face.point - p, face.normal);
        if (!face.found) {
            if (planes > 0u) {
                break;
            }
            path = 0.5 * (within + path);
        } else if (slope > 0.02 && ahead > 0.0) {
            path = min(ahead / slope, longest);
            c.point = p + c.direction * path;
            c.normal = face.normal;
            c.path = path;
            ++planes;
        } else {
            within = path;
            path = min(max(2.0 * path, least), longest);
        }
    }
    return planes > 0u;
}

// Without a back face: a slab.
Crossing findExit(Pane pane, vec3 inside, uint same) {
    Face back = faceAt(pane.pixel, same, false);
    Crossing c = Crossing(pane.point, -pane.normal, inside, 0.0);
    if (!back.found || !follow(c, distance(back.point, pane.point), same, false)) {
        c.point += inside * pane.passes.a;
        c.path = pane.passes.a;
    }
    return c;
}

bool staysInside(Crossing c, float ior) {
    float slope = dot(c.direction, c.normal);
    return ior * ior * (1.0 - slope * slope) >= 1.0;
}

// Follows a ray that total reflection keeps inside to the next boundary, a front or a back face by where it goes.
bool goOn(inout Crossing c, uint same) {
    Crossing next = Crossing(c.point, c.normal, reflect(c.direction, c.normal), 0.0);
    bool found = follow(next, c.path, same, dot(next.direction, directionToEye(c.point, params.view.eye)) > 0.0);
    if (found) {
        c = next;
    }
    return found;
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

struct Refracted {
    Crossing exit;
    vec3 direction;
    vec3 light;  // share that reaches the viewer
};

Refracted refractBy(Pane pane, float ior, vec3 light) {
    vec3 bent;
    refractAt(-pane.toEye, -pane.normal, 1.0 / ior, bent);
    Refracted r;
    uint same = texelFetch(kind, pane.pixel, 0).r;
    r.exit = findExit(pane, bent, same);
    float path = r.exit.path;
    for (uint i = 0u; i < innerReflections && staysInside(r.exit, ior) && goOn(r.exit, same); ++i) {
        path += r.exit.path;
    }
    r.light = light * pane.passes.rgb * exp(-pane.inside.rgb * path);
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
