// A camera inside glass or water: closed forms, and the path tracer.
#include "pass/harness.h"
#include "reference/reference.h"
#include "renderer/presets.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::camera_medium_test {
namespace {

using builtin::at;

constexpr uvec2 size(48, 48);
const vec3 attenuation(0.5F, 0.25F, 0.9F);  // after a metre

Material water(float ior, const vec3& color = attenuation) {
    Material m;
    m.metallic = 0.0F;
    m.roughness = 0.0F;
    m.ior = ior;
    m.transmission.factor = 1.0F;
    m.transmission.thickness = 1.0F;
    m.transmission.attenuationColor = color;
    m.transmission.attenuationDistance = 1.0F;
    return m;
}

Material glow(const vec3& emissive) {
    Material m;
    m.baseColor = vec4(0, 0, 0, 1);
    m.metallic = 0.0F;
    m.emissive = emissive;
    m.doubleSided = true;
    return m;
}

void add(Scene& scene, const Material& material, Mesh mesh, const mat4& objectToWorld = mat4(1.0F)) {
    const std::string name = std::to_string(scene.instances.size());
    builtin::place(scene, name, builtin::addMaterial(scene, material), std::move(mesh), objectToWorld);
}

Mesh wall(float halfSize) {
    return builtin::patch({.right = {halfSize, 0, 0}, .up = {0, halfSize, 0}});
}

View darkView() {
    View view;
    view.camera.position = {0, 0, 0};
    view.camera.target = {0, 0, -1};
    return view;
}

vec3 after(double metres) {
    return glm::pow(glm::dvec3(attenuation), glm::dvec3(metres));
}

// Only emission and refraction: no other light.
Pictures seen(const Scene& scene, const View& view, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"diffuse.rays=0", "specular.rays=0", "trace_screen.thickness=1"});
    Pictures p = render(scene, view, size, settingsOf(more), {"final", "direct", "indirect_specular"});
    expectSilentValidation("medium");
    return p;
}

TEST(CameraMedium, WhatIsInTheSameWaterIsAttenuatedByItsDistance) {
    for (const float ior : {1.0F, 1.33F}) {
        Scene scene;
        add(scene, water(ior), builtin::box({9, 9, 9}));
        add(scene, glow(vec3(1)), wall(9), at({0, 0, -1}));
        const Pictures p = seen(scene, darkView());
        for (const unsigned x : {4U, 24U, 44U}) {
            const double distance = 1.0 / -pixelDirection(darkView().camera, size, x, 24).z;
            EXPECT_LT(glm::distance(p.color("final", x, 24), after(distance)), 2e-3F) << ior << ": " << x;
            EXPECT_EQ(p.color("direct", x, 24), p.color("final", x, 24));
        }
    }
}

// Out of a block, toward a wall beyond.
TEST(CameraMedium, WhatIsOutsideIsSeenThroughTheBoundary) {
    for (const float ior : {1.0F, 1.33F, 1.8F}) {
        Scene scene;
        add(scene, water(ior), builtin::box({9, 9, 1}));
        add(scene, glow({1, 2, 4}), wall(30), at({0, 0, -4}));
        const float passes = 1.0F - std::pow((ior - 1.0F) / (ior + 1.0F), 2.0F);
        const vec3 expected = passes * vec3(1, 2, 4) * after(1.0);
        const vec3 got = seen(scene, darkView()).color("final", size.x / 2, size.y / 2);
        EXPECT_LT(glm::distance(got, expected), 0.01F) << ior << ": " << got.x << ' ' << got.y << ' ' << got.z;
    }
}

// Where a ray that leaves at an angle hits a wall: an edge of white and black moves by the closed form.
TEST(CameraMedium, TheBoundaryRefractsBySnellsLaw) {
    const float ior = 1.33F;
    Scene scene;
    add(scene, water(ior, vec3(1)), builtin::box({9, 9, 1}));
    add(scene, glow(vec3(1)), wall(20), at({-20 - 0.8F, 0, -2}));              // white left of x = -0.8
    const Pictures p = seen(scene, darkView(), {"trace_scene.enabled=true"});  // the wall reaches beyond the picture
    const auto atWall = [&](unsigned x) {
        const vec3 d = pixelDirection(darkView().camera, size, x, 24);
        const float sine = std::abs(d.x) / std::sqrt(d.x * d.x + d.z * d.z);
        return d.x / -d.z + std::copysign(std::tan(std::asin(std::min(ior * sine, 1.0F))), d.x);
    };
    int wrong = 0;
    for (unsigned x = 0; x < size.x; ++x) {
        const bool white = p.value("final", x, 24) > 0.4F;
        wrong += white != (atWall(x) < -0.8F) ? 1 : 0;
    }
    EXPECT_LE(wrong, 1);
    EXPECT_LT(atWall(0), -1.0F);
}

// A pool under a white sky: bright within the critical angle, its dark ground beyond.
Scene pool(float ior, const vec3& color, const vec3& ground) {
    Scene scene;
    add(scene, water(ior, color), builtin::box({60, 5, 60}), at({0, -5, 0}));
    add(scene, glow(ground), builtin::ground({59, 59}, {1, 1}, {1, 1}), at({0, -4, 0}));
    return scene;
}

View upward() {
    View view;
    view.camera.position = {0, -2, 0};
    view.camera.target = {0, 0, 0};
    view.camera.up = {0, 0, -1};
    view.camera.fovY = glm::radians(120.0F);
    view.environment.radiance = vec3(1.0F);
    return view;
}

TEST(CameraMedium, SnellsWindowEndsAtTheCriticalAngle) {
    const float ior = 1.33F;
    const Pictures p = seen(pool(ior, vec3(1.0F), vec3(0.0F)), upward(), {"trace_scene.enabled=true"});
    const float sine = 1.0F / ior;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const float aside = std::sqrt(1.0F - std::pow(pixelDirection(upward().camera, size, x, y).y, 2.0F));
            if (std::abs(aside - sine) > 0.02F) {
                ASSERT_EQ(p.value("final", x, y) > 0.3F, aside < sine) << x << ' ' << y;
            }
        }
    }
    EXPECT_NEAR(p.value("final", 24, 24), 1.0F - std::pow(0.33F / 2.33F, 2.0F), 0.01F);
}

// A glowing ball and floor in tinted water, and a striped wall beyond it. Neither is lit: that light on its way through
// water is attenuated is another matter.
Scene aquarium(float ior) {
    Scene scene;
    add(scene, water(ior, {0.6F, 0.8F, 0.95F}), builtin::box({3, 2, 3}));
    add(scene, glow(vec3(0.7F, 0.5F, 0.3F)), builtin::sphere(0.4F, 32), at({0.6F, -0.6F, -1.2F}));
    add(scene, glow(vec3(0.6F)), builtin::ground({2.9F, 2.9F}, {1, 1}, {1, 1}), at({0, -1.2F, 0}));
    for (int i = -4; i <= 4; ++i) {
        const vec3 color = i % 2 == 0 ? vec3(1.5F, 1.0F, 0.5F) : vec3(0.3F);
        add(scene, glow(color), builtin::patch({.right = {0.5F, 0, 0}, .up = {0, 4, 0}}),
            at({static_cast<float>(i), 0, -5}));
    }
    return scene;
}

// Edges may be a pixel off, where a ray meets the wall a little beside.
void compareAquarium(float ior) {
    View view = darkView();
    view.camera.target = {0, -0.2F, -1};
    view.environment.radiance = vec3(0.8F);
    Settings settings;
    applyPreset(settings, "hybrid");
    // No surface is lit, so what remains is what rays out of the water use; and edges are those of pixel centres.
    settings.diffuse.rays = 0;
    settings.planar.enabled = 0;
    settings.probes.enabled = 0;
    settings.temporal.enabled = 0;
    settings.denoise.enabled = 0;
    settings.specular.maxRoughness = 0.4F;  // rougher surfaces without noise
    settings.specular.roughFallback = RoughFallback::mips;
    const Scene scene = aquarium(ior);
    const FloatImage truth = traceReference(scene, view, size, {.samples = 64, .filter = PixelFilter::center}).final;
    const Pictures p = render(scene, view, size, settings, {"final"});
    glm::dvec3 drawn(0.0);
    glm::dvec3 expected(0.0);
    unsigned off = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 traced(truth.data[3 * (y * size.x + x)], truth.data[3 * (y * size.x + x) + 1],
                              truth.data[3 * (y * size.x + x) + 2]);
            const vec3 got = p.color("final", x, y);
            off += glm::distance(got, traced) > 0.05F * glm::length(traced) + 0.02F ? 1 : 0;
            drawn += glm::dvec3(got);
            expected += glm::dvec3(traced);
        }
    }
    const double share = off / static_cast<double>(size.x * size.y);
    testing::Test::RecordProperty("off", fmt::format("{:.4f}", share));
    EXPECT_LT(share, ior > 1.0F ? 0.03 : 0.002);
    for (int c = 0; c < 3; ++c) {
        testing::Test::RecordProperty(fmt::format("mean{}", c), fmt::format("{:.4f}", drawn[c] / expected[c]));
        EXPECT_NEAR(drawn[c] / expected[c], 1.0, ior > 1.0F ? 0.025 : 0.01) << c;
    }
}

TEST(CameraMedium, AnAquariumOfIndexOneIsThatOfTheReference) {
    compareAquarium(1.0F);
}

TEST(CameraMedium, AnAquariumOfWaterIsThatOfTheReference) {
    compareAquarium(1.33F);
}

TEST(CameraMedium, ACameraOutsideRecordsNothingOfIt) {
    const Scene scene = aquarium(1.33F);
    const auto passes = [&](const vec3& position) {
        const View view = viewFrom(position, position + vec3(0, 0, -1));
        const auto names = passNames(scene, view, size, settingsOf({"diffuse.rays=0"}));
        return std::ranges::count_if(names, [](const std::string& n) { return n.ends_with("camera_medium"); });
    };
    EXPECT_EQ(passes({0, 0, 3.5F}), 0);
    EXPECT_EQ(passes({0, 0, 0}), 1);
}

}  // namespace
}  // namespace reflet::test::camera_medium_test
