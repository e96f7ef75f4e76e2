// Copies a camera's rendering to the image shown by materials. In: radiance. Out: picture.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/live/live_picture.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock {
    LivePictureParams params;
};
layout(rgba16f) uniform readonly image2D radiance;
layout(rgba16f) uniform writeonly image2D picture;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.size)))) {
        imageStore(picture, pixel, imageLoad(radiance, pixel));
    }
}
