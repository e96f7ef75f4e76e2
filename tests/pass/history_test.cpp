// What historyUse says of settings is what frames do.
#include "renderer/history.h"

#include "capture/show.h"
#include "pass/harness.h"
#include "renderer/presets.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"

#include <fmt/format.h>

#include <set>

namespace reflet::test::history_test {
namespace {

constexpr uvec2 size(24, 14);

class History : public DeviceTest {
protected:
    FloatImage next(const Settings& settings) {
        ShowReadback readback;
        renderer_.render(view_, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
            readback = requestShow(f, images, findShow("final"));
        });
        return fetchValues(renderer_.frame(), readback, makeViewParams(view_.camera, size, 0, 0));
    }
    // Whether a frame is another one for the frames before it.
    bool dependsOnFramesBefore(const Settings& settings) {
        constexpr uint32_t before = 7;  // all faces of a probe, and one more
        renderer_.restart(0);
        for (uint32_t i = 0; i < before; ++i) {
            next(settings);
        }
        const FloatImage after = next(settings);
        renderer_.restart(before);
        return after.data != next(settings).data;
    }

private:
    Scene scene_ = findBuiltinScene("colonnade")->make();
    View view_ = defaultView(scene_);
    Renderer renderer_{device(), scene_, [](const std::string&) {}};
};

// Over 5 s: two chains of frames for each setting that keeps history.
TEST_F(History, IsUsedWhereAFrameDependsOnThoseBeforeIt) {
    const std::vector<std::pair<bool, std::vector<std::string>>> cases{
        {false, {}},
        {true, {"shadow.history=8"}},
        {false, {"shadow.history=8", "shadow.denoise=false"}},
        {false, {"shadow.history=8", "shadow.filter=hard"}},
        {true, {"trace_screen.light=previous"}},
        {false, {"trace_screen.light=previous", "trace_screen.enabled=false"}},
        {false, {"trace_screen.light=previous", "diffuse.rays=0", "specular.rays=0"}},
        {true, {"denoise.enabled=true"}},
        {false, {"denoise.enabled=true", "denoise.history=0"}},
        {false, {"denoise.enabled=true", "diffuse.rays=0", "specular.rays=0"}},
        {true, {"temporal.enabled=true"}},
        {true, {"accumulate.enabled=true"}},
        {true, {"accumulate.enabled=true", "temporal.enabled=true"}},
        {false, {"probes.enabled=true", "probes.resolution=16", "probes.count=1"}},
        {true, {"probes.enabled=true", "probes.resolution=16", "probes.count=1", "probes.refresh=face"}}};
    for (const auto& [expected, assignments] : cases) {
        const Settings settings = settingsOf(assignments);
        const std::string what = assignments.empty() ? "defaults" : fmt::format("{}", fmt::join(assignments, " "));
        EXPECT_EQ(historyUse(settings).any(), expected) << what;
        EXPECT_EQ(dependsOnFramesBefore(settings), expected) << what;
    }
}

TEST_F(History, OfPresetsIsKeptByThoseThatDenoise) {
    for (const Preset& preset : presets()) {
        Settings settings;
        applyPreset(settings, preset.name);
        const HistoryUse use = historyUse(settings);
        const std::set<std::string> denoising{"still", "fast", "balanced", "quality", "hybrid"};
        const bool denoises = denoising.contains(preset.name);
        EXPECT_EQ(use.shadows && use.denoise && use.temporal, denoises) << preset.name;
        EXPECT_EQ(use.any(), denoises || preset.name == "pathtrace") << preset.name;
        const uint32_t settled = settings.temporal.scale < 1.0F ? 64 : 32;
        EXPECT_EQ(framesToSettle(use, settings), denoises ? settled : use.accumulate ? 64U : 1U) << preset.name;
    }
}

TEST(HistoryOfScene, IsKeptByTexturesThatShowACamera) {
    Scene scene;
    EXPECT_FALSE(historyUse({}, scene).any());
    scene.materials.emplace_back();
    scene.materials.back().camera = "door";
    EXPECT_TRUE(historyUse({}, scene).cameraTextures);
    EXPECT_EQ(framesToSettle(historyUse({}, scene), {}), 32U);
}

TEST(HistoryOfProbes, SettlesWhenEveryFaceHasEveryBounce) {
    const Settings settings =
        settingsOf({"probes.enabled=true", "probes.refresh=face", "probes.count=10", "probes.bounces=1"});
    EXPECT_EQ(framesToSettle(historyUse(settings), settings), 120U);
}

TEST(Jitter, IsThatOfTheHistoryThatAveragesIt) {
    EXPECT_EQ(frameJitter({}, 5, 2), vec2(0.0F));
    const Settings temporal = settingsOf({"temporal.enabled=true"});
    EXPECT_NE(frameJitter(temporal, 5, 2), vec2(0.0F));
    EXPECT_EQ(frameJitter(temporal, 5, 2), frameJitter(temporal, 5, 3));
    const Settings mean = settingsOf({"accumulate.enabled=true", "temporal.enabled=true"});
    EXPECT_EQ(frameJitter(mean, 5, 2), frameJitter(mean, 6, 2));
    EXPECT_EQ(frameJitter(settingsOf({"accumulate.enabled=true", "accumulate.jitter=false"}), 5, 2), vec2(0.0F));
}

}  // namespace
}  // namespace reflet::test::history_test
