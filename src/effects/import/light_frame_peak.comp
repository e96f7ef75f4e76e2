// The brightest of all tiles. One group. In: the last frame's peaks. Out: one texel.
#version 460

layout(local_size_x = 64) in;
layout(r32f) uniform readonly image2D peaks;
layout(r32f) uniform writeonly image2D framePeak;

shared float brightest[64];

void main() {
    uint own = gl_LocalInvocationIndex;
    ivec2 tiles = imageSize(peaks);
    float most = 0.0;
    for (int i = int(own); i < tiles.x * tiles.y; i += 64) {
        most = max(most, imageLoad(peaks, ivec2(i % tiles.x, i / tiles.x)).r);
    }
    brightest[own] = most;
    barrier();
    if (own > 0u) {
        return;
    }
    for (int i = 1; i < 64; ++i) {
        most = max(most, brightest[i]);
    }
    imageStore(framePeak, ivec2(0), vec4(most));
}
