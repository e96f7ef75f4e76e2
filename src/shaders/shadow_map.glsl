// Looking up an orthographic shadow map with reversed depth (1 nearest to the sun).
// The includer defines, before it includes this: float loadShadowDepth(ivec2 texel).
#ifndef REFLET_SHADOW_MAP_GLSL
#define REFLET_SHADOW_MAP_GLSL

#include "render/shadow/shadow.h"

const float lookupOffset = 0.75;  // texels: a texel's centre is at most 0.71 from its corner

bool outsideMap(ivec2 texel, ivec2 size) {
    return any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size));
}

// 1: lit. A hard edge, exact to the texel: the map holds depth at texel centres, so the surface is followed along its
// own plane from the point to the centre and compared there. What is left for the bias (texels along the normal) is
// curvature, creases and rounding.
float hardVisibility(vec3 p, vec3 normal, ShadowMapParams map, ivec2 size, float bias) {
    float facing = dot(normal, map.toSun);
    if (facing <= 0.0) {
        return 0.0;  // the surface is in its own shadow
    }
    // Looked up a part of a texel to the side that the surface faces: past the edge of a wall, the centre of the texel
    // may see what the wall itself does not, and light would leak in along the edge.
    vec3 s = (map.worldToShadow * vec4(p, 1.0)).xyz;
    vec3 sideways = normal - facing * map.toSun;
    float across = length(sideways);
    vec3 lookup = p + sideways * (across > 1e-3 ? lookupOffset * map.texelSize / across : 0.0);
    vec2 at = (0.5 + 0.5 * (map.worldToShadow * vec4(lookup, 1.0)).xy) * vec2(size);
    ivec2 texel = ivec2(floor(at));
    if (outsideMap(texel, size)) {
        return 1.0;  // nothing that the map knows of casts here
    }
    // The normal in shadow space's own axes: depth changes by -n.xy / n.z for each step along x and y.
    vec3 axisX = vec3(map.worldToShadow[0].x, map.worldToShadow[1].x, map.worldToShadow[2].x);
    vec3 axisY = vec3(map.worldToShadow[0].y, map.worldToShadow[1].y, map.worldToShadow[2].y);
    vec2 slope = -vec2(dot(normal, axisX) / dot(axisX, axisX), dot(normal, axisY) / dot(axisY, axisY)) /
                 max(facing, 0.05);
    vec2 toCentre = (2.0 * (vec2(texel) + 0.5) / vec2(size) - 1.0) - s.xy;
    float metres = dot(slope, toCentre) + bias * map.texelSize / max(facing, 0.05);
    float surface = s.z + metres / map.depthRange;
    return loadShadowDepth(texel) > surface ? 0.0 : 1.0;
}

// 1: lit. The depth of the texel that the point lies in, compared with the point's own, moved `bias` metres toward the
// sun (Williams, Casting curved shadows on curved surfaces, 1978). A surface whose depth changes by more than that from
// the texel's centre to its corner shadows itself; casters that are nearer than that to what they shadow are missed.
float constantBiasVisibility(vec3 p, ShadowMapParams map, ivec2 size, float bias) {
    vec3 s = (map.worldToShadow * vec4(p, 1.0)).xyz;
    ivec2 texel = ivec2(floor((0.5 + 0.5 * s.xy) * vec2(size)));
    if (outsideMap(texel, size)) {
        return 1.0;
    }
    return loadShadowDepth(texel) > s.z + bias / map.depthRange ? 0.0 : 1.0;
}

#endif
