// The camera's lens and shutter through the C API: depth of field, motion blur.
#include "library/library_fixture.h"

#include <algorithm>
#include <cmath>

namespace reflet::test {
namespace {

// The second frame's camera has moved sideways, and the host gives no motion: that of the matrices counts.
TEST_F(Library, MotionBlurFollowsTheCamera) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings(nullptr);
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    const RefletImage picture = room.light().light;
    RefletImage same{};
    RefletImage blurred{};
    RefletImage tiles{};
    for (uint32_t i = 0; i < 2; ++i) {
        host_.host.frame([&](VkCommandBuffer commands) {
            RefletFrameInfo frame = room.frame(commands, i);
            std::ranges::copy(frame.worldToView, frame.previousWorldToView);
            std::ranges::copy(frame.viewToClip, frame.previousViewToClip);
            frame.previousWorldToView[12] += 0.5F * static_cast<float>(i);
            RefletGBuffer gbuffer = *frame.gbuffer;
            gbuffer.motion = RefletImage{};
            frame.gbuffer = &gbuffer;
            EXPECT_REFLET(refletBeginFrame(view, &frame));
            EXPECT_REFLET(refletSetSetting(settings, "motion_blur.enabled", "false"));
            EXPECT_REFLET(refletMotionBlur(view, settings, &picture, &same));
            EXPECT_REFLET(refletSetSetting(settings, "motion_blur.enabled", "true"));
            EXPECT_REFLET(refletMotionBlur(view, settings, &picture, &blurred));
            EXPECT_REFLET(refletFindImage(view, "velocity_tiles", &tiles));
            EXPECT_REFLET(refletEndFrame(view));
        });
        host_.host.waitForAll();
        const std::vector<vec4> sharp = halvesOf(host_, same);
        const std::vector<vec4> result = halvesOf(host_, blurred);
        ASSERT_EQ(sharp.size(), result.size());
        size_t changed = 0;
        for (size_t k = 0; k < sharp.size(); ++k) {
            ASSERT_TRUE(std::isfinite(result[k].x) && result[k].x >= 0.0F) << k;
            changed += vec3(sharp[k]) == vec3(result[k]) ? 0 : 1;
        }
        EXPECT_EQ(changed > 50, i == 1) << "frame " << i << ", " << changed << " pixels";
        EXPECT_EQ(tiles.format, VK_FORMAT_R16G16_SFLOAT);
    }
    refletDestroyView(view);
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

// Focused 3 m away: the floor there stays as it is, the wall 6 m away does not.
TEST_F(Library, DepthOfFieldBlursWhatIsOutOfFocus) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings(nullptr);
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    const RoomResults results = renderFrames(room, view, settings, 4);
    const std::vector<vec4> sharp = halvesOf(host_, results.antialiased);
    const std::vector<vec4> blurred = halvesOf(host_, results.defocused);
    RefletImage coc{};
    EXPECT_REFLET(refletFindImage(view, "circle_of_confusion", &coc));
    EXPECT_EQ(coc.format, VK_FORMAT_R32_SFLOAT);
    const std::vector<float> radii = texelsOf<float>(host_, coc);
    unsigned kept = 0;
    unsigned changed = 0;
    for (size_t i = 0; i < sharp.size(); ++i) {
        const float radius = radii[i];
        const bool same = vec3(sharp[i]) == vec3(blurred[i]);
        kept += std::abs(radius) < 0.5F && same ? 1 : 0;
        changed += same ? 0 : 1;
        ASSERT_TRUE(std::isfinite(blurred[i].x) && blurred[i].x >= 0.0F) << i;
    }
    EXPECT_GT(kept, 20U);
    EXPECT_GT(changed, 200U);
    EXPECT_GT(radii[HostRoom::width / 2], 0.5F) << "the sky";
    refletDestroyView(view);
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

}  // namespace
}  // namespace reflet::test
