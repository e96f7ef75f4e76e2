// Records motion blur.
#include "effects/motion_blur/motion_blur.h"

#include "effects/to_previous.h"
#include "gpu/context.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr VkFormat half4Format = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat half2Format = VK_FORMAT_R16G16_SFLOAT;

gpu::Image halfStreaks(gpu::PassList& f, const MotionBlurInputs& in, float longest) {
    const gpu::Image streaks = f.image("motion_blur.streaks", half4Format, in.depth.size);
    const vec2 toHalfStreak = 0.5F * in.settings.shutter * vec2(in.radiance.size);
    f.compute("streaks", "motion_blur_streaks.comp")
        .read("depth", in.depth)
        .constant("hasMotion", in.motion ? 1U : 0U)
        .read("motion", in.motion ? in.motion : f.placeholder(half2Format))
        .write("streaks", streaks)
        .params(MotionBlurStreakParams{in.motion ? toPreviousClip(in.view) : restToPreviousClip(in.view),
                                       in.view.depthToDistance, toHalfStreak, in.depth.size, longest})
        .dispatch(in.depth.size);
    return streaks;
}

// Rows first, then columns: each texel is read once, and each thread reads few.
gpu::Image longestInTiles(gpu::PassList& f, gpu::Image streaks, uint32_t side) {
    const uvec2 tiles = (streaks.size + side - 1U) / side;
    const gpu::Image rows = f.image("motion_blur.rows", half2Format, {tiles.x, streaks.size.y});
    const gpu::Image own = f.image("motion_blur.own_tiles", half2Format, tiles);
    f.compute("rows", "motion_blur_tiles.comp")
        .read("streaks", streaks)
        .write("longest", rows)
        .params(MotionBlurTileParams{streaks.size, rows.size, {1, 0}, side})
        .dispatch(rows.size);
    f.compute("tiles", "motion_blur_tiles.comp")
        .read("streaks", rows)
        .write("longest", own)
        .params(MotionBlurTileParams{rows.size, tiles, {0, 1}, side})
        .dispatch(tiles);
    const gpu::Image around = f.image("motion_blur.tiles", half2Format, tiles);
    f.compute("around", "motion_blur_around.comp").read("tiles", own).write("around", around).dispatch(tiles);
    return around;
}

}  // namespace

bool blurs(const MotionBlurSettings& settings) {
    return settings.enabled != 0 && settings.shutter > 0.0F;
}

MotionBlurImages motionBlur(gpu::PassList& f, const MotionBlurInputs& in) {
    if (!blurs(in.settings)) {
        return {in.radiance, {}};
    }
    const auto scope = f.scope("motion_blur");
    const uvec2 size = in.radiance.size;
    const vec2 toDepth = vec2(in.depth.size) / vec2(size);
    const float longest = 0.5F * in.settings.maxLength * static_cast<float>(size.y);
    // What reaches a pixel is at most a tile away.
    constexpr float smallest = 4.0F;
    const float side = std::ceil(std::max(longest * std::max(toDepth.x, toDepth.y), smallest));
    const gpu::Image streaks = halfStreaks(f, in, longest);
    const gpu::Image tiles = longestInTiles(f, streaks, static_cast<uint32_t>(side));
    const gpu::Image result = f.image("motion_blur", half4Format, size);
    f.compute("gather", "motion_blur_gather.comp")
        .read("radiance", in.radiance, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .read("streaks", streaks)
        .read("tiles", tiles)
        .write("result", result)
        .params(MotionBlurGatherParams{size, toDepth, toDepth / side, in.settings.samples,
                                       in.view.rest > 0 ? 0U : in.view.frame})
        .dispatch(size);
    return {result, tiles};
}

}  // namespace reflet
