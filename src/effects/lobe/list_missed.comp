// Lists waiting rays for a host that answers them by its own means (missed_rays.h).
// In: depth, geometric normal and material of the rays' origins, ray directions, the list. Out: rays, and answers of
// zero, so that a ray that the host leaves alone is not answered.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer.glsl"
#include "effects/lobe/missed_rays.h"
#include "effects/lobe/rays.glsl"
#include "shaders/clearance.glsl"

layout(constant_id = 0) const uint lobe = 0u;

layout(local_size_x = 64) in;
layout(scalar) uniform ParamsBlock { ListMissedParams params; };
uniform sampler2D ownDepth;
uniform usampler2D ownGeometricNormal;
uniform sampler2D ownMaterial;
#include "effects/lobe/ray_origin.glsl"
layout(rg32ui) uniform readonly uimage2DArray direction;
#include "effects/lobe/rays_waiting.glsl"
layout(scalar) writeonly buffer RaysBlock {
    uint groups[3];
    uint count;
    MissedRay items[];
} rays;
layout(scalar) writeonly buffer AnswersBlock { HostAnswer items[]; } answers;

MissedRay missedRay(WaitingRay w) {
    Ray ray = unpackRay(imageLoad(direction, w.slot).xy);
    float d = texelFetch(ownDepth, w.slot.xy, 0).r;
    vec3 p = rayOrigin(w.slot, d, params.own);
    vec3 n = unpackUnitVector(texelFetch(ownGeometricNormal, w.slot.xy, 0).r);
    float away = depthToViewDistance(d, params.own.depthToDistance);
    float width = params.own.pixelAngle * (params.own.eye.w > 0.0 ? away : 1.0);
    MaterialTexel m = unpackMaterial(texelFetch(ownMaterial, w.slot.xy, 0));
    uvec2 pixel = uvec2(w.slot.xy) * params.scale + params.blockOffset;
    return MissedRay(p + n * clearanceOfPixel(p, away, params.own.depthToDistance, width), w.clear, ray.direction,
                     w.rest, pixel.x | (pixel.y << 16u), lobe | (uint(w.slot.z) << 16u), ray.spread, m.roughness);
}

void main() {
    uint stride = gl_NumWorkGroups.x * listGroupSize;
    for (uint i = gl_GlobalInvocationID.x; i < waiting.count; i += stride) {
        rays.items[i] = missedRay(unpackWaitingRay(waiting.items[i]));
        answers.items[i] = HostAnswer(vec3(0.0), 0.0, 0.0, 0u, 0u, 0u);
    }
    if (gl_GlobalInvocationID.x == 0u) {
        rays.groups[0] = waiting.groups[0];
        rays.count = waiting.count;
    }
}
