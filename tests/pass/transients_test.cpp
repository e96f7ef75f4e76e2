// What lives in one frame shares memory (gpu/transient_memory.h), so a pass that reads what no pass of the frame wrote
// reads what something else left there. With NaN in all of that memory, the pictures have the same bytes.
// REFLET_TRANSIENTS: any value, and every preset is tried with every scene.
#include "capture/show.h"
#include "pass/harness.h"
#include "renderer/presets.h"
#include "renderer/renderer.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"
#include "support/swept_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace reflet::test::transients_test {
namespace {

constexpr uvec2 size(36, 20);
constexpr uint32_t frames = 3;

// Bits, since NaN differs from itself.
bool sameBytes(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class TransientsOfFrame : public DeviceTest {};

/// What one frame shows.
struct Shown {
    Bitmap display;
    FloatImage lit;
};

class Transients : public DeviceTest, public testing::WithParamInterface<std::string> {
protected:
    // The camera and the scene move before the last frame, so that history is read where it fits and where it does not.
    static std::vector<Shown> render(Renderer& renderer, const Scene& scene, const Settings& settings) {
        renderer.restart(0);
        View view = defaultView(scene);
        std::vector<Shown> all;
        for (uint32_t i = 0; i < frames; ++i) {
            if (i + 1 == frames) {
                view.camera.position += vec3(0.1F, 0.0F, 0.05F);
                view.time = 0.1;
            }
            gpu::Readback display;
            ShowReadback lit;
            renderer.render(view, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
                display = f.readback(images.display);
                lit = requestShow(f, images, findShow("final"));
            });
            const ViewParams params = makeViewParams(view.camera, size, 0, 0);
            all.push_back({fetchDisplay(renderer.frame(), display, size), fetchValues(renderer.frame(), lit, params)});
        }
        return all;
    }

    static std::vector<Preset> presetsFor(const std::string& scene) {
        const std::vector<Preset> all = presets();
        if (std::getenv("REFLET_TRANSIENTS") != nullptr) {  // NOLINT(concurrency-mt-unsafe): one thread
            return all;
        }
        // A sixth with each scene, and so each with one or two: compiling their shaders takes most of the time.
        const auto scenes = builtinScenes();
        const auto index = std::ranges::find(scenes, scene, &BuiltinScene::name) - scenes.begin();
        std::vector<Preset> some;
        for (auto i = static_cast<size_t>(index) % 6; i < all.size(); i += 6) {
            some.push_back(all[i]);
        }
        return some;
    }
};

// Over 5 s: frames with several presets, with pipelines of their own.
TEST_P(Transients, NaNInTheirMemoryChangesNothing) {
    const Scene scene = findBuiltinScene(GetParam())->make();
    Renderer clean(device(), scene, [](const std::string&) {});
    Renderer poisoned(device(), scene, [](const std::string&) {});
    poisoned.poisonTransients(true);
    for (const Preset& preset : presetsFor(GetParam())) {
        Settings settings = smallPreset(preset.name);
        settings.materials.anisotropy = 1;
        const std::vector<Shown> expected = render(clean, scene, settings);
        const std::vector<Shown> found = render(poisoned, scene, settings);
        for (uint32_t i = 0; i < frames; ++i) {
            EXPECT_EQ(expected[i].display.data, found[i].display.data) << preset.name << ", display, frame " << i;
            EXPECT_TRUE(sameBytes(expected[i].lit.data, found[i].lit.data)) << preset.name << ", final, frame " << i;
        }
    }
}

// Without this, the test above would see nothing.
TEST_F(TransientsOfFrame, WhatNoPassWroteIsNaN) {
    gpu::Frame f(device());
    f.poisonTransients(true);
    f.begin();
    const gpu::Readback read = f.readback(f.image("never_written", VK_FORMAT_R32_SFLOAT, {8, 8}));
    f.submit();
    f.wait();
    std::array<float, 64> values{};
    std::memcpy(values.data(), f.bytes(read).data(), sizeof(values));
    EXPECT_TRUE(std::ranges::all_of(values, [](float v) { return std::isnan(v); }));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Transients, testing::ValuesIn(sweptScenes()),
                         [](const auto& chosen) { return nameInTests(chosen.param); });

}  // namespace
}  // namespace reflet::test::transients_test
