// White metals in an environment of radiance 1 are invisible, and shading normals that face away are not black.
#include "pass/harness.h"
#include "reference/reference.h"
#include "scene/builtin/shapes.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::furnace_test {
namespace {

constexpr uvec2 size(60, 34);

Material whiteMetal(float roughness) {
    Material m = lambertMaterial(vec3(1.0F));
    m.metallic = 1.0F;
    m.roughness = roughness;
    return m;
}

View whiteView(const vec3& position, const vec3& target) {
    View view;
    view.camera.position = position;
    view.camera.target = target;
    view.sun.irradiance = vec3(0.0F);
    view.environment.radiance = vec3(1.0F);
    return view;
}

struct Spread {
    double mean = 0.0;
    double deviation = 0.0;
};

Spread spreadOf(const Pictures& p) {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (p.hasSurface(x, y)) {
                const double value = p.value("final", x, y);
                sum += value;
                squares += value * value;
                count += 1.0;
            }
        }
    }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0))};
}

// One ray per pixel: what varies is its weight alone.
TEST(Furnace, RaysOfRoughMetalsHardlyDifferInTheirWeight) {
    for (const float roughness : {0.3F, 0.6F, 1.0F}) {
        const Scene scene = sceneOf(whiteMetal(roughness), builtin::sphere(1.0F, 48));
        const Pictures p = render(scene, whiteView({0, 0, 4}, {0, 0, 0}), size,
                                  settingsOf({"diffuse.rays=0", "trace_screen.enabled=false"}), {"final", "depth"});
        const Spread s = spreadOf(p);
        EXPECT_NEAR(s.mean, 1.0, 0.02) << roughness;
        EXPECT_LT(s.deviation, 0.25) << roughness;
    }
    expectSilentValidation("furnace");
}

// Many rays pass behind the neighbour, whose far side the screen does not show.
TEST(Furnace, WhatTheScreenDoesNotShowIsNotBlack) {
    Scene scene = sceneOf(whiteMetal(0.2F), builtin::sphere(0.48F, 48));
    scene.instances.push_back(scene.instances.front());
    scene.instances[0].objectToWorld = builtin::at({-0.5F, 0, 0});
    scene.instances[1].objectToWorld = builtin::at({0.5F, 0, 0});
    const Pictures p = render(
        scene, whiteView({0, 0, 3}, {0, 0, 0}), size,
        settingsOf({"specular.rays=4", "trace_screen.light=previous", "trace_screen.thickness_mode=second_layer"}),
        {"final", "depth"}, 8);
    EXPECT_NEAR(spreadOf(p).mean, 1.0, 0.04);
}

// A floor whose normals lean away from the viewer.
TEST(Furnace, NormalsThatFaceAwayReflectAsInTheReference) {
    Scene scene = sceneOf(lambertMaterial(vec3(0.0F)), builtin::ground({20.0F, 20.0F}, {1, 1}, {1.0F, 1.0F}));
    scene.materials[0].roughness = 0.0F;
    for (VertexAttributes& v : scene.meshes[0].attributes) {
        v.normal = glm::normalize(vec3(0, 1, -1));
    }
    View view = whiteView({0, 1, 4}, {0, 0, 0});
    view.camera.fovY = glm::radians(10.0F);
    const ReferencePicture truth = traceReference(scene, view, size, {.samples = 64});
    const Pictures p = render(scene, view, size, settingsOf({}), {"final", "depth"});
    double expected = 0.0;
    for (size_t i = 0; i < truth.final.data.size(); i += truth.final.channels.size()) {
        expected += truth.final.data[i] / (double(size.x) * size.y);
    }
    EXPECT_GT(expected, 0.05);
    EXPECT_NEAR(spreadOf(p).mean, expected, 0.05 * expected);
}

}  // namespace
}  // namespace reflet::test::furnace_test
