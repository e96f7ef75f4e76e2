// Moving objects in front of a mirror: the reflection is in the right place, and converges when the object stops.
#include "pass/harness.h"

#include <algorithm>

namespace reflet::test::reflected_motion_test {
namespace {

constexpr uvec2 size(96, 54);
constexpr double frameTime = 1.0 / 24;
constexpr double stopTime = 1.0;

TextureSlot stripes(Scene& scene) {
    TextureImage image{"stripes", 64, 64, {}};
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const bool odd = (x / 16 + y / 16) % 2 != 0;
            image.rgba.insert(image.rgba.end(), {uint8_t(odd ? 230 : 30), uint8_t(odd ? 200 : 60), 60, 255});
        }
    }
    return builtin::addTexture(scene, std::move(image));
}

/// A mirror for a floor, a grey wall behind, and a box that slides to the right and away until it stops.
Scene slidingBox(float roughness) {
    Material metal = lambertMaterial(vec3(0.9F));
    metal.metallic = 1.0F;
    metal.roughness = roughness;
    Scene scene = sceneOf(metal, builtin::ground({4, 4}, {1, 1}, {1, 1}));
    builtin::place(scene, "wall", builtin::addMaterial(scene, lambertMaterial(vec3(0.4F))),
                   builtin::patch({{0, 2, -3}, {4, 0, 0}, {0, 2, 0}, {1, 1}, {}}));
    Material striped = lambertMaterial(vec3(1.0F));
    striped.baseColorTexture = stripes(scene);
    builtin::place(scene, "box", builtin::addMaterial(scene, striped), builtin::box(vec3(0.5F)));
    scene.nodes.resize(1);
    scene.instances.back().node = 0;
    scene.animations.resize(1);
    scene.animations[0].channels.push_back(
        {.target = Channel::Target::translation,
         .times = {0.0F, float(stopTime), 2.0F},
         .values = {vec4(-1.2F, 0.8F, 0.2F, 0), vec4(0.8F, 0.8F, -0.8F, 0), vec4(0.8F, 0.8F, -0.8F, 0)}});
    return scene;
}

View viewAt(double time) {
    View view;
    view.camera = builtin::camera("", {0, 1.6F, 4.5F}, {0, 0.4F, -0.5F}, 45);
    view.sun = builtin::sun({-0.3F, -0.8F, -0.6F}, vec3(3.0F));
    view.environment.radiance = vec3(0.2F);
    view.time = time;
    return view;
}

/// Views of one frame after the other, up to one at `last` seconds.
std::vector<View> frames(double last, uint32_t count) {
    std::vector<View> views;
    for (uint32_t i = 0; i < count; ++i) {
        views.push_back(viewAt(last - (count - 1 - i) * frameTime));
    }
    return views;
}

const std::vector<std::string> shows{"indirect_specular", "roughness", "metallic"};

Settings reflections(const std::vector<std::string>& more) {
    std::vector<std::string> all{"diffuse.rays=0", "denoise.enabled=true"};
    all.insert(all.end(), more.begin(), more.end());
    return settingsOf(all);
}

/// Mean |a - b| over the mirror's pixels in `where`, over their mean in b.
double differenceOf(const FloatImage& a, const FloatImage& b, const std::vector<bool>& where) {
    double sum = 0.0;
    double mean = 0.0;
    for (size_t i = 0; i < b.data.size(); ++i) {
        if (where[i / 3]) {
            sum += std::abs(double(a.data[i]) - b.data[i]);
            mean += b.data[i];
        }
    }
    return sum / mean;
}

/// The mirror's pixels where two pictures differ.
std::vector<bool> changed(const Pictures& a, const Pictures& b) {
    std::vector<bool> mask;
    const auto& x = a.images.at("indirect_specular").data;
    const auto& y = b.images.at("indirect_specular").data;
    for (size_t i = 0; i < x.size(); i += 3) {
        const float most =
            std::max({std::abs(x[i] - y[i]), std::abs(x[i + 1] - y[i + 1]), std::abs(x[i + 2] - y[i + 2])});
        mask.push_back(most > 0.02F && b.images.at("metallic").data[i / 3] > 0.5F);
    }
    return mask;
}

double meanOver(const std::vector<bool>& mask) {
    return double(std::ranges::count(mask, true)) / double(mask.size());
}

TEST(ReflectedMotion, AMovingBoxIsWhereItIsInTheMirrorAndDoesNotTrail) {
    const Scene scene = slidingBox(0.0F);
    const Pictures start = render(scene, viewAt(0.0), size, reflections({"denoise.history=0"}), shows);
    for (const double time : {0.5, 0.75}) {
        const Pictures truth = render(scene, viewAt(time), size, reflections({"denoise.history=0"}), shows);
        const std::vector<bool> where = changed(start, truth);
        EXPECT_GT(meanOver(where), 0.03);
        const Pictures moving = renderPath(scene, frames(time, 12), size, reflections({}), shows).back();
        const double difference =
            differenceOf(moving.images.at("indirect_specular"), truth.images.at("indirect_specular"), where);
        RecordProperty("difference", std::to_string(difference));
        // 0.06 by the image alone, as if what it shows stood still; 0.023 on llvmpipe, 0.034 on a GPU
        EXPECT_LT(difference, 0.036) << time;
    }
    expectSilentValidation("a box before a mirror");
}

class StoppedReflection : public ::testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(Roughness, StoppedReflection, ::testing::Values(0.0F, 0.2F, 0.5F));

TEST_P(StoppedReflection, IsWithinFivePercentOfItsFinalValueAfterEightFrames) {
    const Scene scene = slidingBox(GetParam());
    const Settings settings = reflections({"specular.rays=8"});  // with fewer, the final value itself is noisier
    std::vector<View> views = frames(stopTime, 12);
    const size_t moving = views.size();
    views.resize(moving + 40, viewAt(stopTime));
    const std::vector<Pictures> pictures = renderPath(scene, views, size, settings, shows);
    const Pictures& last = pictures.back();
    const std::vector<bool> where = changed(pictures.front(), last);
    EXPECT_GT(meanOver(where), 0.03);
    for (const size_t after : {1U, 2U, 4U, 8U}) {
        const double difference = differenceOf(pictures[moving - 1 + after].images.at("indirect_specular"),
                                               last.images.at("indirect_specular"), where);
        RecordProperty("after" + std::to_string(after), std::to_string(difference));
        if (after == 8) {
            EXPECT_LT(difference, 0.05);
        }
    }
}

// The box disoccludes the wall. In the last frame the box was there, and its light must not appear on the wall.
TEST(ReflectedMotion, LightOfTheLastFrameIsThatOfTheSameSurface) {
    Scene scene = slidingBox(0.0F);
    Material& box = scene.materials.back();
    box.emissive = vec3(20.0F, 0.0F, 0.0F);
    const Settings settings = settingsOf({"diffuse.rays=0", "trace_screen.light=previous"});
    const std::vector<std::string> more{"indirect_specular", "metallic", "motion"};
    std::vector<View> views = frames(0.5, 3);
    const Pictures moving = renderPath(scene, views, size, settings, more).back();
    const Pictures still = render(scene, viewAt(0.5), size, settings, more, 3);
    unsigned red = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const bool mirror = still.value("metallic", x, y) > 0.5F;
            const bool ghost = moving.value("indirect_specular", x, y) > still.value("indirect_specular", x, y) + 5.0F;
            red += mirror && ghost ? 1 : 0;
        }
    }
    RecordProperty("ghosts", std::to_string(red));
    EXPECT_LE(red, 8U);
}

}  // namespace
}  // namespace reflet::test::reflected_motion_test
