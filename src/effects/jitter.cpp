// Subpixel jitter offsets and jittered views.
#include "effects/jitter.h"

#include "base/sobol.h"

namespace reflet {

namespace {

// Moved so that sample 0 is in the middle; exclusive or keeps what lies in a cell of a grid together.
// reversed: bits of the sample.
float offset(uint32_t reversed, uint32_t seed) {
    const uint32_t moved = reverseBits(owenScrambled(reversed, seed) ^ owenScrambled(0, seed)) ^ 0x80000000U;
    return static_cast<float>(moved * 0x1p-32 - 0.5);
}

}  // namespace

vec2 subpixelJitter(uint32_t index) {
    // Of 40,000 pairs of seeds one whose first 4 to 64 samples are far from one another.
    return {offset(index, 0x91b29d53U), offset(reverseBits(sobolSecond(reverseBits(index))), 0x986c22dbU)};
}

void applyJitter(ViewParams& view, const vec2& jitter, const vec2& previousJitter) {
    const vec2 shift = -2.0F * jitter * view.pixel;  // in clip space, where w is 1
    mat4 move(1.0F);
    move[3] = vec4(shift, 0.0F, 1.0F);
    mat4 back(1.0F);
    back[3] = vec4(-shift, 0.0F, 1.0F);
    mat4 widen(1.0F);  // by half a pixel to each side, the largest jitter
    widen[0][0] += view.pixel.x;
    widen[1][1] += view.pixel.y;
    view.paddedClipToWorld = view.clipToWorld * widen;
    view.worldToClip = move * view.worldToClip;
    view.previousWorldToClip = move * view.previousWorldToClip;
    view.clipToWorld = view.clipToWorld * back;
    view.jitter = jitter;
    view.jitterChange = (jitter - previousJitter) * view.pixel;
}

}  // namespace reflet
