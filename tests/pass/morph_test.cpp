// Morph targets in frames: exact motion vectors, and frames at a time against the reference and a static scene.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"

#include <cmath>
#include <functional>

namespace reflet::test::morph_test {
namespace {

constexpr uvec2 size(96, 54);
const std::vector<std::string> plainly{"diffuse.rays=0", "specular.rays=0"};

View viewAt(double time) {
    View view;
    view.camera = builtin::camera("", {0, 0, 3}, {0, 0, 0}, 50);
    view.environment.radiance = vec3(1.0F);
    view.time = time;
    return view;
}

void setDeltas(Mesh& mesh, uint32_t targets, const std::function<MorphDelta(uint32_t, const vec3&)>& deltaOf) {
    mesh.morph.targets.assign(targets, Aabb{vec3(0.0F), vec3(0.0F)});
    for (const vec3& p : mesh.positions) {
        mesh.morph.vertices.push_back({static_cast<uint32_t>(mesh.morph.deltas.size()), targets});
        for (uint32_t t = 0; t < targets; ++t) {
            mesh.morph.deltas.push_back(deltaOf(t, p));
            mesh.morph.deltas.back().target = t;
            mesh.morph.targets[t].add(mesh.morph.deltas.back().position);
        }
    }
}

/// From no weight to all of it in 1 s, and back in another.
void animate(Scene& scene, uint32_t targets) {
    scene.nodes.resize(std::max<size_t>(scene.nodes.size(), 1));
    scene.instances[0].node = 0;
    scene.instances[0].weights.assign(targets, 0.0F);
    Channel channel{.target = Channel::Target::weights, .times = {0.0F, 1.0F, 2.0F}, .values = {}, .weights = {}};
    for (const float weight : {0.0F, 1.0F, 0.0F}) {
        channel.weights.insert(channel.weights.end(), targets, weight);
    }
    scene.animations.push_back({"morph", {channel}});
}

/// A wall across the view. Target 0 moves it by (0.5, 0.25, 0), target 1 shears it by a fifth of x along z.
Scene shearedWall() {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::patch({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {3, 3}, {}}));
    setDeltas(scene.meshes[0], 2, [](uint32_t target, const vec3& p) {
        return MorphDelta{.position = target == 0 ? vec3(0.5F, 0.25F, 0) : vec3(0, 0, 0.2F * p.x)};
    });
    animate(scene, 2);
    return scene;
}

vec2 uvOf(const vec3& p) {
    const glm::dvec4 clip = glm::dmat4(makeViewParams(viewAt(0).camera, size, 0, 0).worldToClip) * glm::dvec4(p, 1.0);
    return 0.5 + 0.5 * glm::dvec2(clip) / clip.w;
}

TEST(Morph, MotionVectorsAreThoseOfTheMorphedVertices) {
    const float now = 0.75F;
    const float before = 0.5F;
    const Pictures p =
        renderMoved(shearedWall(), viewAt(before), viewAt(now), size, settingsOf(plainly), {"motion", "depth"});
    float largest = 0.0F;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            ASSERT_TRUE(p.hasSurface(x, y));
            const vec3 here = p.position(x, y);
            const vec3 atRest = vec3(here.x, here.y, 0) - now * vec3(0.5F, 0.25F, 0);
            EXPECT_NEAR(here.z, 0.2F * now * atRest.x, 1e-4F) << x << ", " << y;
            const vec3 was = atRest + before * vec3(0.5F, 0.25F, 0.2F * atRest.x);
            const vec2 expected = uvOf(here) - uvOf(was);
            for (unsigned c = 0; c < 2; ++c) {
                ASSERT_NEAR(p.value("motion", x, y, c), expected[int(c)], 2e-5F + std::abs(expected[int(c)]) * 0x1p-10F)
                    << x << ", " << y;
            }
            largest = std::max(largest, glm::length(expected));
        }
    }
    EXPECT_GT(largest, 0.04F);
    expectSilentValidation("a morphed wall");
}

// The left wall stands; the right one is morphed by (0, 0.5, 0), and its joint moves it by as much again.
TEST(Morph, ASkinMovesWhatIsMorphed) {
    Scene scene =
        sceneOf(lambertMaterial(vec3(0.5F)), builtin::patch({{-5, 0, 0}, {4.9F, 0, 0}, {0, 9, 0}, {1, 1}, {}}));
    Mesh& mesh = scene.meshes[0];
    const size_t left = mesh.positions.size();
    builtin::append(mesh, builtin::patch({{5, 0, 0}, {4.9F, 0, 0}, {0, 9, 0}, {1, 1}, {}}), mat4(1.0F));
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.addSkin(std::array{JointWeight{i < left ? 0U : 1U, 1.0F}});
    }
    setDeltas(mesh, 1,
              [](uint32_t, const vec3& p) { return MorphDelta{.position = p.x > 0 ? vec3(0, 0.5F, 0) : vec3(0)}; });
    scene.nodes.resize(2);
    scene.skins.push_back({{0, 1}, {mat4(1.0F), mat4(1.0F)}});
    scene.instances[0].skin = 0;
    animate(scene, 1);
    scene.animations[0].channels.push_back({.node = 1,
                                            .target = Channel::Target::translation,
                                            .times = {0.0F, 1.0F},
                                            .values = {vec4(0), vec4(0, 0.5F, 0, 0)},
                                            .weights = {}});
    const Pictures p = renderMoved(scene, viewAt(0.25), viewAt(0.5), size, settingsOf(plainly), {"motion", "depth"});
    const vec2 expected = uvOf({1, 0.25F, 0}) - uvOf({1, 0, 0});
    for (unsigned y = 0; y < size.y; ++y) {
        for (const unsigned x : {20U, 70U}) {
            ASSERT_TRUE(p.hasSurface(x, y));
            EXPECT_NEAR(p.value("motion", x, y, 1), x < 48 ? 0.0F : expected.y, 1e-4F) << x << ", " << y;
        }
    }
    expectSilentValidation("a morphed and skinned wall");
}

/// A floor that rises to waves, whose normals and tangents follow, before a blue wall.
Scene waves() {
    Mesh floor = builtin::patch({{0, -0.5F, 0}, {2, 0, 0}, {0, 0, -2}, {40, 40}, {}});
    setDeltas(floor, 1, [](uint32_t, const vec3& p) {
        const float slope = 0.6F * std::cos(3.0F * p.x);
        return MorphDelta{
            .position = {0, 0.2F * std::sin(3.0F * p.x), 0}, .normal = {-slope, 0, 0}, .tangent = {0, slope, 0}};
    });
    Scene scene = sceneOf(lambertMaterial(vec3(0.8F, 0.6F, 0.4F)), std::move(floor));
    scene.materials[0].metallic = 0.9F;
    scene.materials[0].roughness = 0.3F;
    scene.meshes.push_back(builtin::patch({{0, 0, -1.5F}, {2, 0, 0}, {0, 2, 0}, {1, 1}, {}}));
    scene.meshes.back().material = 1;
    scene.materials.push_back(lambertMaterial(vec3(0.1F, 0.2F, 0.9F)));
    scene.instances.push_back({"wall", 1, mat4(1.0F)});
    animate(scene, 1);
    return scene;
}

TEST(Morph, TheRendererShowsTheReferencesDepthAndNormals) {
    const Scene scene = waves();
    const View view = viewAt(0.8);
    const ReferencePicture truth =
        traceReference(scene, view, size, {.bounces = 0, .samples = 4, .filter = PixelFilter::center});
    const Pictures p = render(scene, view, size, settingsOf(plainly), {"depth", "normal"});
    size_t same = 0;
    size_t alike = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const size_t i = size_t(y) * size.x + x;
            const float d = truth.depth.data[i];
            same += std::abs(p.value("depth", x, y) - d) <= 1e-4F + 1e-3F * d ? 1 : 0;
            const vec3 normal(truth.normal.data[3 * i], truth.normal.data[3 * i + 1], truth.normal.data[3 * i + 2]);
            alike += glm::distance(p.color("normal", x, y), normal) < 0.01F ? 1 : 0;
        }
    }
    EXPECT_GT(same, truth.depth.data.size() * 98 / 100);
    EXPECT_GT(alike, truth.depth.data.size() * 98 / 100);
    const Pictures flat = render(scene, viewAt(0.0), size, settingsOf(plainly), {"depth"});
    EXPECT_LT(compareImages(p.images.at("depth"), flat.images.at("depth"), {}).difference.psnr, 40.0) << "it rose";
}

TEST(Morph, AFrameWithRayTracingIsThatOfASceneThatStandsThere) {
    const Scene scene = waves();
    const Settings settings = settingsOf({"diffuse.rays=1", "specular.rays=1", "trace_scene.enabled=true",
                                          "trace_screen.enabled=false", "shadow.resolution=512"});
    const Pictures moved = render(scene, viewAt(0.8), size, settings, {"final", "depth"});
    const Pictures stood = render(frozen(scene, 0.8), viewAt(0.8), size, settings, {"final", "depth"});
    EXPECT_GT(compareImages(moved.images.at("depth"), stood.images.at("depth"), {}).difference.psnr, 60.0);
    EXPECT_GT(compareImages(moved.images.at("final"), stood.images.at("final"), {}).difference.psnr, 40.0);
    expectSilentValidation("morphed waves");
}

}  // namespace
}  // namespace reflet::test::morph_test
