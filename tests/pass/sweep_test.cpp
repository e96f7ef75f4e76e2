// Every setting at its limits, every preset, every built-in scene, every image: finite, not negative, no validation
// messages; and the same bytes for the same input.
#include "pass/harness.h"

#include "apps/show.h"
#include "render/presets.h"
#include "scene/builtin.h"

#include <spdlog/fmt/fmt.h>

namespace reflet::test::sweep_test {
namespace {

constexpr uvec2 size(64, 36);

bool maySignify(std::string_view show) {  // images whose values may be negative
    return show == "normal" || show == "geometric_normal" || show == "motion";
}

void expectSound(const Pictures& p, const std::string& during) {
    for (const auto& [show, image] : p.images) {
        const Range range = rangeOf(image);
        EXPECT_TRUE(range.finite) << during << ": " << show;
        if (!maySignify(show)) {
            EXPECT_GE(range.min, 0.0F) << during << ": " << show;
        }
    }
    expectSilentValidation(during);
}

std::vector<std::string> allShows() {
    std::vector<std::string> names;
    for (const Show& show : shows()) {
        names.emplace_back(show.name);
    }
    return names;
}

TEST(Sweep, EverySceneRendersInEveryShow) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        const Scene scene = builtin.make();
        const Settings
            all =  // or back_depth, the steps, cascade_index, probe_atlas, temporal_frames would not be there
            settingsOf({"trace_screen.thickness_mode=second_layer", "trace_screen.count_steps=true",
                        "shadow.cascades=2", "probes.enabled=true", "probes.count=2", "probes.resolution=32",
                        "temporal.enabled=true"});
        std::vector<std::string> names = allShows();
        if (scene.lamps.empty()) {
            std::erase(names, "lamp_visibility");
            std::erase(names, "lamp_count");
        }
        const Pictures p = render(scene, defaultView(scene), size, all, names);
        expectSound(p, std::string(builtin.name));
        EXPECT_GT(rangeOf(p.images.at("final")).max, 0.05F) << builtin.name << " is dark";
        EXPECT_GT(rangeOf(p.images.at("depth")).max, 0.0F) << builtin.name << " is empty";
    }
}

TEST(Sweep, EverySettingWorksAtItsEnds) {
    const Scene gloss = findBuiltinScene("gloss")->make();
    const Scene cornell = findBuiltinScene("cornell")->make();
    for (const SettingEntry& entry : settingEntries()) {
        const Scene& scene = entry.name.starts_with("shadow.lamp") ? cornell : gloss;  // gloss has no lamps
        std::vector<std::string> values{fmt::format("{}", entry.info.lowest), fmt::format("{}", entry.info.highest)};
        if (entry.info.type == SettingType::choice) {
            values.clear();
            for (const SettingOption& option : entry.info.options) {
                values.push_back(option.name);
            }
        }
        for (const std::string& value : values) {
            const std::string assignment = entry.name + "=" + value;
            std::vector<std::string> assignments{assignment};
            for (const std::string source : {"probes", "planar", "trace_scene"}) {  // off, they would not be asked
                if (entry.name.starts_with(source + ".")) {
                    assignments.insert(assignments.begin(), {source + ".enabled=true", "probes.resolution=32"});
                }
            }
            const Settings settings = settingsOf(assignments);
            expectSound(render(scene, defaultView(scene), size, settings, {"final", "source"}), assignment);
        }
    }
}

TEST(Sweep, EveryPresetRendersEveryScene) {
    for (const Preset& preset : presets()) {
        Settings settings;
        applyPreset(settings, preset.name);
        for (const BuiltinScene& builtin : builtinScenes()) {
            const Scene scene = builtin.make();
            expectSound(render(scene, defaultView(scene), size, settings, {"final"}),
                        fmt::format("{} with {}", builtin.name, preset.name));
        }
    }
}

TEST(Sweep, OddSizesDownToOnePixelWork) {
    const Scene scene = findBuiltinScene("cubes")->make();
    for (const uvec2 odd : {uvec2(1, 1), uvec2(1, 33), uvec2(37, 1), uvec2(13, 7)}) {
        expectSound(render(scene, defaultView(scene), odd, {}, {"final"}), fmt::format("{}x{}", odd.x, odd.y));
    }
}

TEST(Sweep, TheSameInputGivesTheSameBytes) {
    const Scene scene = findBuiltinScene("cubes")->make();
    const auto once = [&] { return render(scene, defaultView(scene), size, {}, {"final"}, 2).images.at("final").data; };
    const std::vector<float> first = once();
    EXPECT_EQ(first, once());
}

TEST(Sweep, AChangedSizeStartsAnew) {
    Scene scene = findBuiltinScene("cubes")->make();
    for (Material& material : scene.materials) {
        material.roughness = 0.0F;  // mirror rays, which no noise changes
    }
    const View view = defaultView(scene);
    const Settings still = settingsOf({"diffuse.rays=0", "trace_screen.jitter=false", "shadow.filter=hard"});
    const Pictures fresh = render(scene, view, {40, 30}, still, {"final"});
    const Pictures resized = renderResized(scene, view, {64, 36}, {40, 30}, still, {"final"});
    EXPECT_EQ(fresh.images.at("final").data, resized.images.at("final").data);
    expectSilentValidation("a change of size");
}

TEST(Sweep, AnEmptySceneIsItsEnvironment) {
    const Scene scene;
    View view = defaultView(scene);
    view.sun = builtin::sun({0, -1, 0}, vec3(1.0F));
    view.environment.radiance = {0.25F, 0.5F, 0.75F};
    const Pictures p = render(scene, view, size, {}, {"final"});
    EXPECT_EQ(p.color("final", 10, 10), view.environment.radiance);
    expectSilentValidation("an empty scene");
}

TEST(Sweep, AnOrthographicCameraSeesParallel) {
    const Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::box(vec3(1.0F)));
    View view = defaultView(scene);
    view.camera.position = {0, 0, 10};
    view.camera.target = vec3(0.0F);
    view.camera.orthographicHeight = 4.0F;
    view.camera.far = 100.0F;
    const Pictures p = render(scene, view, {64, 32}, {}, {"final", "depth", "normal"});
    for (unsigned x = 0; x < 64; ++x) {  // 8 m wide: the box's face is the middle quarter
        const bool inside = x >= 24 && x < 40;
        EXPECT_NEAR(p.value("depth", x, 16), inside ? 9.0F : 0.0F, 1e-3F) << x;
    }
    expectSound(p, "orthographic");
}

}  // namespace
}  // namespace reflet::test::sweep_test
