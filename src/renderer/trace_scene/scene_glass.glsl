// Glass on a path through the scene: refraction and reflection at its boundaries, absorption between them, also in
// volumes inside one another. The model is the reference's (reference/glass.h); rays through rough boundaries: B. Walter
// et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007. Include after scene_light.glsl.
#ifndef REFLET_SCENE_GLASS_GLSL
#define REFLET_SCENE_GLASS_GLSL

#include "shaders/refraction.glsl"

const uint noInstance = 0xFFFFFFFFu;
const uint allChannels = 3u;

// The volumes that a path is in.
struct Media {
    uvec4 instances;  // the innermost first, then noInstance; of more than four the outermost is forgotten
    uint channel;     // red, green or blue: the one that is left after glass that disperses light; or allChannels
    uint chosen;      // the one that such glass will leave
};

// chosen: uniform over the frames of a pixel, each in turn, which has less noise than chance.
Media noMedia(uint chosen) { return Media(uvec4(noInstance), allChannels, chosen); }

Media entered(Media m, uint instance) { return Media(uvec4(instance, m.instances.xyz), m.channel, m.chosen); }

Media left(Media m, uint instance) {
    uvec4 outer = uvec4(m.instances.yzw, noInstance);
    bvec4 here = equal(m.instances, uvec4(instance));
    uvec4 rest = here.x   ? outer
                 : here.y ? uvec4(m.instances.x, outer.yzw)
                 : here.z ? uvec4(m.instances.xy, outer.zw)
                 : here.w ? uvec4(m.instances.xyz, noInstance)
                          : m.instances;
    return Media(rest, m.channel, m.chosen);
}

float dispersionOf(uint instance) {
    uint glass = sceneMaterials.items[sceneInstances.items[instance].material].params.glass;
    return float(glass >> glassKindBits) / glassDispersionSteps;
}

float indexOf(uint instance, uint channel) {
    float ior = max(sceneMaterials.items[sceneInstances.items[instance].material].params.ior, 1.0);
    return channel == allChannels ? ior : dispersedIndex(ior, dispersionOf(instance), float(channel) - 1.0);
}

float indexInside(Media m) { return m.instances.x == noInstance ? 1.0 : indexOf(m.instances.x, m.channel); }

// distance: metres inside.
vec3 transmittance(Media m, float distance) {
    if (m.instances.x == noInstance) {
        return vec3(1.0);
    }
    return exp(-sceneMaterials.items[sceneInstances.items[m.instances.x].material].params.extinction * distance);
}

const uint boundarySheet = 0u;  // of no volume: light passes straight
const uint boundaryOuter = 1u;  // of glass in air, from outside: the surface's own lobe reflects
const uint boundaryInner = 2u;  // from inside: what is not refracted stays inside
const uint boundaryNone = 3u;   // hidden in a volume that was entered later

struct Boundary {
    uint kind;
    float near;  // index of refraction on the path's side
    float far;
};

Boundary boundaryAt(Media m, SceneSurface s) {
    float own = indexOf(s.instance, m.channel);
    if (!s.bounded) {
        return Boundary(boundarySheet, 1.0, own);
    }
    if (s.front) {
        return Boundary(m.instances.x == noInstance ? boundaryOuter : boundaryInner, indexInside(m), own);
    }
    bool known = any(equal(m.instances, uvec4(s.instance)));
    if (known && m.instances.x != s.instance) {
        return Boundary(boundaryNone, 1.0, 1.0);
    }
    // A path that starts inside, or came through a hole of the mesh, has not entered the volume.
    return Boundary(boundaryInner, known ? indexInside(m) : own, indexInside(left(m, s.instance)));
}

float normalReflectance(float ratio) {
    float root = (ratio - 1.0) / (ratio + 1.0);
    return root * root;
}

// What a facet of an inner boundary reflects. cosine: between the path and the facet's normal.
float innerReflectance(SceneSurface s, Boundary b, float cosine) {
    float ratio = b.far / b.near;
    float outside = cosine;
    if (ratio < 1.0) {  // Schlick's angle is the one on the side of the smaller index
        float rest = 1.0 - (1.0 - cosine * cosine) / (ratio * ratio);
        if (rest <= 0.0) {
            return 1.0;
        }
        outside = sqrt(rest);
    }
    float plain = normalReflectance(ratio);
    float inAir = normalReflectance(indexOf(s.instance, allChannels));
    vec3 f0 = dielectricF0 * s.reflectance.rgb;
    float strength = inAir > 1e-6 ? max(f0.r, max(f0.g, f0.b)) / inAir : 1.0;
    return fresnelSchlick(vec3(min(plain * strength, 1.0)), min(50.0 * plain, 1.0) * min(strength, 1.0), outside).r;
}

// What the boundary sends on, times the path's throughput.
struct GlassShares {
    vec3 transmitted;
    float reflected;  // inside, by the facets' reflectance
};

// surface: of the same point, loses the lobe that the boundary's takes the place of.
GlassShares glassShares(Media m, SceneSurface s, float nv, inout Surface surface) {
    uint kind = boundaryAt(m, s).kind;
    if (kind == boundaryInner || kind == boundaryNone) {
        surface.specular *= 1.0 - s.transmission;
        surface.f0 *= 1.0 - s.transmission;
        surface.f90 *= 1.0 - s.transmission;
        return kind == boundaryNone ? GlassShares(vec3(s.transmission), 0.0) : GlassShares(s.passed, s.transmission);
    }
    vec4 dielectric = vec4(dielectricF0 * s.reflectance.rgb, s.reflectance.a);
    vec2 table = textureLod(ggxTable, ggxTableUv(nv, s.roughness), 0.0).rg;
    return GlassShares(s.passed * makeSurface(vec3(1.0), 0.0, s.roughness, dielectric, table, false).diffuse, 0.0);
}

// Leaves one channel of the path's light, with three times the weight, where the glass disperses it.
vec3 disperse(SceneSurface s, inout Media m) {
    if (!s.bounded || m.channel != allChannels || dispersionOf(s.instance) == 0.0) {
        return vec3(1.0);
    }
    m.channel = m.chosen;
    return 3.0 * vec3(equal(uvec3(m.channel), uvec3(0u, 1u, 2u)));
}

// Takes the path through the boundary, or reflects it on its own side. Returns the factor on its throughput.
vec3 passGlass(LitPoint at, SceneSurface s, GlassShares shares, inout Media media, inout uint random, inout SceneRay ray) {
    vec3 weight = disperse(s, media);
    Boundary b = boundaryAt(media, s);
    bool refracts = b.kind == boundaryOuter || b.kind == boundaryInner;
    bool straight = b.kind == boundaryNone || (refracts && abs(b.far / b.near - 1.0) < 1e-3);
    bool smooth_ = straight || s.roughness <= mirrorRoughness;
    mat3 frame = basisAround(at.normal);
    vec3 v = at.toViewer * frame;
    v = normalize(vec3(v.xy, max(v.z, 1e-3)));
    vec2 u = nextRandom2(random);
    vec3 h = smooth_ ? vec3(0.0, 0.0, 1.0) : sampleGgxVisible(u, v, s.roughness * s.roughness);
    vec3 mirrored = 2.0 * dot(v, h) * h - v;
    bool reflects = b.kind == boundaryInner && nextRandom(random) < innerReflectance(s, b, dot(v, h));
    vec3 l = mirrored;
    if (!reflects && straight) {
        l = -v;
    } else if (!reflects && b.kind == boundarySheet) {
        l.z = -l.z;
    } else if (!reflects) {
        vec3 bent;
        l = refractAt(-v, -h, b.near / b.far, bent) ? bent : mirrored;
    }
    l.z = (l.z > 0.0) == reflects ? l.z : -l.z;
    // Shading normals may put the direction on the wrong side of the triangle, which then mirrors it.
    vec3 towards = frame * l;
    float side = dot(towards, at.geometricNormal);
    towards -= (side > 0.0) == reflects ? vec3(0.0) : 2.0 * side * at.geometricNormal;
    if (!reflects && s.bounded) {
        media = s.front ? entered(media, s.instance) : left(media, s.instance);
    }
    ray.origin = at.position + at.geometricNormal * (reflects ? at.clearance : -at.clearance);
    ray.direction = towards;
    ray.roughness = max(ray.roughness, smooth_ ? 0.0 : s.roughness);
    return weight * (reflects ? vec3(shares.reflected) : shares.transmitted);
}

#endif
