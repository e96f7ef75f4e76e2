// Vertices of the room for the G-buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "room.glsl"

layout(location = 0) out vec3 normal;
layout(location = 1) out vec4 clip_now;
layout(location = 2) out vec4 clip_before;
layout(location = 3) out flat int box;

void main() {
    vec3 position;
    corner(gl_InstanceIndex, gl_VertexIndex, position, normal);
    gl_Position = camera.world_to_clip * vec4(position, 1.0);
    clip_now = camera.world_to_clip_plain * vec4(position, 1.0);
    clip_before = camera.previous_world_to_clip * vec4(position, 1.0);
    box = gl_InstanceIndex;
}
