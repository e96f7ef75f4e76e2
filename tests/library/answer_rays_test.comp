// A host's source of rays: what lies behind the camera of the room and above it, as planes (missed_rays_host.h).
#version 460
#extension GL_EXT_scalar_block_layout : require

struct MissedRay {
    vec3 origin;
    float clear;
    vec3 direction;
    float rest;
    uint pixel;
    uint number;
    float spread;
    float roughness;
};
struct RayAnswer {
    vec3 radiance;
    float confidence;
    float distance;
    uint reserved[3];
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer RaysBlock {
    uint groups[3];
    uint count;
    MissedRay items[];
} rays;
layout(set = 0, binding = 1, scalar) writeonly buffer AnswersBlock { RayAnswer items[]; } answers;
layout(push_constant, scalar) uniform Pushed {
    vec4 wall;     // radiance of the plane z = wall.w
    vec4 ceiling;  // radiance of the plane y = ceiling.w
    float confidence;
    float missDistance;  // told of rays that hit neither
    float tells;         // 1: instead of radiance: x and y of the pixel; number in the pixel, lobe / 2 and roughness / 4
} pushed;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rays.count) {
        return;
    }
    MissedRay ray = rays.items[i];
    float toWall = ray.direction.z > 0.0 ? (pushed.wall.w - ray.origin.z) / ray.direction.z : 1e9;
    float toCeiling = ray.direction.y > 0.0 ? (pushed.ceiling.w - ray.origin.y) / ray.direction.y : 1e9;
    float nearest = min(toWall, toCeiling);
    bool hits = nearest < 1e9;
    vec3 radiance = toWall < toCeiling ? pushed.wall.rgb : pushed.ceiling.rgb;
    float own = float(ray.number >> 16u) + 0.5 * float(ray.number & 0xffffu) + 0.25 * ray.roughness;
    radiance = mix(radiance, vec3(ray.pixel & 0xffffu, ray.pixel >> 16u, own), pushed.tells);
    answers.items[i] = RayAnswer(radiance, hits ? pushed.confidence : 0.0, hits ? nearest : pushed.missDistance,
                                 uint[3](0u, 0u, 0u));
}
