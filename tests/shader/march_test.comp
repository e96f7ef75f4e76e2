// Marches rays through analytic depth: at each pixel's centre, the nearest wall there.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "march_test.h"

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { MarchScene params; };
layout(scalar) readonly buffer InputBlock { MarchInput items[]; } inputs;
layout(scalar) buffer OutputBlock { MarchAnswer items[]; } outputs;

layout(constant_id = 1) const uint secondLayer = 0u;

vec2 uvOf(ivec2 pixel) { return (vec2(pixel) + 0.5) * params.view.pixel; }

// Along a pixel, world points are a + depth · b in homogeneous coordinates.
float depthOf(vec4 plane, vec2 uv) {
    vec4 a = params.view.clipToWorld * vec4(2.0 * uv - 1.0, 0.0, 1.0);
    vec4 b = params.view.clipToWorld[2];
    return -dot(plane, a) / dot(plane, b);
}

// The number of the wall that the pixel shows, and its depth; 0 where there is none.
uint nearestWall(ivec2 pixel, out float nearest) {
    vec2 uv = uvOf(pixel);
    uint number = 0u;
    nearest = 0.0;
    for (uint i = 0u; i < params.wallCount; ++i) {
        MarchWall wall = params.walls[i];
        float depth = depthOf(wall.plane, uv);
        bool inside = all(greaterThanEqual(uv, wall.firstUv)) && all(lessThan(uv, wall.lastUv));
        if (inside && depth > nearest && depth <= 1.0) {
            nearest = depth;
            number = i;
        }
    }
    return number;
}

float loadDepth(ivec2 pixel) {
    float depth;
    nearestWall(pixel, depth);
    return depth;
}

float loadBackDepth(ivec2 pixel) {
    float depth;
    vec4 plane = params.walls[nearestWall(pixel, depth)].backPlane;
    return depth > 0.0 && plane != vec4(0.0) ? depthOf(plane, uvOf(pixel)) : 0.0;
}

// By looking at all of the cell's pixels.
vec2 loadCell(ivec2 cell, int level) {
    if (level == 0) {
        return vec2(loadDepth(cell), loadBackDepth(cell));
    }
    ivec2 first = cell << level;
    ivec2 last = min((cell + 1) << level, ivec2(params.view.size));
    vec2 extremes = vec2(0.0, 1.0);
    bool sky = false;
    for (int y = first.y; y < last.y; ++y) {
        for (int x = first.x; x < last.x; ++x) {
            float depth = loadDepth(ivec2(x, y));
            if (depth > 0.0) {
                float back = secondLayer != 0u ? loadBackDepth(ivec2(x, y)) : 0.0;
                extremes = vec2(max(extremes.x, depth), min(extremes.y, back > 0.0 ? back : depth));
            }
            sky = sky || depth <= 0.0;
        }
    }
    return vec2(extremes.x, sky ? -extremes.y : extremes.y);
}
#include "shaders/march_hiz.glsl"
#include "shaders/march_world.glsl"

layout(constant_id = 0) const uint method = 0u;

MarchResult march(MarchInput i, MarchRay ray, MarchView view) {
    MarchOptions o = MarchOptions(i.stepLength, i.smallest, i.stepLength, marchLongest, i.jitter, i.maxSteps,
                                  i.thickness, i.thickAsStep != 0u, secondLayer != 0u, i.binarySteps,
                                  i.interpolate != 0u, marchLevels, 0u);
    switch (method) {
        case marchMethodHalving:
            return marchHalving(ray, o, view);
        case marchMethodFixedPoint:
            return marchFixedPoint(ray, o, view);
        case marchMethodDda:
            return marchDda(ray, o, view);
        case marchMethodExhaustive:
            return marchExhaustive(ray, o, view);
        case marchMethodHiz:
            return marchHiz(ray, o, view);
        default:
            return marchLinear(ray, o, view);
    }
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    MarchInput given = inputs.items[i];
    MarchView view = MarchView(params.view.worldToClip, params.view.clipToWorld, params.view.viewPlane,
                               params.view.depthToDistance, params.view.size, params.view.pixel);
    vec4 ownPlane = given.normal == vec3(0.0) ? vec4(0.0, 0.0, 0.0, 1.0)  // all is far above it
                                              : planeOnScreen(given.origin, given.normal, params.view.clipToWorld);
    MarchResult r = march(given, makeMarchRay(given.origin, given.direction, ownPlane, view), view);
    outputs.items[i] = MarchAnswer(r.outcome, r.pixel.x, r.pixel.y, r.distance, r.clear, r.occluded ? 1u : 0u, r.steps);
}
