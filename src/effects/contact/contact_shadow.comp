// Contact shadows: a short march through the depth buffer toward the sun. In: depth and its pyramid, geometric normal,
// sun visibility by the shadow map. Out: the minimum of that and the march's result.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/contact/contact.h"
#include "effects/levels.glsl"
#include "effects/pyramid/pyramid.h"
#include "shaders/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ContactParams params; };
uniform sampler2D depth;
uniform usampler2D geometricNormal;
layout(rg32f) uniform readonly image2D pyramid;
uniform sampler2D sunVisibility;
layout(r8) uniform writeonly image2D visibility;

float loadDepth(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
float loadBackDepth(ivec2 pixel) { return 0.0; }  // no second layer: thickness by the setting
vec2 loadCell(ivec2 cell, int level) {
    return imageLoad(pyramid, cell + ivec2(0, levelRow(ivec2(params.view.size), level))).rg;
}
#include "shaders/march_hiz.glsl"

vec3 normalAt(ivec2 pixel) { return unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r); }
vec3 positionAt(ivec2 pixel) {
    return uvToWorld(pixelToUv(pixel, params.view.pixel), loadDepth(pixel), params.view.clipToWorld);
}

// Whether the hit pixel's surface plane crosses the ray between p and its end. A depth sample covers a pixel's whole
// width: without this test, a sunlit wall would darken the ground at its foot.
bool isBetween(ivec2 pixel, vec3 p) {
    vec3 n = normalAt(pixel);
    float t = dot(n, positionAt(pixel) - p) / dot(n, params.toSun);
    return t > 0.0 && t <= params.settings.distance;
}

// A ray that passes behind a thicker surface or leaves the screen counts as unoccluded.
bool findsCaster(ivec2 pixel) {
    vec3 n = normalAt(pixel);
    if (dot(n, params.toSun) <= 0.0) {
        return false;  // faces away from the sun: dark anyway
    }
    vec3 p = positionAt(pixel);
    ContactSettings s = params.settings;
    MarchView view = MarchView(params.view.worldToClip, params.view.clipToWorld, params.view.viewPlane,
                               params.view.depthToDistance, params.view.size, params.view.pixel);
    MarchRay ray = makeMarchRay(p, params.toSun, planeOnScreen(p, n, params.view.clipToWorld), view);
    MarchOptions o;  // marchHiz uses only these
    o.maxDistance = s.distance;
    o.maxSteps = s.maxSteps;
    o.thickness = s.thickness;
    o.secondLayer = false;
    o.levels = int(pyramidLevels);
    o.firstSteps = 2u;
    MarchResult hit = marchHiz(ray, o, view);
    return hit.outcome == marchHit && isBetween(hit.pixel, p);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float byMap = texelFetch(sunVisibility, pixel, 0).r;
    bool search = loadDepth(pixel) > 0.0 && byMap > 0.0;
    imageStore(visibility, pixel, vec4(search && findsCaster(pixel) ? 0.0 : byMap));
}
