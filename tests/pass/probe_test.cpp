// Local probes: captures and reflections against the path tracer, blending, energy.
#include "pass/probe_room.h"

#include "compare/compare.h"
#include "reference/reference.h"
#include "renderer/probe/capture_probe.h"
#include "scene/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet::test::probe_test {
namespace {

float at(const FloatImage& image, unsigned x, unsigned y, unsigned channel) {
    return image.data[(size_t(y) * image.width + x) * image.channels.size() + channel];
}

// Smallest and largest of a value in the pixel and those around it.
struct Around {
    float low = 0.0F;
    float high = 0.0F;
};
Around around(const FloatImage& image, unsigned x, unsigned y, unsigned channel) {
    Around result{at(image, x, y, channel), at(image, x, y, channel)};
    for (unsigned j = std::max(y, 1U) - 1; j <= std::min(y + 1, image.height - 1); ++j) {
        for (unsigned i = std::max(x, 1U) - 1; i <= std::min(x + 1, image.width - 1); ++i) {
            result.low = std::min(result.low, at(image, i, j, channel));
            result.high = std::max(result.high, at(image, i, j, channel));
        }
    }
    return result;
}

// Whether the value of the pixel occurs in the reference, at that pixel or a neighbour, or lies between the values
// there.
bool liesWithinAPixel(const FloatImage& image, const FloatImage& truth, unsigned x, unsigned y) {
    for (unsigned c = 0; c < 3; ++c) {
        const auto [low, high] = around(truth, x, y, c);
        const float value = at(image, x, y, c);
        if (value < 0.98F * low - 0.005F || value > 1.02F * high + 0.005F) {
            return false;
        }
    }
    return true;
}

// The faces of one probe, cut out of the atlas.
FloatImage faceOf(const FloatImage& atlas, unsigned face) {
    const unsigned side = atlas.width / probeFaces;
    FloatImage image{side, side, atlas.channels, {}};
    for (unsigned y = 0; y < side; ++y) {
        for (unsigned x = 0; x < side; ++x) {
            for (unsigned c = 0; c < 3; ++c) {
                image.data.push_back(at(atlas, face * side + side - 1 - x, y, c));  // as the camera saw it
            }
        }
    }
    return image;
}

TEST(Probe, AtItsOwnCentreSeesWhatThePathTracerSees) {
    const Scene scene = findBuiltinScene("mirror-hall")->make();
    View view = defaultView(scene);
    view.sun.angularDiameter = 0.0F;
    view.environment.radiance = vec3(0.0F);  // the atlas has none
    view.probes = {{{{0.2F, 1.6F, 0.9F}, {vec3(-4.0F, 0.0F, -6.0F), vec3(4.0F, 4.0F, 6.0F)}}}};
    const Pictures p = render(scene, view, {16, 16},
                              probeSettings({"probes.bounces=0", "probes.resolution=128", "materials.anisotropy=16"}),
                              {"probe_atlas"});
    ReferenceOptions options;
    options.bounces = 0;
    options.samples = 4;
    options.filter = PixelFilter::center;
    for (unsigned face = 0; face < probeFaces; ++face) {
        const FloatImage seen = faceOf(p.images.at("probe_atlas"), face);
        view.camera = cubeFaceCamera(view.probes->front(), face);
        const FloatImage truth = traceReference(scene, view, {seen.width, seen.height}, options).final;
        std::vector<bool> smooth;
        unsigned displaced = 0;
        for (unsigned y = 0; y < seen.height; ++y) {
            for (unsigned x = 0; x < seen.width; ++x) {
                const Around green = around(truth, x, y, 1);
                smooth.push_back(green.high - green.low < 0.05F * green.high + 0.005F);
                displaced += liesWithinAPixel(seen, truth, x, y) ? 0 : 1;
            }
        }
        const Difference d = compareImages(seen, truth, {.mask = smooth}).difference;
        EXPECT_GT(d.pixels, seen.width * seen.height / 4) << face;
        EXPECT_LT(d.relativeMse, 1e-3) << face;
        EXPECT_LT(displaced, seen.width * seen.height / 40) << face;
        RecordProperty("face" + std::to_string(face), fmt::format("relative MSE {:.2e}, {} texels of {} displaced",
                                                                  d.relativeMse, displaced, seen.width * seen.height));
    }
    expectSilentValidation("captures");
}

struct MirrorCase {
    const char* name;
    bool sphere;
    unsigned least;         ///< pixels of the mirror, away from its edge
    unsigned leastWithout;  ///< displaced ones without parallax
};

class MirrorInARoom : public testing::TestWithParam<MirrorCase> {
protected:
    // Pixels of the mirror whose colour is not within a pixel of its true place, of all that are away from its edge.
    struct Count {
        unsigned displaced = 0;
        unsigned all = 0;
    };
    static Count countDisplaced(const FloatImage& picture, const FloatImage& truth, const FloatImage& metallic) {
        Count count;
        for (unsigned y = 1; y + 1 < picture.height; ++y) {
            for (unsigned x = 1; x + 1 < picture.width; ++x) {
                if (around(metallic, x, y, 0).low > 0.5F) {
                    ++count.all;
                    count.displaced += liesWithinAPixel(picture, truth, x, y) ? 0 : 1;
                }
            }
        }
        return count;
    }
};

// The probe is inside the sphere, which it does not see, or above the plate, which reflects no rays toward the probe.
TEST_P(MirrorInARoom, ShowsTheWallsWithinAPixelOfTheirTruePlaces) {
    constexpr uvec2 size(160, 90);
    const ProbeRoom room{.center = {0.5F, 0, 0}, .half = {2.0F, 1.5F, 2.5F}};
    const vec3 sphereAt(0.2F, -0.3F, -0.8F);
    Scene scene;
    addProbeRoom(scene, room);
    const uint32_t metal = builtin::addMaterial(scene, whiteMetal(0.0F));
    if (GetParam().sphere) {
        builtin::place(scene, "mirror", metal, builtin::sphere(0.6F, 192), builtin::at(sphereAt));
    } else {
        builtin::place(scene, "mirror", metal, builtin::ground({1.2F, 1.2F}, {1, 1}, {1, 1}),
                       builtin::at({0.5F, -1.4F, -0.5F}));
    }
    View view;
    view.camera.position = {0.3F, 0.6F, 2.0F};
    view.camera.target = GetParam().sphere ? sphereAt : vec3(0.4F, -1.4F, -0.5F);
    view.probes = {{probeIn(room, GetParam().sphere ? sphereAt : vec3(1.2F, 0.4F, 0.7F))}};
    ReferenceOptions options;
    options.bounces = 1;
    options.samples = 4;
    options.filter = PixelFilter::center;
    const FloatImage truth = traceReference(scene, view, size, options).indirectSpecular;
    Count with;
    for (const char* parallax : {"probes.parallax=box", "probes.parallax=depth"}) {
        const Pictures corrected =
            render(scene, view, size, probeSettings({"probes.bounces=0", "probes.resolution=256", parallax}),
                   {"indirect_specular", "metallic"});
        const FloatImage& metallic = corrected.images.at("metallic");
        with = countDisplaced(corrected.images.at("indirect_specular"), truth, metallic);
        EXPECT_GT(with.all, GetParam().least);
        EXPECT_EQ(with.displaced, 0U) << parallax << ", of " << with.all;
    }
    const Pictures plain =
        render(scene, view, size, probeSettings({"probes.bounces=0", "probes.resolution=256", "probes.parallax=none"}),
               {"indirect_specular", "metallic"});
    const Count without = countDisplaced(plain.images.at("indirect_specular"), truth, plain.images.at("metallic"));
    EXPECT_GT(without.displaced, GetParam().leastWithout) << "without parallax";
    RecordProperty("displaced",
                   fmt::format("{} of {}; without parallax {}", with.displaced, with.all, without.displaced));
    expectSilentValidation("mirrors");
}

INSTANTIATE_TEST_SUITE_P(Probe, MirrorInARoom,
                         testing::Values(MirrorCase{"sphere", true, 500, 4}, MirrorCase{"plate", false, 2000, 1500}),
                         [](const auto& mirror) { return mirror.param.name; });

// Every material and every kind of look-up, in a room of constant emission. The probe is inside the sphere, so it sees
// nothing else; without bounces, because otherwise it would see the walls reflect one another.
struct FurnaceCase {
    const char* name;
    float roughness;
    float metallic;
    std::vector<std::string> settings;
};

class ProbeFurnace : public testing::TestWithParam<FurnaceCase> {};

double meanOfSphere(const Pictures& p) {
    double sum = 0.0;
    unsigned count = 0;
    for (unsigned y = 0; y < p.size.y; ++y) {
        for (unsigned x = 0; x < p.size.x; ++x) {
            if (p.value("albedo", x, y) > 0.5F) {
                sum += p.value("final", x, y);
                ++count;
            }
        }
    }
    return sum / count;
}

TEST_P(ProbeFurnace, IsAsBrightAsItsWalls) {
    const ProbeRoom room{.half = {2.0F, 1.5F, 2.5F}, .tiles = 1, .radiance = vec3(1.0F)};
    Scene scene;
    addProbeRoom(scene, room);
    Material material = lambertMaterial(vec3(1.0F));
    material.roughness = GetParam().roughness;
    material.metallic = GetParam().metallic;
    builtin::place(scene, "sphere", builtin::addMaterial(scene, material), builtin::sphere(0.7F, 64));
    View view;
    view.camera.position = {0, 0.2F, 2.2F};
    view.camera.target = vec3(0.0F);
    view.probes = {{probeIn(room, vec3(0.0F))}};
    view.environment.radiance = vec3(5.0F);  // must not come in
    std::vector<std::string> assignments{"trace_screen.enabled=false", "probes.enabled=true", "probes.resolution=64",
                                         "probes.bounces=0", "specular.rays=16"};
    assignments.insert(assignments.end(), GetParam().settings.begin(), GetParam().settings.end());
    const Pictures p = render(scene, view, {60, 34}, settingsOf(assignments), {"final", "albedo"});
    EXPECT_NEAR(meanOfSphere(p), 1.0, 0.01);
    expectSilentValidation("a furnace");
}

const std::vector<std::string> filtered{"specular.max_roughness=0", "specular.rough_fallback=mips", "diffuse.rays=1",
                                        "diffuse.distribution=normal"};
INSTANTIATE_TEST_SUITE_P(Probe, ProbeFurnace,
                         testing::Values(FurnaceCase{"matt_by_rays", 1.0F, 0.0F, {}},
                                         FurnaceCase{"glossy_by_rays", 0.4F, 0.0F, {}},
                                         FurnaceCase{"metal_by_rays", 0.5F, 1.0F, {}},
                                         FurnaceCase{"mirror", 0.0F, 1.0F, {}},
                                         FurnaceCase{"matt_filtered", 1.0F, 0.0F, filtered},
                                         FurnaceCase{"glossy_filtered", 0.4F, 0.0F, filtered},
                                         FurnaceCase{"metal_filtered", 0.5F, 1.0F, filtered},
                                         FurnaceCase{"rough_metal_filtered", 1.0F, 1.0F, filtered}),
                         [](const auto& furnace) { return furnace.param.name; });

// Two white spheres in a white environment stay white: each occludes the environment for the other, so the captures
// must contain the bounced light.
TEST(Probe, BouncesKeepAWhiteFurnaceWhite) {
    const ProbeRoom open{.half = vec3(3.0F)};
    Scene scene = sceneOf(lambertMaterial(vec3(1.0F)), builtin::sphere(0.7F, 64));
    builtin::place(scene, "other", 0U, builtin::at({0.5F, 0, -1.5F}));
    View view;
    view.camera.position = {0, 0.2F, 4.0F};
    view.camera.target = vec3(0.0F);
    view.environment.radiance = vec3(1.0F);
    view.probes = {{probeIn(open, {1.5F, 0.5F, 0.8F})}};
    const std::vector<std::string> base{"trace_screen.enabled=false", "materials.lambert_only=true",
                                        "probes.resolution=32", "diffuse.rays=16", "probes.parallax=box"};
    const auto mean = [&](const char* enabled, const char* bounces) {
        std::vector<std::string> all = base;
        all.insert(all.end(), {std::string("probes.enabled=") + enabled, std::string("probes.bounces=") + bounces});
        return meanOfSphere(render(scene, view, {60, 34}, settingsOf(all), {"final", "albedo"}));
    };
    EXPECT_NEAR(mean("false", "0"), 1.0, 0.001);
    EXPECT_LT(mean("true", "0"), 0.988) << "what is black in the captures takes light away";
    EXPECT_NEAR(mean("true", "2"), 1.0, 0.01);
}

// A long mirror floor that leads from one box into the next. Straight up, one probe sees red, the other green.
TEST(Probe, OneBoxBlendsIntoTheNextWithoutAStep) {
    constexpr uvec2 size(160, 8);
    Scene scene = sceneOf(whiteMetal(0.0F), builtin::ground({4, 1}, {1, 1}, {1, 1}));
    for (const float side : {-1.0F, 1.0F}) {
        Material lamp = lambertMaterial(vec3(0.0F));
        lamp.emissive = side < 0.0F ? vec3(1, 0, 0) : vec3(0, 1, 0);
        builtin::place(scene, "ceiling", builtin::addMaterial(scene, lamp),
                       builtin::patch({{2.0F * side, 3, 0}, {2, 0, 0}, {0, 0, 4}}));
    }
    View view;
    view.camera.position = {0, 2.9F, 0};
    view.camera.target = vec3(0.0F);
    view.camera.up = {0, 0, -1};
    view.camera.orthographicHeight = 0.4F;  // 8 m wide
    view.probes = {
        {{{-2, 1, 0}, {vec3(-4, -0.1F, -2), vec3(0, 3, 2)}}, {{2, 1, 0}, {vec3(0, -0.1F, -2), vec3(4, 3, 2)}}}};
    const Pictures p = render(
        scene, view, size,
        probeSettings({"probes.bounces=0", "probes.resolution=32", "probes.reach=0.155", "probes.parallax=none"}),
        {"specular_radiance"});
    EXPECT_NEAR(p.value("specular_radiance", 40, 4, 0), 1.0F, 0.01F) << "beside the first probe";
    EXPECT_NEAR(p.value("specular_radiance", 40, 4, 1), 0.0F, 0.01F);
    EXPECT_NEAR(p.value("specular_radiance", 120, 4, 1), 1.0F, 0.01F) << "beside the second";
    float largestStep = 0.0F;
    for (unsigned x = 1; x < size.x; ++x) {
        for (unsigned c = 0; c < 2; ++c) {
            largestStep = std::max(largestStep, std::abs(p.value("specular_radiance", x, 4, c) -
                                                         p.value("specular_radiance", x - 1, 4, c)));
        }
        EXPECT_NEAR(p.value("specular_radiance", x, 4, 0) + p.value("specular_radiance", x, 4, 1), 1.0F, 0.01F) << x;
    }
    EXPECT_LT(largestStep, 0.06F) << "5 cm a pixel; the blend is 2 m wide";
    RecordProperty("largestStep", std::to_string(largestStep));
}

// Toward the outer border of all boxes, the environment gradually takes over.
TEST(Probe, FadesIntoTheEnvironmentOutsideOfItsBox) {
    constexpr uvec2 size(160, 8);
    Scene scene = sceneOf(whiteMetal(0.0F), builtin::ground({4, 1}, {1, 1}, {1, 1}));
    Material lamp = lambertMaterial(vec3(0.0F));
    lamp.emissive = vec3(1, 0, 0);
    builtin::place(scene, "ceiling", builtin::addMaterial(scene, lamp),
                   builtin::patch({{0, 3, 0}, {20, 0, 0}, {0, 0, 20}}));
    View view;
    view.camera.position = {0, 2.9F, 0};
    view.camera.target = vec3(0.0F);
    view.camera.up = {0, 0, -1};
    view.camera.orthographicHeight = 0.4F;
    view.environment.radiance = vec3(0, 0, 1);
    view.probes = {{{{0, 1, 0}, {vec3(-1, -0.1F, -2), vec3(1, 3, 2)}}}};
    const Pictures p =
        render(scene, view, size, probeSettings({"probes.bounces=0", "probes.resolution=32", "probes.reach=0.184"}),
               {"specular_radiance", "specular_source"});
    EXPECT_NEAR(p.value("specular_radiance", 62, 4, 0), 1.0F, 0.01F) << "in the box, near its end";
    EXPECT_NEAR(p.value("specular_radiance", 30, 4, 2), 1.0F, 0.01F) << "beyond it";
    EXPECT_NEAR(p.value("specular_source", 30, 4, 2), 0.9F, 0.01F) << "the environment's blue";
    EXPECT_NEAR(p.value("specular_source", 80, 4, 0), 0.8F, 0.01F) << "the probes' magenta";
    for (unsigned x = 1; x < size.x; ++x) {
        EXPECT_NEAR(p.value("specular_radiance", x, 4, 0) + p.value("specular_radiance", x, 4, 2), 1.0F, 0.01F) << x;
        EXPECT_NEAR(p.value("specular_radiance", x, 4, 0), p.value("specular_radiance", x - 1, 4, 0), 0.1F) << x;
    }
}

TEST(Probe, LeavesTheSkyToTheEnvironment) {
    const Scene scene = sceneOf(whiteMetal(0.0F), builtin::ground({4, 4}, {1, 1}, {1, 1}));
    View view;
    view.camera.position = {0, 2, 3};
    view.camera.target = vec3(0.0F);
    view.environment.radiance = {0.25F, 0.5F, 0.75F};
    view.probes = {{{{0, 1, 0}, {vec3(-4, -0.1F, -4), vec3(4, 3, 4)}}}};
    const Pictures p = render(scene, view, {36, 20}, probeSettings({"probes.resolution=32"}),
                              {"specular_radiance", "specular_source"});
    const vec3 light = p.color("specular_radiance", 16, 12);
    EXPECT_LT(glm::length(light - view.environment.radiance), 1e-3F);
    EXPECT_NEAR(p.value("specular_source", 16, 12, 2), 0.9F, 0.01F);
}

TEST(Probe, IsNotUsedForRaysThatAreKnownToHitNothing) {
    const Scene scene = findBuiltinScene("gloss")->make();
    const auto reflections = [&](const char* probes) {
        return render(
                   scene, defaultView(scene), {60, 34},
                   settingsOf({"diffuse.rays=0", "specular.rays=4", "trace_screen.enabled=false",
                               "trace_scene.enabled=true", "trace_scene.light=path", "probes.resolution=32", probes}),
                   {"specular_radiance"})
            .images.at("specular_radiance");
    };
    const Difference d =
        compareImages(reflections("probes.enabled=true"), reflections("probes.enabled=false"), {}).difference;
    EXPECT_EQ(d.relativeMse, 0.0);
    expectSilentValidation("probes behind the scene");
}

}  // namespace
}  // namespace reflet::test::probe_test
