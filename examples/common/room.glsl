// The room of the examples: boxes, made by the vertex shader without vertex buffers. World space, metres, +Y up.
struct Box {
    vec3 center;
    vec3 half_size;
    vec3 color;  // linear
    float metallic;
    float smoothness;  // 1 - perceptual roughness
};

const int box_count = 8;
const Box boxes[box_count] = Box[](
    Box(vec3(0.0, -0.1, 0.0), vec3(3.0, 0.1, 3.0), vec3(0.55), 0.0, 0.8),                // floor, polished
    Box(vec3(0.0, 1.5, -3.1), vec3(3.2, 1.7, 0.1), vec3(0.7, 0.7, 0.65), 0.0, 0.1),      // back wall
    Box(vec3(-3.1, 1.5, 0.0), vec3(0.1, 1.7, 3.0), vec3(0.75, 0.15, 0.1), 0.0, 0.1),     // left wall, red
    Box(vec3(3.1, 1.5, 0.0), vec3(0.1, 1.7, 3.0), vec3(0.15, 0.6, 0.15), 0.0, 0.1),      // right wall, green
    Box(vec3(-1.0, 0.8, -1.2), vec3(0.5, 0.8, 0.5), vec3(0.8, 0.75, 0.6), 0.0, 0.3),     // tall box
    Box(vec3(1.1, 0.4, -0.2), vec3(0.4, 0.4, 0.4), vec3(0.95, 0.64, 0.54), 1.0, 0.85),   // copper
    Box(vec3(0.1, 0.25, 1.0), vec3(0.25, 0.25, 0.25), vec3(0.1, 0.25, 0.8), 0.0, 0.5),   // small, blue
    Box(vec3(0.6, 1.6, -2.97), vec3(1.2, 0.8, 0.03), vec3(0.95), 1.0, 1.0));             // mirror on the back wall

layout(set = 0, binding = 0, std140) uniform Camera {
    mat4 world_to_view;
    mat4 world_to_clip;           // standard depth, jittered
    mat4 world_to_clip_plain;     // without jitter
    mat4 previous_world_to_clip;  // of the last frame, without jitter
    mat4 world_to_sun;
    vec4 to_sun;
    vec4 sky;
} camera;

// Corner 0 to 35 of a box, and the normal of its face.
void corner(int box, int index, out vec3 position, out vec3 normal) {
    const vec2 quad[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    int face = index / 6;
    float side = (face & 1) == 0 ? 1.0 : -1.0;
    vec2 at = quad[index % 6];
    vec3 p = vec3(side, at);
    normal = vec3(side, 0, 0);
    if (face / 2 == 1) { p = p.zxy; normal = normal.zxy; }
    if (face / 2 == 2) { p = p.yzx; normal = normal.yzx; }
    position = boxes[box].center + boxes[box].half_size * p;
}
