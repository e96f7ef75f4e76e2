// Blended surfaces: exact compositing of emissive panes in any order, cost only where there are any, and light, shadows
// and reflections against the path tracer.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet::test::blend_test {
namespace {

using builtin::at;
using builtin::turned;

constexpr uvec2 size(66, 48);

struct Look {
    vec3 color{0.0F};  // linear base colour
    vec3 emissive{0.0F};
    float alpha = 1.0F;
    float roughness = 1.0F;
};

Material material(const Look& look) {
    Material m;
    m.baseColor = vec4(look.color, look.alpha);
    m.emissive = look.emissive;
    m.roughness = look.roughness;
    m.metallic = 0.0F;
    m.doubleSided = true;
    m.blended = look.alpha < 1.0F;
    m.alphaCutoff = m.blended ? blendCutoff : 0.0F;
    return m;
}

Mesh wall(float halfSize) {
    return builtin::patch({.right = {halfSize, 0, 0}, .up = {0, halfSize, 0}});
}

void add(Scene& scene, const Look& look, Mesh mesh, const mat4& objectToWorld) {
    const std::string name = fmt::format("{}", scene.instances.size());
    builtin::place(scene, name, builtin::addMaterial(scene, material(look)), std::move(mesh), objectToWorld);
}

// Straight ahead along -Z, without any light.
View darkView() {
    View view;
    view.camera.position = {0, 0, 5};
    return view;
}

Look light(const vec3& emissive, float alpha = 1.0F) {
    return {.color = vec3(0), .emissive = emissive, .alpha = alpha};
}

// Black surfaces that emit: no other light, so that the picture is exact. Without specular lobes.
const std::vector<std::string> emission{"materials.lambert_only=true", "diffuse.rays=0", "specular.rays=0"};

vec3 centerOf(const Scene& scene, std::vector<std::string> more = {}) {
    more.insert(more.end(), emission.begin(), emission.end());
    const Pictures p = render(scene, darkView(), size, settingsOf(more), {"final"});
    expectSilentValidation("panes");
    return p.color("final", size.x / 2, size.y / 2);
}

void expectColor(const vec3& actual, const vec3& expected, const std::string& what) {
    for (int i = 0; i < 3; ++i) {
        // Half floats, and emissive colours of 6 bits.
        EXPECT_NEAR(actual[i], expected[i], 2e-3F * std::max(expected[i], 0.1F)) << what << ", channel " << i;
    }
}

TEST(Blend, APaneOfAlphaIsMixedWithTheColorBehind) {
    const vec3 behind(1, 0.5F, 0.25F);
    const vec3 pane(0.25F, 2, 1);
    for (const float alpha : {0.125F, 0.5F, 0.875F}) {
        Scene scene;
        add(scene, light(behind), wall(9), at({0, 0, -2}));
        add(scene, light(pane, alpha), wall(9), at({0, 0, 0}));
        expectColor(centerOf(scene), alpha * pane + (1 - alpha) * behind, fmt::format("alpha {}", alpha));
    }
    Scene sky;
    add(sky, light(pane, 0.5F), wall(9), at({0, 0, 0}));
    expectColor(centerOf(sky), 0.5F * pane, "before the sky");
    Scene hidden;
    add(hidden, light(behind), wall(9), at({0, 0, 1}));
    add(hidden, light(pane, 0.5F), wall(9), at({0, 0, 0}));
    expectColor(centerOf(hidden), behind, "hidden by an opaque surface");
}

TEST(Blend, TheNearerPaneIsInFrontInAnyOrderOfDrawing) {
    const vec3 near = 0.25F * vec3(0, 4, 0);
    const vec3 expected = near + 0.75F * (0.5F * vec3(4, 0, 0) + 0.5F * vec3(0, 0, 4));
    for (const bool nearFirst : {false, true}) {
        Scene scene;
        add(scene, light({0, 0, 4}), wall(9), at({0, 0, -2}));
        for (const bool isNear : {nearFirst, !nearFirst}) {
            add(scene, isNear ? light({0, 4, 0}, 0.25F) : light({4, 0, 0}, 0.5F), wall(9), at({0, 0, isNear ? 1 : 0}));
        }
        expectColor(centerOf(scene), expected, nearFirst ? "near first" : "far first");
    }
}

TEST(Blend, PanesThatIntersectAreRightOnBothSides) {
    Scene scene;
    add(scene, light({0, 0, 4}), wall(9), at({0, 0, -8}));
    add(scene, light({4, 0, 0}, 0.5F), wall(9), turned(45));
    add(scene, light({0, 4, 0}, 0.5F), wall(9), turned(-45));
    const Pictures p = render(scene, darkView(), size, settingsOf(emission), {"final"});
    // Turned by 45 degrees about +Y, the left half of a wall comes nearer.
    expectColor(p.color("final", 16, size.y / 2), {2, 1, 1}, "left");
    expectColor(p.color("final", 48, size.y / 2), {1, 2, 1}, "right");
}

TEST(Blend, AsManyLayersAsAreAskedForAreBlendedTheNearestFirst) {
    Scene scene;
    add(scene, light(vec3(0, 0, 4)), wall(9), at({0, 0, -2}));
    for (int i = 0; i < 3; ++i) {
        add(scene, light(vec3(4, 0, 0) / float(1 << i), 0.5F), wall(9), at({0, 0, i}));
    }
    expectColor(centerOf(scene), {0.5F + 0.5F + 0.5F, 0, 0.5F}, "all three");
    expectColor(centerOf(scene, {"blend.layers=2"}), {0.5F + 0.5F, 0, 1}, "two");
    expectColor(centerOf(scene, {"blend.layers=0"}), {1, 0, 0}, "as masked with a cutoff of 0.5");
}

// A pane in front of a box on a floor, under a sky and a sun.
Scene lit(float alpha) {
    Scene scene;
    add(scene, {.color = vec3(0.6F)}, builtin::ground({6, 6}, {1, 1}, {1, 1}), at({0, -1, 0}));
    add(scene, {.color = {0.1F, 0.6F, 0.2F}}, builtin::box(vec3(0.5F)), at({0.4F, -0.5F, -1}));
    add(scene, {.color = {0.8F, 0.2F, 0.1F}, .alpha = alpha, .roughness = 0.3F}, wall(0.8F), at({-0.3F, -0.1F, 0.5F}));
    return scene;
}

View daylight() {
    View view = darkView();
    view.camera.position = {0.5F, 0.8F, 4};
    view.camera.target = {0, -0.4F, 0};
    view.environment.radiance = {0.5F, 0.7F, 1};
    view.sun.direction = glm::normalize(vec3(0.6F, -1, -0.7F));
    view.sun.irradiance = vec3(3);
    return view;
}

double errorOf(const Settings& settings, const FloatImage& truth, const Scene& scene) {
    const Pictures p = render(scene, daylight(), size, settings, {"final"});
    expectSilentValidation("a lit pane");
    return compareImages(p.images.at("final"), truth, {}).difference.relativeMse;
}

TEST(Blend, ALitPaneIsThatOfTheReference) {
    const Scene scene = lit(0.4F);
    ReferenceOptions options;
    options.samples = 128;
    options.filter = PixelFilter::center;
    const FloatImage truth = traceReference(scene, daylight(), size, options).final;
    const double maps = errorOf(settingsOf({"diffuse.rays=16", "specular.rays=16"}), truth, scene);
    const double rays =
        errorOf(settingsOf({"diffuse.rays=16", "specular.rays=16", "trace_scene.enabled=true", "trace_scene.light=path",
                            "trace_screen.enabled=false", "shadow.filter=traced", "shadow.rays=16"}),
                truth, scene);
    const double masked = errorOf(settingsOf({"diffuse.rays=16", "specular.rays=16", "blend.layers=0"}), truth, scene);
    RecordProperty("maps", std::to_string(maps));
    RecordProperty("rays", std::to_string(rays));
    RecordProperty("masked", std::to_string(masked));
    EXPECT_LT(maps, 0.01);
    EXPECT_LT(rays, 0.005);
    EXPECT_GT(masked, 5 * maps) << "the pane matters";
}

TEST(Blend, ThePaneTakesItsShareOfTheSun) {
    Scene scene;
    add(scene, {.color = vec3(0.5F)}, builtin::ground({6, 6}, {1, 1}, {1, 1}), at({0, -1, 0}));
    View view = darkView();
    view.camera.position = {0, 0, 2};
    view.camera.target = {0, -1, 0};
    view.sun.direction = {0, -1, 0};
    view.sun.irradiance = vec3(3);
    const auto seen = [&](const char* layers) {
        return render(scene, view, size, settingsOf({"diffuse.rays=0", "specular.rays=0", layers}), {"direct"})
            .value("direct", 33, 24);
    };
    const float whole = seen("blend.layers=4");
    // Above the camera, so that it sees only their shadows. The upper one is found by peeling the lower one.
    const mat4 lying = turned(-90, {1, 0, 0});
    add(scene, {.alpha = 0.25F}, wall(3), at({0, 2, 0}) * lying);
    EXPECT_NEAR(seen("blend.layers=4"), 0.75F * whole, 0.01F * whole);
    add(scene, {.alpha = 0.5F}, wall(3), at({0, 3, 0}) * lying);
    EXPECT_NEAR(seen("blend.layers=4"), 0.75F * 0.5F * whole, 0.01F * whole);
    EXPECT_NEAR(seen("blend.layers=0"), 0.0F, 0.01F * whole) << "as masked: alpha of 0.5 casts a whole shadow";
}

TEST(Blend, AMirrorShowsThePaneInFrontOfTheWall) {
    Scene scene;
    add(scene, light({4, 4, 4}), wall(3), at({0, 0, -2}));
    add(scene, light({4, 0, 0}, 0.5F), wall(3), at({0, 0, -1.5F}));
    Look mirror{.color = vec3(1), .roughness = 0};
    Material silver = material(mirror);
    silver.metallic = 1;
    builtin::place(scene, "mirror", builtin::addMaterial(scene, silver), builtin::ground({3, 3}, {1, 1}, {1, 1}),
                   at({0, -1, 0}));
    for (const char* source : {"planar.enabled=false", "planar.enabled=true"}) {
        const Pictures p = render(scene, darkView(), size, settingsOf({"diffuse.rays=0", source}), {"final"});
        expectSilentValidation(source);
        const vec3 straight = p.color("final", 33, 20);
        const vec3 mirrored = p.color("final", 33, 36);
        EXPECT_LT(glm::distance(straight, vec3(4, 2, 2)), 0.2F) << source;
        EXPECT_LT(glm::distance(mirrored, straight), 0.2F) << source << ' ' << mirrored.x << ' ' << mirrored.y;
    }
}

TEST(Blend, OpaqueScenesRecordNothingOfIt) {
    Scene scene;
    add(scene, light({1, 1, 1}), wall(1), at({0, 0, 0}));
    const auto blends = [](const Scene& s) {
        const auto names = passNames(s, darkView(), size, settingsOf(emission));
        return std::ranges::count_if(names, [](const auto& n) { return n.find("blend") != std::string::npos; });
    };
    EXPECT_EQ(blends(scene), 0);
    add(scene, light({1, 1, 1}, 0.5F), wall(1), at({0, 0, 100}));
    EXPECT_EQ(blends(scene), 0) << "behind the camera";
    add(scene, light({1, 1, 1}, 0.5F), wall(1), at({0, 0, 1}));
    EXPECT_GT(blends(scene), 0);
}

}  // namespace
}  // namespace reflet::test::blend_test
