// The host's G-buffer: view-space normals with smoothness in alpha, base colour with metallic in alpha, motion in NDC.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "room.glsl"

layout(location = 0) in vec3 normal;
layout(location = 1) in vec4 clip_now;
layout(location = 2) in vec4 clip_before;
layout(location = 3) in flat int box;
layout(location = 0) out vec4 normal_smoothness;
layout(location = 1) out vec4 color_metallic;
layout(location = 2) out vec2 motion;

void main() {
    normal_smoothness = vec4(mat3(camera.world_to_view) * normalize(normal), boxes[box].smoothness);
    color_metallic = vec4(boxes[box].color, boxes[box].metallic);
    motion = clip_now.xy / clip_now.w - clip_before.xy / clip_before.w;
}
