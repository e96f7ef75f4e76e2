// The host's own ray tracing: rays that the screen does not answer, against the room's boxes. A wall behind the camera, which
// nothing on screen shows, is there as well.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "room.glsl"

// RefletMissedRay and RefletRayAnswer.
struct MissedRay { vec3 origin; float clear; vec3 direction; float rest; uint pixel, number; float spread, roughness; };
struct RayAnswer { vec3 radiance; float confidence, distance; uint reserved[3]; };

layout(local_size_x = 64) in;
layout(set = 1, binding = 0, scalar) readonly buffer Rays { uint groups[3]; uint count; MissedRay rays[]; };
layout(set = 1, binding = 1, scalar) writeonly buffer Answers { RayAnswer answers[]; };

const Box hidden = Box(vec3(0.0, 1.5, 8.0), vec3(3.2, 1.7, 0.1), vec3(0.9, 0.8, 0.3), 0.0, 0.1);  // yellow, behind the camera

Box box_of(int i) {
    if (i == box_count) return hidden;
    return boxes[i];
}

// Distance to the nearest box along the ray, and which; 1e9: none.
float nearest(vec3 from, vec3 along, out int hit) {
    float best = 1e9;
    hit = -1;
    for (int i = 0; i <= box_count; ++i) {
        Box box = box_of(i);
        vec3 inverse = 1.0 / along;
        vec3 a = (box.center - box.half_size - from) * inverse;
        vec3 b = (box.center + box.half_size - from) * inverse;
        vec3 low = min(a, b), high = max(a, b);
        float enter = max(max(low.x, low.y), low.z), leave = min(min(high.x, high.y), high.z);
        if (enter > 1e-3 && enter < leave && enter < best) {
            best = enter;
            hit = i;
        }
    }
    return best;
}

RayAnswer trace(MissedRay ray) {
    int hit;
    float distance = nearest(ray.origin, ray.direction, hit);
    if (hit < 0) return RayAnswer(vec3(0.0), 0.0, -1.0, uint[3](0u, 0u, 0u));  // the sky: Reflet's environment
    Box box = box_of(hit);
    vec3 p = ray.origin + distance * ray.direction;
    vec3 face = abs((p - box.center) / box.half_size);
    vec3 n = vec3(greaterThanEqual(face, vec3(max(max(face.x, face.y), face.z)))) * -sign(ray.direction);
    int blocker;
    float facing = max(dot(n, camera.to_sun.xyz), 0.0);
    bool lit = facing > 0.0 && nearest(p + 1e-3 * n, camera.to_sun.xyz, blocker) > 1e8;
    vec3 color = box.color * (1.0 - 0.5 * box.metallic);
    // Direct sun, and the sky for what bounces.
    vec3 radiance = color / 3.14159265 * (lit ? facing : 0.0) * vec3(3.2, 3.0, 2.7) + 0.8 * color * camera.sky.rgb;
    return RayAnswer(radiance, 1.0, distance, uint[3](0u, 0u, 0u));
}

void main() {
    for (uint i = gl_GlobalInvocationID.x; i < count; i += 64u * gl_NumWorkGroups.x) answers[i] = trace(rays[i]);
}
