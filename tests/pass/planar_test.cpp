// Planar reflections, against the path tracer and against one another.
#include "compare/compare.h"
#include "pass/mirror_room.h"
#include "reference/reference.h"
#include "scene/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace reflet::test::planar_test {
namespace {

constexpr uvec2 size(160, 90);

const std::vector<std::string> shows{
    "indirect_specular", "specular_confidence", "specular_source", "metallic", "depth", "final"};

// Only direct light in the mirror, like a reference with one bounce.
Pictures mirrored(const Scene& scene, const View& view, const std::vector<std::string>& more) {
    std::vector<std::string> all{"diffuse.rays=0", "shadow.filter=hard", "planar.enabled=true",
                                 "trace_screen.light=direct"};
    all.insert(all.end(), more.begin(), more.end());
    return render(scene, view, size, settingsOf(all), shows);
}

FloatImage truthOf(const Scene& scene, const View& view, uint32_t samples = 64) {
    ReferenceOptions options;
    options.bounces = 1;
    options.samples = samples;
    options.filter = PixelFilter::center;
    return traceReference(scene, view, size, options).indirectSpecular;
}

double relativeMse(const Pictures& p, const FloatImage& truth, const std::vector<bool>& mask) {
    return compareImages(p.images.at("indirect_specular"), truth, {.mask = mask}).difference.relativeMse;
}

size_t countOf(const std::vector<bool>& mask) {
    return static_cast<size_t>(std::count(mask.begin(), mask.end(), true));
}

void expectTheReferencesMirror(const Scene& scene, const View& view, const std::string& what) {
    const FloatImage truth = truthOf(scene, view);
    std::vector<Pictures> forms;
    for (const char* form : {"traced", "lookup", "duplicate"}) {
        forms.push_back(mirrored(scene, view, {std::string("planar.form=") + form}));
        expectSilentValidation(what + ", " + form);
    }
    forms.push_back(mirrored(scene, view,
                             {"planar.enabled=false", "trace_screen.enabled=false", "trace_scene.enabled=true",
                              "trace_scene.reuse_screen=false", "materials.mips=false"}));
    expectSilentValidation(what + ", ray traced");
    const std::vector<bool> mask = smoothMirrorPixels(forms[0], truth);
    EXPECT_GT(countOf(mask), 1500U) << what;
    for (size_t i = 0; i < forms.size(); ++i) {
        const double toTruth = relativeMse(forms[i], truth, mask);
        EXPECT_LT(toTruth, 0.005) << what << ", form " << i;
        testing::Test::RecordProperty(fmt::format("{}, form {}", what, i), std::to_string(toTruth));
        for (size_t k = 0; k < i; ++k) {
            EXPECT_LT(relativeMse(forms[i], forms[k].images.at("indirect_specular"), mask), 0.005)
                << what << ", forms " << i << " and " << k;
        }
    }
}

TEST(Planar, AFlatMirrorShowsWhatTheReferenceShowsInEveryForm) {
    expectTheReferencesMirror(makeMirrorRoom(), viewOfMirrorRoom(), "upright");
}

TEST(Planar, ATiltedMirrorSeenFromAboveShowsWhatTheReferenceShows) {
    View view = viewOfMirrorRoom();
    view.camera.position = {1.5F, 3.2F, 2.5F};
    expectTheReferencesMirror(makeMirrorRoom({.turn = builtin::turned(25, {1, 0.3F, 0})}), view, "tilted");
}

TEST(Planar, AMirroringInstanceAndAnOrthographicCameraShowTheSame) {
    View view = viewOfMirrorRoom();
    view.camera.orthographicHeight = 3.5F;
    const mat4 mirroring = glm::scale(mat4(1.0F), vec3(-1, 1, 1));
    expectTheReferencesMirror(makeMirrorRoom({.turn = mirroring}), view, "orthographic");
}

TEST(Planar, EveryMethodOfTracingFindsWhatAnEvenMirrorShows) {
    const Scene scene = makeMirrorRoom();
    const View view = viewOfMirrorRoom();
    const Pictures expected = mirrored(scene, view, {"trace_screen.method=exhaustive"});
    const std::vector<bool> mask = smoothMirrorPixels(expected, expected.images.at("indirect_specular"), 1e9F);
    EXPECT_GT(countOf(mask), 2000U);
    for (const char* method : {"linear", "halving", "fixed_point", "dda", "hiz"}) {
        const Pictures p = mirrored(scene, view, {std::string("trace_screen.method=") + method});
        EXPECT_LT(relativeMse(p, expected.images.at("indirect_specular"), mask), 1e-6) << method;
    }
    const Pictures hiz = mirrored(scene, view, {"trace_screen.enabled=false"});
    for (size_t i = 0; i < mask.size(); ++i) {
        EXPECT_TRUE(!mask[i] || hiz.images.at("specular_confidence").data[i] > 0.99F) << i;
    }
}

// Mirrors whose rays leave their pixel; planar views have hierarchical depth of their own, also if the screen has none.
TEST(Planar, HierarchicalDepthFindsTheSameWithoutTheScreen) {
    const Scene scene = findBuiltinScene("mirror-hall")->make();
    const auto draw = [&](const char* method) {
        return mirrored(scene, defaultView(scene),
                        {std::string("trace_screen.method=") + method, "trace_screen.enabled=false", "planar.count=2"});
    };
    const Pictures pyramid = draw("hiz");
    const Pictures all = draw("exhaustive");
    size_t different = 0;
    const std::vector<float>& a = pyramid.images.at("indirect_specular").data;
    const std::vector<float>& b = all.images.at("indirect_specular").data;
    for (size_t i = 0; i < a.size(); ++i) {
        different += a[i] != b[i] ? 1 : 0;
    }
    EXPECT_EQ(different, 0U);
}

TEST(Planar, TheScreenAgreesWhereItIsSure) {
    const Scene scene = makeMirrorRoom();
    const View view = viewOfMirrorRoom();
    const Pictures planar = mirrored(scene, view, {});
    const Pictures screen = mirrored(scene, view, {"planar.enabled=false", "trace_screen.thickness=0.05"});
    std::vector<bool> mask = smoothMirrorPixels(planar, planar.images.at("indirect_specular"));
    const std::vector<bool> smooth = smoothMirrorPixels(screen, screen.images.at("indirect_specular"));
    for (size_t i = 0; i < mask.size(); ++i) {
        mask[i] = mask[i] && smooth[i] && screen.images.at("specular_confidence").data[i] > 0.999F;
    }
    EXPECT_GT(countOf(mask), 80U);
    EXPECT_LT(relativeMse(screen, planar.images.at("indirect_specular"), mask), 0.005);
}

TEST(Planar, TheSourceIsGreenForTheScreenAndCyanForPlanarReflections) {
    const auto answeredBy = [&](const vec3& color, const std::vector<std::string>& more) {
        const Pictures p = mirrored(makeMirrorRoom(), viewOfMirrorRoom(), more);
        size_t pixels = 0;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                pixels += glm::distance(p.color("specular_source", x, y), color) < 0.01F ? 1 : 0;
            }
        }
        return pixels;
    };
    const vec3 green(0.2F, 0.8F, 0.3F);
    const vec3 cyan(0.2F, 0.8F, 0.85F);
    EXPECT_GT(answeredBy(green, {"planar.enabled=false"}), 80U);
    EXPECT_EQ(answeredBy(cyan, {"planar.enabled=false"}), 0U);
    EXPECT_GT(answeredBy(cyan, {"trace_screen.enabled=false"}), 2000U);
    EXPECT_EQ(answeredBy(green, {"trace_screen.enabled=false"}), 0U);
}

// Over 5 s: two references and many rays.
TEST(Planar, UnevenAndRoughMirrorsAreNearerToTheReferenceTracedThanLookedUp) {
    for (const bool waves : {true, false}) {
        const Scene scene = makeMirrorRoom({.roughness = waves ? 0.0F : 0.15F, .waves = waves});
        const View view = viewOfMirrorRoom();
        const std::vector<std::string> rays{"specular.rays=64", "planar.margin=0.3", "materials.anisotropy=1"};
        const FloatImage truth = truthOf(scene, view, 256);
        const auto error = [&](const char* form) {
            std::vector<std::string> all = rays;
            all.push_back(std::string("planar.form=") + form);
            const Pictures p = mirrored(scene, view, all);
            return relativeMse(p, truth, smoothMirrorPixels(p, truth, 0.3F));
        };
        const double traced = error("traced");
        const double lookedUp = error("lookup");
        EXPECT_LT(traced, 0.01) << waves;
        EXPECT_LT(traced, 0.5 * lookedUp) << waves;
        RecordProperty(waves ? "waves" : "rough", fmt::format("{} traced, {} looked up", traced, lookedUp));
    }
}

TEST(Planar, AMirrorThatIsSeenFromBehindOrNotAtAllAsksNothing) {
    const Scene scene = makeMirrorRoom();
    View behind = viewOfMirrorRoom();
    behind.camera.position = {0, 1.5F, -3.5F};
    View away = viewOfMirrorRoom();
    away.camera.target = {0.9F, 1.7F, 9.0F};
    for (const View& view : {behind, away}) {
        const Pictures with = mirrored(scene, view, {});
        const Pictures without = mirrored(scene, view, {"planar.enabled=false"});
        EXPECT_EQ(with.images.at("final").data, without.images.at("final").data);
    }
}

// Weights of single rays may be above or below 1, and rays that would enter the mirror contribute nothing.
TEST(Planar, AWhiteMirrorInAWhiteEnvironmentIsAsBrightAsWithoutPlanarReflections) {
    for (const float roughness : {0.0F, 0.1F, 0.2F}) {
        Material metal = lambertMaterial(vec3(1.0F));
        metal.metallic = 1.0F;
        metal.roughness = roughness;
        const Scene scene = sceneOf(metal, builtin::ground({1, 1}, {1, 1}, {1, 1}));
        View view;
        view.camera.position = {0.3F, 0.8F, 1.5F};
        view.camera.target = vec3(0.0F);
        view.environment.radiance = vec3(1.0F);
        const auto final = [&](const std::vector<std::string>& assignments) {
            return render(scene, view, size, settingsOf(assignments), {"final"}).images.at("final");
        };
        const FloatImage without = final({"specular.rays=4"});
        EXPECT_NEAR(std::accumulate(without.data.begin(), without.data.end(), 0.0) / double(without.data.size()), 1.0,
                    0.01);
        for (const char* form : {"traced", "lookup", "duplicate", "camera"}) {
            const FloatImage with =
                final({"specular.rays=4", "planar.enabled=true", std::string("planar.form=") + form});
            EXPECT_LT(compareImages(with, without, {}).difference.max, 0.01) << form << ", roughness " << roughness;
        }
    }
}

TEST(Planar, SmallerViewsShowMuchTheSame) {
    const Scene scene = makeMirrorRoom();
    const View view = viewOfMirrorRoom();
    const Pictures full = mirrored(scene, view, {});
    const Pictures half = mirrored(scene, view, {"planar.scale=0.5"});
    const std::vector<bool> mask = smoothMirrorPixels(full, full.images.at("indirect_specular"), 0.1F);
    EXPECT_LT(relativeMse(half, full.images.at("indirect_specular"), mask), 0.01);
    EXPECT_NE(half.images.at("indirect_specular").data, full.images.at("indirect_specular").data);
}

void expectSound(const std::vector<std::string>& assignments) {
    std::vector<std::string> all{"planar.enabled=true", "specular.max_roughness=0.1"};
    all.insert(all.end(), assignments.begin(), assignments.end());
    const Pictures p =
        render(makeMirrorRoom({.waves = true}), viewOfMirrorRoom(), {60, 34}, settingsOf(all), {"final", "source"}, 2);
    const Range range = rangeOf(p.images.at("final"));
    const std::string during = fmt::format("{}", fmt::join(assignments, ", "));
    EXPECT_TRUE(range.finite && range.min >= 0.0F) << during;
    expectSilentValidation(during);
}

// Over 5 s: a frame for each end, with pipelines of their own.
TEST(Planar, EverySettingWorksAtItsEnds) {
    expectSound({"planar.before_screen=false", "planar.count=4", "planar.scale=0.25", "planar.margin=1"});
    expectSound({"planar.count=0", "planar.diffuse=false"});
    expectSound({"planar.auto_detect=false", "planar.specular=false"});
    expectSound({"planar.specular=false", "specular.rough_fallback=mips"});
    expectSound({"planar.max_roughness=1", "planar.count=4", "shadow.cascades=3"});
    expectSound({"trace_screen.thickness_mode=second_layer", "trace_screen.count_steps=true"});
    expectSound({"trace_screen.light=previous", "trace_screen.enabled=false"});
    expectSound({"depth.format=standard24", "contact.distance=0.1"});
}

// Over 5 s: many combinations of settings, with pipelines of their own.
TEST(Planar, EveryFormWorksWithOtherSettings) {
    for (const char* form : {"lookup", "duplicate", "camera"}) {
        const std::string chosen = std::string("planar.form=") + form;
        expectSound(
            {chosen, "planar.count=4", "planar.scale=0.25", "specular.rough_fallback=mips", "shadow.cascades=3"});
        expectSound({chosen, "planar.camera_size=8", "planar.camera_blur=64", "planar.camera_fov=150",
                     "trace_screen.thickness_mode=second_layer", "trace_screen.light=previous"});
    }
}

}  // namespace
}  // namespace reflet::test::planar_test
