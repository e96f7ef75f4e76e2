// The host's own ray tracing: one diffuse ray per pixel against the room's boxes. Out: radiance along it, and how far it went.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "room.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 1) uniform sampler2D depth;
layout(set = 0, binding = 2) uniform sampler2D normal_smoothness;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D noisy;
layout(push_constant) uniform Push { uint frame; } push;

uint hash(uint v) {
    v = v * 747796405u + 2891336453u;
    v = ((v >> ((v >> 28u) + 4u)) ^ v) * 277803737u;
    return (v >> 22u) ^ v;
}

float random(inout uint state) {
    state = hash(state);
    return float(state >> 8u) / 16777216.0;
}

// Distance to the nearest box along the ray, and which; 1e9: none.
float nearest(vec3 from, vec3 along, out int hit) {
    float best = 1e9;
    hit = -1;
    for (int i = 0; i < box_count; ++i) {
        vec3 inverse = 1.0 / along;
        vec3 a = (boxes[i].center - boxes[i].half_size - from) * inverse;
        vec3 b = (boxes[i].center + boxes[i].half_size - from) * inverse;
        vec3 low = min(a, b), high = max(a, b);
        float enter = max(max(low.x, low.y), low.z), leave = min(min(high.x, high.y), high.z);
        if (enter > 1e-4 && enter < leave && enter < best) {
            best = enter;
            hit = i;
        }
    }
    return best;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(noisy);
    if (any(greaterThanEqual(pixel, size))) return;
    float d = texelFetch(depth, pixel, 0).r;
    if (d >= 1.0) {
        imageStore(noisy, pixel, vec4(0.0));
        return;
    }
    vec4 p = inverse(camera.world_to_clip) * vec4(2.0 * (vec2(pixel) + 0.5) / vec2(size) - 1.0, d, 1.0);
    vec3 n = texelFetch(normal_smoothness, pixel, 0).xyz * mat3(camera.world_to_view);
    vec3 from = p.xyz / p.w + 1e-3 * n;
    uint state = uint(pixel.x) + 16384u * uint(pixel.y) + 268435456u * push.frame;
    state = hash(state) + push.frame;
    float z = 2.0 * random(state) - 1.0, turn = 6.2831853 * random(state);
    vec3 along = normalize(n + vec3(sqrt(1.0 - z * z) * vec2(cos(turn), sin(turn)), z));  // cosine-weighted
    int hit;
    float distance = nearest(from, along, hit);
    vec3 radiance = camera.sky.rgb;
    if (hit >= 0) {
        vec3 face = abs((from + distance * along - boxes[hit].center) / boxes[hit].half_size);
        vec3 there = vec3(greaterThanEqual(face, vec3(max(max(face.x, face.y), face.z)))) * -sign(along);
        int blocker;
        vec3 lit_from = from + distance * along + 1e-3 * there;
        bool sun = dot(there, camera.to_sun.xyz) > 0.0 && nearest(lit_from, camera.to_sun.xyz, blocker) > 1e8;
        radiance = boxes[hit].color / 3.14159265 * (sun ? dot(there, camera.to_sun.xyz) * vec3(3.2, 3.0, 2.7) : vec3(0.0)) +
                   0.3 * boxes[hit].color * camera.sky.rgb;
    }
    imageStore(noisy, pixel, vec4(radiance, min(distance, 100.0)));
}
