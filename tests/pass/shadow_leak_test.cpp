// Sealed rooms in the sun and among lamps are dark inside: no light leaks in where their walls meet.
#include "pass/harness.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/surface_nets.h"

#include <fmt/format.h>

#include <array>

namespace reflet::test::shadow_leak_test {
namespace {

constexpr uvec2 size(240, 135);

struct Eye {
    vec3 position;
    vec3 target;
};

struct Sealed {
    const char* name;
    Mesh (*mesh)();
    std::vector<Eye> eyes;
};

Mesh corridor() {
    // Every corner of a patch is a corner of its neighbours: there are no cracks.
    const std::array<vec2, 8> outline{vec2(-11, -1), {-1, -1}, {1, -1}, {1, 1}, {1, 7}, {-1, 7}, {-1, 1}, {-11, 1}};
    Mesh mesh;
    const auto add = [&](const vec3& from, const vec3& to) {
        const vec3 half = 0.5F * (to - from);
        const vec3 up = half.y == 0.0F ? vec3(0, 0, half.z) : vec3(0, half.y, 0);
        builtin::append(mesh, builtin::patch({0.5F * (from + to), half - up, up}), mat4(1.0F));
    };
    for (size_t i = 0; i < outline.size(); ++i) {
        const vec2 a = outline[i];
        const vec2 b = outline[(i + 1) % outline.size()];
        add({a.x, -1.2F, a.y}, {b.x, 1.2F, b.y});
    }
    for (const float y : {-1.2F, 1.2F}) {
        add({-11, y, -1}, {-1, y, 1});
        add({-1, y, -1}, {1, y, 1});
        add({-1, y, 1}, {1, y, 7});
    }
    builtin::finish(mesh);
    return mesh;
}

// Rock with a rugged hollow in it: creases at all angles.
Mesh cave() {
    const auto rock = [](const vec3& p) {
        const float hollow = glm::length(p / vec3(1.2F, 0.8F, 1.0F)) - 2.2F;
        return -(hollow + 0.8F * builtin::fractalNoise(p * 0.8F, 4, 3U));
    };
    return builtin::surfaceNets({vec3(-4.0F), 0.2F, {40, 40, 40}}, rock);
}

const std::vector<Sealed>& sealedScenes() {
    static const std::vector<Sealed> all{
        {"Room",
         [] {
             return builtin::box({3, 1.5F, 2.5F});
         },
         {{{2.5F, 1.1F, 2.1F}, {-2, -1.4F, -2}}, {{-2.4F, -0.9F, -1.8F}, {2.6F, 1.2F, 2.2F}}}},
        {"Corridor", corridor, {{{0.4F, 0.4F, 5.5F}, {-0.4F, -0.9F, -1}}, {{-9, 0.3F, 0.4F}, {1, -0.4F, -0.6F}}}},
        {"Cave", cave, {{{0, 0, 0}, {1.5F, -1, -1.5F}}, {{0.3F, -0.5F, 0.5F}, {-1.5F, 1, 0.6F}}}},
    };
    return all;
}

/// Pixels, and those that light reaches.
struct Count {
    unsigned lit = 0;
    unsigned all = 0;
};

/// A scene from all its eyes, upright and tilted, in the light that `light` adds to scene and view.
template <typename Light>
Count leaks(const Sealed& sealed, const std::string& filter, const Light& light) {
    Material material = lambertMaterial(vec3(0.5F));
    material.doubleSided = true;
    Count count;
    for (const mat4& turn : {mat4(1.0F), builtin::turned(33.0F, glm::normalize(vec3(1, 2, 3)))}) {
        Scene scene;
        builtin::place(scene, sealed.name, builtin::addMaterial(scene, material), sealed.mesh(), turn);
        for (const Eye& eye : sealed.eyes) {
            View view;
            view.camera.position = turn * vec4(eye.position, 1);
            view.camera.target = turn * vec4(eye.target, 1);
            view.camera.fovY = glm::radians(80.0F);
            view.camera.near = 0.02F;
            light(scene, view, mat3(turn));
            const Pictures p =
                render(scene, view, size, settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.filter=" + filter}),
                       {"direct", "depth"});
            EXPECT_GT(rangeOf(p.images.at("depth")).min, 0.0F) << "the camera looks at walls only";
            for (unsigned y = 0; y < size.y; ++y) {
                for (unsigned x = 0; x < size.x; ++x) {
                    count.lit += p.value("direct", x, y) > 0.0F ? 1 : 0;
                    ++count.all;
                }
            }
        }
    }
    return count;
}

struct LeakCase {
    size_t scene;
    const char* filter;
    double sunLimit;   ///< pixels for each that the sun may light
    double lampLimit;  ///< of the lamps, whose maps are coarse: a texel is 5 cm here
};

class ShadowLeak : public testing::TestWithParam<LeakCase> {
protected:
    static void expectDark(const char* what, const Count& count, double limit) {
        RecordProperty(what, fmt::format("{} of {}", count.lit, count.all));
        EXPECT_LE(limit * count.lit, count.all) << what << ": " << count.lit << " of " << count.all;
    }
};

TEST_P(ShadowLeak, LightsFewPixelsOfASealedSceneInTheSun) {
    const Sealed& sealed = sealedScenes()[GetParam().scene];
    expectDark("sun",
               leaks(sealed, GetParam().filter,
                     [](Scene&, View& view, const mat3&) {
                         view.sun = builtin::sun(glm::normalize(vec3(0.4F, -0.9F, -0.2F)), vec3(100.0F));
                     }),
               GetParam().sunLimit);
}

TEST_P(ShadowLeak, LightsFewPixelsOfASealedSceneAmongLamps) {
    const Sealed& sealed = sealedScenes()[GetParam().scene];
    expectDark("lamps",
               leaks(sealed, GetParam().filter,
                     [](Scene& scene, View&, const mat3& turn) {
                         scene.lamps.clear();
                         for (const vec3& direction :
                              {vec3(0.9F, 0.35F, 0.2F), vec3(-0.3F, 0.9F, 0.4F), vec3(0.1F, -0.2F, -1)}) {
                             Lamp lamp;
                             lamp.type = Lamp::Type::point;
                             lamp.position = turn * (14.0F * glm::normalize(direction));
                             lamp.intensity = vec3(1000.0F);
                             scene.lamps.push_back(lamp);
                         }
                     }),
               GetParam().lampLimit);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadowLeak,
                         testing::Values(LeakCase{0, "hard", 5000, 2500}, LeakCase{0, "pcf", 5000, 2500},
                                         LeakCase{0, "pcss", 5000, 2500}, LeakCase{1, "pcss", 5000, 250},
                                         LeakCase{2, "pcss", 5000, 300}),
                         [](const auto& c) {
                             return fmt::format("{}_{}", sealedScenes()[c.param.scene].name, c.param.filter);
                         });

}  // namespace
}  // namespace reflet::test::shadow_leak_test
