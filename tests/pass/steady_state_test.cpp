// A renderer makes what its frames need in the first of them, and nothing after that.
#include "pass/harness.h"
#include "renderer/renderer.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"
#include "support/swept_scenes.h"

namespace reflet::test::steady_state_test {
namespace {

class SteadyState : public DeviceTest {
protected:
    static void renderFrames(Renderer& renderer, const View& view, uvec2 size, const Settings& settings, int frames) {
        for (int i = 0; i < frames; ++i) {
            renderer.render(view, size, 0, settings);
        }
    }
    static VkDeviceSize memory() { return device().memory().used(gpu::MemoryUse::device); }

    Scene scene_ = findBuiltinScene("cornell")->make();
    View view_ = defaultView(scene_);
};

// Over 5 s: every preset compiles its own shaders.
TEST_F(SteadyState, MakesNothing) {
    for (const char* name : {"fast", "balanced", "quality", "hybrid"}) {
        Renderer renderer(device(), scene_, [](const std::string&) {});
        const Settings settings = smallPreset(name);
        renderFrames(renderer, view_, {48, 27}, settings, 6);  // histories swap, and lend their memory
        const gpu::ObjectCounts made = device().counts();
        renderFrames(renderer, view_, {48, 27}, settings, 3);
        EXPECT_TRUE(made == device().counts()) << name;
    }
}

// Over 5 s: the preset compiles its own shaders.
TEST_F(SteadyState, IsRecordedByTheLastFramesPlan) {
    Renderer renderer(device(), scene_, [](const std::string&) {});
    const Settings settings = smallPreset("balanced");
    renderer.orderPasses(gpu::PassOrder::byLevel);  // as on GPUs
    renderFrames(renderer, view_, {48, 27}, settings, 4);
    for (int i = 0; i < 2; ++i) {
        renderFrames(renderer, view_, {48, 27}, settings, 1);
        const gpu::RecordingCounts& counts = renderer.frame().counts();
        EXPECT_EQ(counts.plans, 0U);
        EXPECT_GT(counts.passes, 0U);
        EXPECT_LE(2 * counts.barriers, counts.passes);
    }
}

TEST_F(SteadyState, TwoViewsInTurnMakeNothing) {
    Renderer one(device(), scene_, [](const std::string&) {});
    Renderer other(device(), scene_, [](const std::string&) {});
    const Settings settings = smallPreset("fast");
    gpu::ObjectCounts made;
    for (int i = 0; i < 9; ++i) {
        renderFrames(one, view_, {48, 27}, settings, 1);
        renderFrames(other, view_, {40, 24}, settings, 1);
        made = i == 6 ? device().counts() : made;
    }
    EXPECT_TRUE(made == device().counts());
}

TEST_F(SteadyState, ManySizesLeaveNoMemoryBehind) {
    Renderer renderer(device(), scene_, [](const std::string&) {});
    const Settings settings = smallPreset("fast");
    renderFrames(renderer, view_, {48, 27}, settings, 5);
    const VkDeviceSize before = memory();
    for (uint32_t i = 0; i < 10; ++i) {
        renderFrames(renderer, view_, {33 + 7 * i % 40, 20 + 5 * i % 30}, settings, 1);
    }
    renderFrames(renderer, view_, {48, 27}, settings, 5);
    EXPECT_LE(memory(), before) << "it may be less: the first frames had room for what is done once";
}

}  // namespace
}  // namespace reflet::test::steady_state_test
