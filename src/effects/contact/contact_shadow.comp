// Contact shadows: a short march through the depth buffer toward a light. In: depth and its pyramid, geometric normal,
// the light's visibility by the shadow map. Out: the minimum of that and the march's result.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/contact/contact.h"
#include "shaders/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ContactParams params; };
uniform sampler2D depth;
uniform usampler2D geometricNormal;
layout(rg32f) uniform readonly image2D pyramid;
#include "effects/pyramid/pyramid.glsl"
uniform sampler2D byMap;
layout(r8) uniform writeonly image2D visibility;

float loadDepth(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
float loadBackDepth(ivec2 pixel) { return 0.0; }  // no second layer: thickness by the setting
vec2 loadCell(ivec2 cell, int level) { return pyramidCell(cell, level, params.view.size); }
#include "shaders/march_hiz.glsl"

vec3 normalAt(ivec2 pixel) { return unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r); }
vec3 positionAt(ivec2 pixel) {
    return uvToWorld(pixelToUv(pixel, params.view.pixel), loadDepth(pixel), params.view.clipToWorld);
}

// Whether the hit pixel's surface plane crosses the ray between p and its end. A depth sample covers a pixel's whole
// width: without this test, a lit wall would darken the ground at its foot.
bool isBetween(ivec2 pixel, vec3 p, vec3 toLight, float most) {
    vec3 n = normalAt(pixel);
    float t = dot(n, positionAt(pixel) - p) / dot(n, toLight);
    return t > 0.0 && t <= most;
}

// A ray that passes behind a thicker surface or leaves the screen counts as unoccluded.
bool findsCaster(ivec2 pixel) {
    vec3 n = normalAt(pixel);
    vec3 p = positionAt(pixel);
    vec3 toLight = params.light.xyz - params.light.w * p;
    float away = length(toLight);  // of a direction: 1
    toLight /= max(away, 1e-9);
    if (dot(n, toLight) <= 0.0) {
        return false;  // faces away from the light: dark anyway
    }
    ContactSettings s = params.settings;
    float most = min(s.distance, mix(s.distance, away, params.light.w));
    MarchView view = MarchView(params.view.worldToClip, params.view.clipToWorld, params.view.viewPlane,
                               params.view.depthToDistance, params.view.size, params.view.pixel);
    MarchRay ray = makeMarchRay(p, toLight, planeOnScreen(p, n, params.view.clipToWorld), view);
    MarchOptions o;  // marchHiz uses only these
    o.maxDistance = most;
    o.maxSteps = s.maxSteps;
    o.thickness = s.thickness;
    o.secondLayer = false;
    o.levels = int(pyramidLevels);
    o.firstSteps = 2u;
    MarchResult hit = marchHiz(ray, o, view);
    bool blocked = hit.outcome == marchHit || hit.outcome == marchOccluded;  // in front of it or out of sight
    return blocked && isBetween(hit.pixel, p, toLight, most);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float lit = texelFetch(byMap, pixel, 0).r;
    bool search = loadDepth(pixel) > 0.0 && lit > 0.0;
    imageStore(visibility, pixel, vec4(search && findsCaster(pixel) ? 0.0 : lit));
}
