// Ray tracing as a source: off-screen hits, energy, limits, and the transition from the screen.
#include "pass/harness.h"
#include "scene/builtin.h"

#include <functional>

namespace reflet::test::trace_scene_test {
namespace {

constexpr uvec2 size(160, 90);

Material mirrorMaterial() {
    Material mirror = lambertMaterial(vec3(1.0F));
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    return mirror;
}

View viewFrom(const vec3& position, const vec3& target) {
    View view;
    view.camera = builtin::camera("eye", position, target, 50.0F);
    return view;
}

void placeWall(Scene& scene, const Material& material, const builtin::Patch& patch) {
    builtin::place(scene, "wall", builtin::addMaterial(scene, material), builtin::patch(patch));
}

double meanOf(const Pictures& p, const std::string& show, const std::function<bool(unsigned, unsigned)>& counts,
              unsigned channel = 0) {
    double sum = 0.0;
    unsigned count = 0;
    for (unsigned y = 0; y < p.size.y; ++y) {
        for (unsigned x = 0; x < p.size.x; ++x) {
            if (counts(x, y)) {
                sum += p.value(show, x, y, channel);
                ++count;
            }
        }
    }
    EXPECT_GT(count, 0U);
    return sum / count;
}

bool everywhere(unsigned /*x*/, unsigned /*y*/) {
    return true;
}

// A mirror that fills the picture, and a wall behind the camera that glows.
Scene wallBehindTheCamera(const Material& wall) {
    Scene scene;
    placeWall(scene, mirrorMaterial(), {{0, 0, -2}, {6, 0, 0}, {0, 6, 0}});
    placeWall(scene, wall, {{0, 0, 6}, {-20, 0, 0}, {0, 20, 0}});
    return scene;
}

TEST(TraceScene, AMirrorShowsTheWallBehindTheCamera) {
    Material red = lambertMaterial(vec3(0.0F));
    red.emissive = {0.8F, 0.2F, 0.1F};
    const Scene scene = wallBehindTheCamera(red);
    const View view = viewFrom({0, 0, 2}, {0, 0, 0});
    const std::vector<std::string> shows{"indirect_specular", "specular_source", "specular_hit_distance"};
    const Pictures without = render(scene, view, size, settingsOf({"trace_screen.count_hits=on"}), shows);
    EXPECT_EQ(rangeOf(without.images.at("indirect_specular")).max, 0.0F);
    EXPECT_EQ(rangeOf(without.images.at("specular_hit_distance")).max, 0.0F) << "no ray hits anything";
    const Pictures p =
        render(scene, view, size, settingsOf({"trace_scene.enabled=on", "trace_screen.count_hits=on"}), shows);
    for (const uvec2 at : {uvec2(80, 45), uvec2(3, 3), uvec2(156, 86)}) {
        EXPECT_NEAR(p.value("indirect_specular", at.x, at.y, 0), 0.8F, 0.01F);
        EXPECT_NEAR(p.value("indirect_specular", at.x, at.y, 1), 0.2F, 0.01F);
        EXPECT_NEAR(p.value("specular_source", at.x, at.y, 0), 0.95F, 0.01F);  // yellow: the scene
    }
    EXPECT_NEAR(p.value("specular_hit_distance", 80, 45), 8.0F, 0.02F);
    expectSilentValidation("a wall behind the camera");
}

TEST(TraceScene, RaysGoThroughWhatIsCutOut) {
    builtin::Canvas canvas("half", 64, 64, 0xFFFFFF);
    canvas.rectangle({0, 0, 32, 64}, 0xFFFFFF, 0);
    Material sieve = lambertMaterial(vec3(0.0F));
    sieve.emissive = {0, 1, 0};
    sieve.alphaCutoff = 0.5F;
    Scene scene = wallBehindTheCamera(lambertMaterial(vec3(1.0F)));
    scene.materials[1].emissive = {1, 0, 0};
    scene.materials[1].baseColor = {0, 0, 0, 1};
    sieve.baseColorTexture = builtin::addTexture(scene, canvas.finish());
    placeWall(scene, sieve, {{0, 0, 5}, {-20, 0, 0}, {0, 20, 0}});  // its left half, from the front: at +x
    const Pictures p = render(scene, viewFrom({0, 0, 2}, {0, 0, 0}), size, settingsOf({"trace_scene.enabled=on"}),
                              {"indirect_specular"});
    EXPECT_NEAR(p.value("indirect_specular", 150, 45, 0), 1.0F, 0.01F);
    EXPECT_NEAR(p.value("indirect_specular", 150, 45, 1), 0.0F, 0.01F);
    EXPECT_NEAR(p.value("indirect_specular", 10, 45, 0), 0.0F, 0.01F);
    EXPECT_NEAR(p.value("indirect_specular", 10, 45, 1), 1.0F, 0.01F);
    expectSilentValidation("cut out");
}

// Half of it emits toward the camera: the emitter is closed, double-sided, and reflects half of the incident light.
TEST(TraceScene, APathInAGlowingRoomOfAlbedoOneHalfFindsTwiceTheGlow) {
    Material half = lambertMaterial(vec3(0.5F));
    half.emissive = vec3(0.5F);
    half.doubleSided = true;
    const Scene scene = sceneOf(half, builtin::box({2, 2, 2}));
    const Pictures p = render(scene, viewFrom({0.3F, 0.2F, 1.5F}, {0, 0, 0}), {60, 34},
                              settingsOf({"trace_scene.enabled=on", "trace_scene.light=path", "trace_scene.bounces=64",
                                          "trace_screen.enabled=off", "materials.lambert_only=on", "diffuse.rays=8"}),
                              {"final"});
    EXPECT_NEAR(meanOf(p, "final", everywhere), 1.0, 0.005);
}

class SceneFurnace : public testing::TestWithParam<float> {};

TEST_P(SceneFurnace, StaysAsBrightWithTheSceneAsASource) {
    Material material = lambertMaterial(vec3(1.0F));
    material.roughness = GetParam();
    const Scene scene = sceneOf(material, builtin::sphere(1.0F, 96));
    View view = viewFrom({0, 0, 4}, {0, 0, 0});
    view.environment.radiance = vec3(1.0F);
    const std::vector<std::string> off{"specular.rays=16"};
    const std::vector<std::string> on{"specular.rays=16", "trace_scene.enabled=on"};
    const Pictures without = render(scene, view, {80, 45}, settingsOf(off), {"final", "depth"});
    const Pictures with = render(scene, view, {80, 45}, settingsOf(on), {"final", "depth"});
    const auto surface = [&](unsigned x, unsigned y) { return with.hasSurface(x, y); };
    EXPECT_NEAR(meanOf(with, "final", surface), meanOf(without, "final", surface), 0.005);
    EXPECT_NEAR(meanOf(with, "final", surface), 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Roughness, SceneFurnace, testing::Values(0.0F, 0.5F, 1.0F));

// Over 5 s: many budgets of rays in a scene with a large BVH.
TEST(TraceScene, AnswersAsManyRaysAsItMayEvenlyOverThePicture) {
    const Scene scene = findBuiltinScene("cornell")->make();
    const auto confidence = [&](const char* thousands) {
        return render(scene, defaultView(scene), size,
                      settingsOf({"trace_scene.enabled=on", "trace_screen.enabled=off", "diffuse.rays=4",
                                  "specular.rays=0", std::string("trace_scene.max_rays=") + thousands}),
                      {"diffuse_confidence"});
    };
    const auto inside = [](unsigned x, unsigned /*y*/) { return x >= 40 && x < 120; };  // the room is closed there
    const double all = meanOf(confidence("1000"), "diffuse_confidence", inside);
    EXPECT_GT(all, 0.7);
    EXPECT_EQ(meanOf(confidence("0"), "diffuse_confidence", everywhere), 0.0);
    const Pictures quarter = confidence("14");
    const double share = meanOf(quarter, "diffuse_confidence", inside) / all;
    EXPECT_NEAR(share, 14000.0 / (4 * size.x * size.y), 0.02);  // as far as every pixel has rays
    for (unsigned top = 0; top + 15 <= size.y; top += 15) {
        for (unsigned left = 40; left < 120; left += 16) {
            const auto block = [&](unsigned x, unsigned y) {
                return x >= left && x < left + 16 && y >= top && y < top + 15;
            };
            const double whole = meanOf(confidence("1000"), "diffuse_confidence", block);
            EXPECT_NEAR(meanOf(quarter, "diffuse_confidence", block), share * whole, 0.06) << left << ", " << top;
            break;  // of each row the first: rendering again is what takes time
        }
    }
}

// The floor is a mirror, the wall behind it ends above the picture: lower in the picture, the mirror shows what is off
// screen.
TEST(TraceScene, NoSeamShowsInAMirrorWhereRayTracingTakesOverFromTheScreen) {
    Scene scene;
    builtin::place(scene, "floor", builtin::addMaterial(scene, mirrorMaterial()),
                   builtin::ground({4, 4}, {1, 1}, {1, 1}));
    Mesh wall = builtin::patch({{0, 6, -4}, {9, 0, 0}, {0, 6, 0}, {1, 24}});
    for (size_t i = 0; i < wall.positions.size(); ++i) {
        const float height = wall.positions[i].y / 12.0F;
        wall.attributes[i].color = builtin::vertexColor({0.2F + 0.7F * height, 0.9F - 0.6F * height, 0.5F});
    }
    builtin::place(scene, "wall", builtin::addMaterial(scene, lambertMaterial(vec3(1.0F))), std::move(wall));
    View view = viewFrom({0, 1.5F, 5}, {0, 0.4F, 0});
    // Along the floor, which so casts no caustic onto the wall: rays through the scene know no light of two bounces.
    view.sun = builtin::sun(glm::normalize(vec3(0.3F, 0.0F, -1.0F)), vec3(3.0F));
    for (const char* light : {"direct", "lit"}) {
        const Pictures p = render(scene, view, size,
                                  settingsOf({"trace_scene.enabled=on", std::string("trace_screen.light=") + light,
                                              "diffuse.rays=4", "trace_scene.reuse_screen=off"}),
                                  {"specular_radiance", "specular_source", "metallic"});
        const Range range = rangeOf(p.images.at("specular_radiance"));
        unsigned handOvers = 0;
        for (unsigned x = 20; x < 140; x += 4) {
            for (unsigned y = 30; y + 1 < size.y; ++y) {
                const bool fromScreen = p.value("specular_source", x, y, 0) < 0.3F;  // green, not yellow
                const bool nextFromScreen = p.value("specular_source", x, y + 1, 0) < 0.3F;
                const bool inMirror = p.value("metallic", x, y) > 0.5F && p.value("metallic", x, y + 1) > 0.5F;
                if (inMirror && fromScreen != nextFromScreen && p.value("specular_radiance", x, y) > 0.0F &&
                    p.value("specular_radiance", x, y + 1) > 0.0F) {
                    ++handOvers;
                    for (unsigned c = 0; c < 3; ++c) {
                        EXPECT_NEAR(p.value("specular_radiance", x, y, c), p.value("specular_radiance", x, y + 1, c),
                                    0.02F * 1.0F)
                            << light << " at " << x << ", " << y;
                    }
                }
            }
        }
        EXPECT_GT(handOvers, 20U) << light;
        EXPECT_GT(range.max, 0.3F);
    }
}

TEST(TraceScene, TheSunsMapGivesTheLightThatShadowRaysGive) {
    const Scene scene = findBuiltinScene("cubes")->make();
    const auto mean = [&](const char* shadows) {
        const Pictures p = render(
            scene, defaultView(scene), {80, 45},
            settingsOf({"trace_scene.enabled=on", "trace_screen.enabled=off", "specular.rays=0", "diffuse.rays=8",
                        "trace_scene.reuse_screen=off", std::string("trace_scene.shadows=") + shadows}),
            {"indirect_diffuse"});
        return meanOf(p, "indirect_diffuse", everywhere);
    };
    const double rays = mean("ray");
    EXPECT_GT(rays, 0.005);
    EXPECT_NEAR(mean("map"), rays, 0.04 * rays);
    expectSilentValidation("the sun's map");
}

}  // namespace
}  // namespace reflet::test::trace_scene_test
