// Surface evaluation at ray hits, equivalent to the G-buffer (gbuffer.vert, gbuffer.frag), from buffers and texture
// arrays. Bindings 26 to 31 of set 0: SceneSurfaces::bind. Include after scene_triangles.glsl and before the traversal,
// which calls acceptHit.
#ifndef REFLET_SCENE_SURFACES_GLSL
#define REFLET_SCENE_SURFACES_GLSL

#include "effects/material_features.glsl"
#include "renderer/glass/glass_share.glsl"
#include "renderer/trace_scene/scene_materials.h"
#include "renderer/trace_scene/scene_triangles.glsl"
#include "shaders/clearance.glsl"
#include "shaders/noise.glsl"
#include "shaders/shading_normal.glsl"

layout(constant_id = 43) const uint throughGlass = 0u;

// VertexAttributes (scene/scene.h); color: four 16-bit parts of 1.
struct SceneVertex {
    vec3 normal;
    vec4 tangent;
    vec2 uv0;
    vec2 uv1;
    uvec2 color;
};

layout(scalar) readonly buffer SceneVertexBlock { SceneVertex items[]; } sceneVertices;
layout(scalar) readonly buffer SceneIndexBlock { uint items[]; } sceneIndices;
layout(scalar) readonly buffer SceneInstanceBlock { SceneInstance items[]; } sceneInstances;
layout(scalar) readonly buffer SceneMaterialBlock { SceneMaterial items[]; } sceneMaterials;
uniform sampler2DArray sceneColors;
uniform sampler2DArray sceneData;

// A point on a triangle with its texture coordinates. World space, metres.
struct ScenePlace {
    uint material;
    uvec3 vertices;
    vec3 weights;   // of the vertices
    vec2 uv0;
    vec2 uv1;
    vec2 density;   // of uv0 and uv1: uv units per metre
    float width;    // of the ray's footprint [m]; 0: finest level
};

vec4 unpackVertexColor(uvec2 bits) { return vec4(unpackUnorm2x16(bits.x), unpackUnorm2x16(bits.y)); }

ScenePlace scenePlace(SceneTriangle t, vec2 barycentrics) {
    ScenePlace place;
    place.material = sceneInstances.items[t.instance].material;
    uint first = sceneInstances.items[t.instance].firstVertex;
    place.vertices = first + uvec3(sceneIndices.items[t.firstIndex], sceneIndices.items[t.firstIndex + 1u],
                                   sceneIndices.items[t.firstIndex + 2u]);
    place.weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    mat3x2 uv0 = mat3x2(sceneVertices.items[place.vertices.x].uv0, sceneVertices.items[place.vertices.y].uv0,
                        sceneVertices.items[place.vertices.z].uv0);
    mat3x2 uv1 = mat3x2(sceneVertices.items[place.vertices.x].uv1, sceneVertices.items[place.vertices.y].uv1,
                        sceneVertices.items[place.vertices.z].uv1);
    place.uv0 = uv0 * place.weights;
    place.uv1 = uv1 * place.weights;
    vec2 areas = abs(vec2(determinant(mat2(uv0[1] - uv0[0], uv0[2] - uv0[0])),
                          determinant(mat2(uv1[1] - uv1[0], uv1[2] - uv1[0]))));
    place.density = sqrt(areas / max(length(cross(t.b - t.a, t.c - t.a)), 1e-20));
    place.width = 0.0;
    return place;
}

bool hasSceneTexture(ScenePlace place, uint slot) {
    return (sceneMaterials.items[place.material].params.textured & (1u << slot)) != 0u;
}

// halfTexel: of the level that is read. Clamps to texel centres, because the sampler repeats and would interpolate with
// the opposite edge.
float wrapCoordinate(float u, uint wrap, float halfTexel) {
    if (wrap == wrapRepeat) {
        return u;
    }
    u = wrap == wrapMirror ? 1.0 - abs(mod(u, 2.0) - 1.0) : u;
    return clamp(u, halfTexel, 1.0 - halfTexel);
}

// Only for slots with a texture.
vec4 readSceneTexture(ScenePlace place, uint slot) {
    uint m = place.material;
    SceneTexture t = sceneMaterials.items[m].textures[slot];
    bool second = (sceneMaterials.items[m].params.secondUv & (1u << slot)) != 0u;
    vec3 rowU = sceneMaterials.items[m].params.uvRows[2u * slot];
    vec3 rowV = sceneMaterials.items[m].params.uvRows[2u * slot + 1u];
    vec3 at = vec3(second ? place.uv1 : place.uv0, 1.0);
    vec2 uv = vec2(dot(rowU, at), dot(rowV, at));
    bool color = slot == slotBaseColor || (slot >= slotEmissive && slot <= slotSpecularColor);  // as isSrgb
    vec2 size = vec2(color ? textureSize(sceneColors, 0).xy : textureSize(sceneData, 0).xy);
    // Width of the isotropic footprint in texels of the finest level, from the texel density by area.
    float density = (second ? place.density.y : place.density.x) * sqrt(abs(determinant(mat2(rowU.xy, rowV.xy))));
    float texels = place.width * density * sqrt(size.x * size.y);
    float level = t.mips != 0u ? max(log2(max(texels, 1e-6)), t.firstLevel) : t.firstLevel;
    if (t.nearest != 0u && level <= t.firstLevel) {
        uv = (floor(uv * t.size) + 0.5) / t.size;
    }
    vec2 halfTexel = min(0.5 * exp2(ceil(level)) / size, vec2(0.5));
    vec3 place3 = vec3(wrapCoordinate(uv.x, t.wrapU, halfTexel.x), wrapCoordinate(uv.y, t.wrapV, halfTexel.y), t.layer);
    return color ? textureLod(sceneColors, place3, level) : textureLod(sceneData, place3, level);
}

vec4 sceneBaseColor(ScenePlace place) {
    vec4 color = place.weights.x * unpackVertexColor(sceneVertices.items[place.vertices.x].color) +
                 place.weights.y * unpackVertexColor(sceneVertices.items[place.vertices.y].color) +
                 place.weights.z * unpackVertexColor(sceneVertices.items[place.vertices.z].color);
    color *= sceneMaterials.items[place.material].params.baseColor;
    return hasSceneTexture(place, slotBaseColor) ? color * readSceneTexture(place, slotBaseColor) : color;
}

float sceneTransmission(ScenePlace place) {
    float share = sceneMaterials.items[place.material].params.transmission;
    return hasSceneTexture(place, slotTransmission) ? share * readSceneTexture(place, slotTransmission).r : share;
}

// From 0 to 1, differs for every ray and triangle.
float chanceOfHit(uint triangle, vec2 barycentrics, vec3 direction) {
    uvec3 bits = floatBitsToUint(vec3(barycentrics, direction.x));
    return hashToUnit(hashPcg(bits.x + hashPcg(bits.y + hashPcg(bits.z + hashPcg(triangle)))));
}

// Alpha test for the traversal. Rays pass glass straight, with the probability of what it lets through, unless they are
// parts of paths that it refracts. first: any hit will do, as for shadow rays, which always pass it straight.
const bool testEveryHit = false;
bool acceptHit(uint triangle, vec2 barycentrics, vec3 direction, bool first) {
    ScenePlace place = scenePlace(loadSceneTriangle(triangle), barycentrics);
    vec4 color = sceneBaseColor(place);
    float alpha = color.a;
    if (sceneMaterials.items[place.material].params.transmission > 0.0) {
        if (throughGlass != glassStraight && !first) {
            return alpha >= sceneMaterials.items[place.material].params.alphaCutoff;
        }
        float share =
            luminance(glassShare(sceneMaterials.items[place.material].params, sceneTransmission(place), color.rgb));
        share = sceneMaterials.items[place.material].params.blended != 0u ? mix(1.0, share, alpha) : share;
        return chanceOfHit(triangle, barycentrics, direction) >= share;
    }
    if (sceneMaterials.items[place.material].params.blended != 0u) {
        // Stochastic transparency (E. Enderton et al., 2010): the mean over many rays is the light through the surface.
        return chanceOfHit(triangle, barycentrics, direction) < alpha;
    }
    return alpha >= sceneMaterials.items[place.material].params.alphaCutoff;
}

struct SceneSurface {
    vec3 position;         // world space
    vec3 geometricNormal;  // unit, of the triangle, facing the ray's origin
    vec3 normal;           // unit, shading normal on the same side of the surface
    vec3 baseColor;        // linear
    float roughness;       // perceptual
    float metallic;
    vec4 reflectance;      // of the dielectric: F0 over dielectricF0, F90
    bool unlit;            // reflects nothing
    float occlusion;       // of the occlusion map, 1 open
    vec3 emissive;         // radiance; surfaces emit from their visible sides
    float clearance;       // offset of ray origins against self-intersection [m]
    bool emitter;          // lamps stand for what it emits
    bool hiddenBack;       // back of a single-sided surface, which is culled for the camera
    // Of transmissive materials:
    bool transmissive;
    float transmission;  // share of the light beneath the surface that passes it, 0: opaque
    vec3 passed;         // that, coloured
    float coverage;      // alpha where it is coverage, else 1
    bool bounded;        // the boundary of a volume, not a sheet
    bool front;          // seen from outside
    uint instance;
};

vec3 largestOf(vec3 a, vec3 b, vec3 c) { return max(abs(a), max(abs(b), abs(c))); }

vec3 sceneShadingNormal(SceneTriangle t, ScenePlace place, vec3 fallback) {
    SceneInstance instance = sceneInstances.items[t.instance];
    mat3 m = mat3(instance.axisX, instance.axisY, instance.axisZ);
    // As gbuffer.vert: cofactors instead of the inverse transpose.
    float handedness = (t.flags & triangleMirrored) != 0u ? -1.0 : 1.0;
    mat3 cofactors = handedness * mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    vec3 sum = place.weights.x * normalize(cofactors * sceneVertices.items[place.vertices.x].normal) +
               place.weights.y * normalize(cofactors * sceneVertices.items[place.vertices.y].normal) +
               place.weights.z * normalize(cofactors * sceneVertices.items[place.vertices.z].normal);
    float square = dot(sum, sum);
    vec3 n = square > 1e-30 ? sum * inversesqrt(square) : fallback;
    if (!hasSceneTexture(place, slotNormal)) {
        return n;
    }
    vec4 tangent = place.weights.x * sceneVertices.items[place.vertices.x].tangent +
                   place.weights.y * sceneVertices.items[place.vertices.y].tangent +
                   place.weights.z * sceneVertices.items[place.vertices.z].tangent;
    vec3 along = m * tangent.xyz;
    along -= n * dot(n, along);
    square = dot(along, along);
    if (!(square > 1e-30)) {
        return n;
    }
    vec3 tangentW = along * inversesqrt(square);
    vec3 bent = readSceneTexture(place, slotNormal).xyz * 2.0 - 1.0;
    bent.xy *= sceneMaterials.items[place.material].params.normalScale;
    return normalize(tangentW * bent.x + cross(n, tangentW) * (tangent.w * handedness * bent.y) + n * bent.z);
}

vec4 sceneReflectance(ScenePlace place) {
    vec3 color = sceneMaterials.items[place.material].params.f0;
    float weight = sceneMaterials.items[place.material].params.f90;
    if (hasSceneTexture(place, slotSpecular)) {
        weight *= readSceneTexture(place, slotSpecular).a;
    }
    if (hasSceneTexture(place, slotSpecularColor)) {
        color *= readSceneTexture(place, slotSpecularColor).rgb;
    }
    return reflectanceTexel(color, weight);
}

// direction: of the ray, unit. width: of the footprint across the ray [m]; 0: textures are read at the finest level.
SceneSurface sceneSurface(SceneHit hit, vec3 direction, float width) {
    SceneTriangle t = loadSceneTriangle(hit.triangle);
    ScenePlace place = scenePlace(t, hit.barycentrics);
    SceneSurface s;
    // From the corners, not along the ray, whose rounding error grows with its length.
    s.position = place.weights.x * t.a + place.weights.y * t.b + place.weights.z * t.c;
    vec3 largest = largestOf(t.a, t.b, t.c);
    s.clearance = relativeClearance * max(largest.x, max(largest.y, largest.z));
    vec3 front = normalize(triangleNormal(t));
    float facing = dot(front, direction);
    s.geometricNormal = facing <= 0.0 ? front : -front;
    s.hiddenBack = facing > 0.0 && (t.flags & triangleDoubleSided) == 0u;
    // The footprint on a slanted surface, by equal area.
    place.width = width * inversesqrt(max(abs(facing), 0.01));
    MaterialParams material = sceneMaterials.items[place.material].params;
    vec4 color = sceneBaseColor(place);
    s.baseColor = clamp(color.rgb, 0.0, 1.0);
    vec3 shading = sceneShadingNormal(t, place, front);
    s.normal = consistentNormal(facing <= 0.0 ? shading : -shading, s.geometricNormal, -direction);
    s.roughness = material.roughness;
    s.metallic = material.metallic;
    if (hasSceneTexture(place, slotMetallicRoughness)) {
        vec2 texel = readSceneTexture(place, slotMetallicRoughness).gb;
        s.roughness *= texel.x;
        s.metallic *= texel.y;
    }
    s.transmissive = material.transmission > 0.0;
    s.transmission = sceneTransmission(place) * (1.0 - s.metallic);
    s.passed = s.baseColor * s.transmission;
    s.coverage = material.blended != 0u ? clamp(color.a, 0.0, 1.0) : 1.0;
    s.bounded = material.thickness > 0.0;
    s.front = facing <= 0.0;
    s.instance = t.instance;
    s.baseColor *= 1.0 - s.transmission;
    s.occlusion = 1.0;
    if (hasSceneTexture(place, slotOcclusion)) {
        s.occlusion += material.occlusionStrength * (readSceneTexture(place, slotOcclusion).r - 1.0);
    }
    s.emissive = s.hiddenBack ? vec3(0.0) : material.emissive;
    if (s.emissive != vec3(0.0) && hasSceneTexture(place, slotEmissive)) {
        s.emissive *= readSceneTexture(place, slotEmissive).rgb;
    }
    s.emitter = material.emitter != 0u;
    s.reflectance = mayReflectUnusually() ? sceneReflectance(place) : vec4(1.0);
    s.unlit = mayBeUnlit() && material.unlit != 0u;
    if (s.unlit) {
        s.emissive = s.hiddenBack ? vec3(0.0) : s.baseColor;
    }
    return s;
}

#endif
