// Every setting at its ends, every preset, every built-in scene, every image: finite, not negative, and the validation
// layers silent. Every setting changes something. And the same input gives the same bytes.
#include "pass/harness.h"
#include "pass/sweep_contexts.h"

#include "capture/show.h"
#include "renderer/presets.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"
#include "support/swept_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace reflet::test::sweep_test {
namespace {

constexpr uvec2 size(60, 34);

using Images = std::map<std::string, FloatImage>;

bool maySignify(std::string_view show) {  // images whose values may be negative
    return show == "normal" || show == "geometric_normal" || show == "bent_normal" || show == "motion" ||
           show == "circle_of_confusion" || show == "velocity_tiles";
}

void expectSound(const Images& images, const std::string& during) {
    for (const auto& [show, image] : images) {
        const Range range = rangeOf(image);
        EXPECT_TRUE(range.finite) << during << ": " << show;
        if (!maySignify(show)) {
            EXPECT_GE(range.min, 0.0F) << during << ": " << show;
        }
    }
    expectSilentValidation(during);
}

// The contract of layers (docs/datasets.md): the light before temporal antialiasing is the sum of its parts, up to the
// rounding of half floats. Values that are near the largest half float are clamped one by one.
void expectLayersAddUp(const Images& images, const std::string& during) {
    const std::vector<float>& all = images.at("unfiltered").data;
    const std::vector<float>& direct = images.at("direct").data;
    const std::vector<float>& diffuse = images.at("indirect_diffuse").data;
    const std::vector<float>& specular = images.at("indirect_specular").data;
    ASSERT_EQ(all.size(), direct.size()) << during;
    size_t off = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        const float sum = direct[i] + diffuse[i] + specular[i];
        off += std::abs(all[i] - sum) > 0.002F * (sum + 1e-3F) && sum < 3e4F ? 1 : 0;
    }
    EXPECT_EQ(off, 0U) << during << ": values of the layers do not add up";
}

// A scene that is set up once and rendered with many settings, each time as if for the first time.
class Subject {
public:
    Subject(gpu::Device& device, Scene made)
        : scene_(std::move(made)), view_(defaultView(scene_)), renderer_(device, scene_, [](const std::string&) {}) {}

    [[nodiscard]] const Scene& scene() const { return scene_; }
    // All images that the last frame has, and "display", the tone-mapped one. moved: how far the camera is elsewhere
    // in it [m].
    Images images(const Settings& settings, uint32_t frames = 1, float moved = 0.0F) {
        renderer_.restart(0);
        std::vector<ShowReadback> readbacks;
        gpu::Readback display;
        View view = view_;
        for (uint32_t i = 0; i < frames; ++i) {
            if (i + 1 == frames) {
                view.camera.position += moved * vec3(1.0F, 0.0F, 0.5F);
            }
            renderer_.render(view, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
                if (i + 1 == frames) {
                    readbacks = requestAll(f, images);
                    display = f.readback(images.display);
                }
            });
        }
        const ViewParams params = makeViewParams(view.camera, size, 0, 0);
        Images all;
        for (const ShowReadback& readback : readbacks) {
            all[std::string(readback.show->name)] = fetchValues(renderer_.frame(), readback, params);
        }
        const Bitmap bitmap = fetchDisplay(renderer_.frame(), display, size);
        all["display"] = {size.x, size.y, {"R", "G", "B"}, {bitmap.data.begin(), bitmap.data.end()}};
        return all;
    }

private:
    static std::vector<ShowReadback> requestAll(gpu::Frame& f, const FrameImages& images) {
        std::vector<ShowReadback> readbacks;
        for (const Show& show : shows()) {
            const bool large = show.name == "shadow_map" || show.name == "probe_atlas";  // others show what they change
            const std::vector<gpu::Image> needed = show.images(images);
            if (!large && std::ranges::all_of(needed, [](const gpu::Image& i) { return bool(i); })) {
                readbacks.push_back(requestShow(f, images, show));
            }
        }
        return readbacks;
    }

    Scene scene_;
    View view_;
    Renderer renderer_;
};

class Sweep : public DeviceTest {
protected:
    static Subject& subject(const std::string& name) {
        auto& subjects = all();
        if (!subjects.contains(name)) {
            Scene scene = name == "monitor"       ? monitor()
                          : name == "panes"       ? panes()
                          : name == "wide lens"   ? wideLens("lens")
                          : name == "wide mirror" ? wideLens("mirror-hall")
                                                  : findBuiltinScene(name)->make();
            subjects[name] = std::make_unique<Subject>(device(), std::move(scene));
        }
        return *subjects.at(name);
    }
    static void TearDownTestSuite() { all().clear(); }  // before the device

private:
    static std::map<std::string, std::unique_ptr<Subject>>& all() {
        static std::map<std::string, std::unique_ptr<Subject>> subjects;
        return subjects;
    }
    // Half of the materials are blended.
    static Scene panes() {
        Scene scene = findBuiltinScene("gloss")->make();
        for (size_t i = 1; i < scene.materials.size(); i += 2) {
            scene.materials[i].baseColor.a = 0.5F;
            scene.materials[i].alphaCutoff = blendCutoff;
            scene.materials[i].blended = true;
        }
        return scene;
    }
    // Disks of several pixels, in pictures as small as these.
    static Scene wideLens(const char* name) {
        Scene scene = findBuiltinScene(name)->make();
        scene.cameras.front().apertureRadius = 1.0F;
        return scene;
    }
    // A surface that shows what a camera of the scene sees.
    static Scene monitor() {
        Scene scene = findBuiltinScene("gloss")->make();
        for (Material& material : scene.materials) {
            material.camera = "other";
        }
        scene.cameras.push_back(defaultView(scene).camera);
        scene.cameras.push_back(builtin::camera("other", {3, 2, 4}, {0, 0.5F, 0}, 40));
        return scene;
    }
};

// Why no image can tell how these are set.
const std::map<std::string_view, std::string_view> invisible{
    {"direct.lamp_tiles", "culling"},
    {"direct.emitters", "the scene has none"},
    {"trace_scene.ray_query", "hardware"},
    {"trace_screen.compaction", "the same rays in several passes"},
};

std::vector<std::string> endsOf(const SettingEntry& entry) {
    std::vector<std::string> values;
    if (entry.info.type == SettingType::choice) {
        std::ranges::transform(entry.info.options, std::back_inserter(values), &SettingOption::name);
    } else {
        for (const double end : {entry.info.lowest, entry.info.highest, entry.info.standard}) {
            if (const std::string text = fmt::format("{}", end); std::ranges::find(values, text) == values.end()) {
                values.push_back(text);
            }
        }
    }
    return values;
}

// A setting that nothing reads would give the same images at both ends.
class SweepOfGroup : public Sweep, public testing::WithParamInterface<std::string> {};

// Over 5 s: a frame for each end of each setting, most with pipelines of their own.
TEST_P(SweepOfGroup, EverySettingIsSoundAtItsEndsAndRead) {
    for (const SettingEntry& entry : settingEntries()) {
        if (entry.name.substr(0, entry.name.find('.')) != GetParam()) {
            continue;
        }
        const Context& context = contextOf(entry.name);
        std::vector<Images> seen;
        const auto differs = [&] {
            return std::ranges::any_of(seen, [&](const Images& images) {
                return !std::ranges::equal(images, seen.front(), [](const auto& a, const auto& b) {
                    return a.first == b.first && a.second.data == b.second.data;
                });
            });
        };
        const bool isChoice = entry.info.type == SettingType::choice;
        for (const std::string& value : endsOf(entry)) {
            if (!isChoice && seen.size() == 2 && differs()) {
                break;  // the default, which all other settings' frames have
            }
            std::vector<std::string> assignments = context.with;
            assignments.push_back(entry.name + "=" + value);
            seen.push_back(subject(context.scene).images(settingsOf(assignments), context.frames, context.moved));
            expectSound(seen.back(), assignments.back());
        }
        EXPECT_NE(differs(), invisible.contains(entry.name)) << entry.name << (differs() ? " is seen" : " is not read");
    }
}

std::vector<std::string> groups() {
    std::vector<std::string> names;
    for (const SettingEntry& entry : settingEntries()) {
        if (const std::string group = entry.name.substr(0, entry.name.find('.'));
            std::ranges::find(names, group) == names.end()) {
            names.push_back(group);
        }
    }
    return names;
}

INSTANTIATE_TEST_SUITE_P(Settings, SweepOfGroup, testing::ValuesIn(groups()),
                         [](const auto& chosen) { return chosen.param; });

class SweepOfScene : public Sweep, public testing::WithParamInterface<std::string> {};

// Over 5 s: frames with several presets, with pipelines of their own.
TEST_P(SweepOfScene, IsSoundInEveryShowAndWithEveryPreset) {
    Subject& scene = subject(GetParam());
    const Settings all = settingsOf({"trace_screen.thickness_mode=second_layer", "trace_screen.count_steps=true",
                                     "trace_screen.count_hits=true", "shadow.cascades=2", "shadow.resolution=256",
                                     "shadow.lamp_resolution=64", "probes.enabled=true", "probes.count=2",
                                     "probes.resolution=16", "temporal.enabled=true", "materials.anisotropy=1",
                                     "ao.method=bitmask", "motion_blur.enabled=true"});
    const Images images = scene.images(all);
    expectSound(images, GetParam());
    EXPECT_GT(rangeOf(images.at("final")).max, 0.05F) << "dark";
    EXPECT_GT(rangeOf(images.at("depth")).max, 0.0F) << "empty";
    for (const Show& show : shows()) {
        const bool ofLamps = show.name == "lamp_visibility" || show.name == "lamp_count";
        const bool large = show.name == "shadow_map" || show.name == "probe_atlas";
        const bool ofLens = show.name == "circle_of_confusion";
        const bool lacks = (ofLamps && scene.scene().lamps.empty()) ||
                           (ofLens && defaultView(scene.scene()).camera.apertureRadius == 0.0F);
        const auto found = images.find(std::string(show.name));
        EXPECT_TRUE(large || found != images.end() || lacks) << show.name;
        if (found != images.end() && show.picture != nullptr) {
            const Bitmap picture = makePicture(show, found->second);
            EXPECT_EQ(picture.data.size(), size_t(3) * found->second.width * found->second.height) << show.name;
        }
    }
    // A quarter of the presets with each scene: compiling their shaders takes most of the time.
    const std::vector<std::string> scenes = sweptScenes();
    const auto index = static_cast<size_t>(std::ranges::find(scenes, GetParam()) - scenes.begin());
    const auto known = presets();
    for (size_t i = index % 4; i < known.size(); i += 4) {
        const Preset& preset = known[i];
        Settings settings = smallPreset(preset.name);
        settings.materials.anisotropy = 1;  // which presets name for speed alone; its ends are swept apart
        const Images ofPreset = scene.images(settings);
        expectSound(ofPreset, preset.name);
        expectLayersAddUp(ofPreset, preset.name);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SweepOfScene, testing::ValuesIn(sweptScenes()),
                         [](const auto& chosen) { return nameInTests(chosen.param); });

TEST_F(Sweep, LayersAddUpWhereBlendedSurfacesAreAntialiasedApart) {
    expectLayersAddUp(subject("panes").images(settingsOf({"temporal.enabled=true"}), 2), "panes");
    expectLayersAddUp(subject("panes").images({}), "panes, not antialiased");
}

TEST_F(Sweep, OddSizesDownToOnePixelWork) {
    const Scene scene = findBuiltinScene("cubes")->make();
    for (const uvec2 odd : {uvec2(1, 1), uvec2(1, 33), uvec2(37, 1), uvec2(13, 7)}) {
        expectSound(render(scene, defaultView(scene), odd, {}, {"final"}).images, fmt::format("{}x{}", odd.x, odd.y));
    }
}

TEST_F(Sweep, AChangedSizeStartsAnew) {
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

TEST_F(Sweep, AnEmptySceneIsItsEnvironment) {
    const Scene scene;
    View view = defaultView(scene);
    view.sun = builtin::sun({0, -1, 0}, vec3(1.0F));
    view.environment.radiance = {0.25F, 0.5F, 0.75F};
    const Pictures p = render(scene, view, size, {}, {"final"});
    EXPECT_EQ(p.color("final", 10, 10), view.environment.radiance);
    expectSilentValidation("an empty scene");
}

TEST_F(Sweep, AnOrthographicCameraSeesParallel) {
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
    expectSound(p.images, "orthographic");
}

}  // namespace
}  // namespace reflet::test::sweep_test
