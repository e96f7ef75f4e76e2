// Vertices of the room for the sun's shadow map.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "room.glsl"

void main() {
    vec3 position, normal;
    corner(gl_InstanceIndex, gl_VertexIndex, position, normal);
    gl_Position = camera.world_to_sun * vec4(position, 1.0);
}
