// Marches rays through depth that is worked out, not drawn: at each pixel's centre, the nearest wall there.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "march_test.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform ParamsBlock { MarchScene params; };
layout(set = 0, binding = 1, scalar) readonly buffer InputBlock { MarchRay items[]; } inputs;
layout(set = 0, binding = 2, scalar) buffer OutputBlock { MarchAnswer items[]; } outputs;

// Along a pixel, world points are a + depth · b in homogeneous coordinates.
float loadDepth(ivec2 pixel) {
    vec2 uv = (vec2(pixel) + 0.5) * params.view.pixel;
    vec4 a = params.view.clipToWorld * vec4(2.0 * uv - 1.0, 0.0, 1.0);
    vec4 b = params.view.clipToWorld[2];
    float nearest = 0.0;
    for (uint i = 0u; i < params.wallCount; ++i) {
        MarchWall wall = params.walls[i];
        float depth = -dot(wall.plane, a) / dot(wall.plane, b);
        bool inside = all(greaterThanEqual(uv, wall.firstUv)) && all(lessThan(uv, wall.lastUv));
        if (inside && depth > nearest && depth <= 1.0) {
            nearest = depth;
        }
    }
    return nearest;
}
#include "shaders/march.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= outputs.items.length()) {
        return;
    }
    MarchRay ray = inputs.items[i];
    MarchView view = MarchView(params.view.worldToClip, params.view.viewPlane, params.view.depthToDistance,
                               params.view.size);
    vec4 ownPlane = ray.normal == vec3(0.0) ? vec4(0.0, 0.0, 0.0, 1.0)  // all is far above it
                                            : planeOnScreen(ray.origin, ray.normal, params.view.clipToWorld);
    MarchResult r = marchLinear(ray.origin, ray.direction, ray.stepLength, ray.maxSteps, ray.thickness, ray.jitter,
                                ownPlane, view);
    outputs.items[i] = MarchAnswer(r.outcome, r.pixel.x, r.pixel.y, r.distance, r.steps);
}
