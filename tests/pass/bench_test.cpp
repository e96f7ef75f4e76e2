// measure/bench: statistics of times, the inputs of a reference's cache key, and the byte counts of passes.
#include "base/error.h"
#include "capture/spread.h"
#include "measure/bench/motion.h"
#include "measure/bench/output.h"
#include "measure/bench/samples.h"
#include "measure/bench/truth.h"
#include "renderer/live/live_picture.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace reflet::test::bench_test {
namespace {

class BenchDeviceTest : public DeviceTest {};

Spread spread(std::vector<double> values) {
    return spreadOf(values);
}

BenchScene cubes() {
    BenchScene scene{"cubes", *makeBuiltinScene("cubes"), {}, 0};
    scene.view = defaultView(scene.scene);
    return scene;
}

std::string key(const BenchScene& scene, const TruthOptions& options, const Settings& settings = {},
                uvec2 size = {32, 18}) {
    return truthKey(scene, size, settings, options);
}

TruthOptions chain() {
    TruthOptions options;
    options.kind = TruthKind::chain;
    return options;
}

// Two frames: the second lacks a pass that the first has.
Samples twoFrames() {
    Samples samples;
    const std::vector<gpu::PassTime> first{{"frame", 10.0, 30, false},
                                           {"gbuffer", 3.0, 10, true},
                                           {"diffuse.trace_screen", 4.0, 10, false},
                                           {"diffuse.resolve_rays", 2.0, 10, false}};
    const std::vector<gpu::PassTime> second{
        {"frame", 8.0, 20, false}, {"gbuffer", 3.5, 10, true}, {"diffuse.trace_screen", 4.5, 10, false}};
    samples.add(12.0, 11.0, first);
    samples.add(9.0, 8.5, second);
    return samples;
}

TEST(Spread, TheMedianIsTheMiddleValueOrTheMeanOfTheTwoInTheMiddle) {
    EXPECT_EQ(spread({5.0}).median, 5.0);
    EXPECT_EQ(spread({9.0, 1.0, 5.0}).median, 5.0);
    EXPECT_EQ(spread({9.0, 1.0, 5.0, 2.0}).median, 3.5);
    EXPECT_EQ(spread({}).median, 0.0);
    EXPECT_EQ(spread({}).count, 0U);
}

TEST(Spread, QuartilesLieAQuarterOfTheWayFromEitherEnd) {
    const Spread five = spread({40.0, 0.0, 30.0, 10.0, 20.0});
    EXPECT_EQ(five.lowerQuartile, 10.0);
    EXPECT_EQ(five.upperQuartile, 30.0);
    EXPECT_EQ(five.min, 0.0);
    EXPECT_EQ(five.max, 40.0);
    const Spread two = spread({1.0, 3.0});
    EXPECT_EQ(two.lowerQuartile, 1.5);
    EXPECT_EQ(two.upperQuartile, 2.5);
}

TEST(Samples, GroupsAreTheSumsOfTheirPassesInEveryFrame) {
    const Samples samples = twoFrames();
    EXPECT_EQ(samples.find(SeriesKind::group, "diffuse")->ms, (std::vector<double>{6.0, 4.5}));
    EXPECT_EQ(samples.find(SeriesKind::group, "effects")->ms, (std::vector<double>{6.0, 4.5}));
    EXPECT_EQ(samples.find(SeriesKind::group, "geometry")->ms, (std::vector<double>{3.0, 3.5}));
    EXPECT_EQ(samples.find(SeriesKind::group, "effects")->bytes, 10U);
    EXPECT_EQ(samples.find(SeriesKind::total, "wall")->ms, (std::vector<double>{12.0, 9.0}));
    EXPECT_EQ(samples.find(SeriesKind::total, "submitted")->ms, (std::vector<double>{11.0, 8.5}));
}

TEST(Samples, APassThatAFrameLacksTookNoTimeInIt) {
    EXPECT_EQ(twoFrames().find(SeriesKind::pass, "diffuse.resolve_rays")->ms, (std::vector<double>{2.0, 0.0}));
    EXPECT_EQ(twoFrames().find(SeriesKind::pass, "nothing"), nullptr);
}

TEST(Samples, ThereIsARatioForEveryTurnInWhichBothTookTime) {
    for (const Ratio& ratio : ratiosOf(twoFrames(), twoFrames())) {
        const size_t turns = ratio.name == "diffuse.resolve_rays" ? 1 : 2;
        EXPECT_EQ(ratio.ratios, std::vector<double>(turns, 1.0)) << ratio.name;
        EXPECT_EQ(ratio.differences, std::vector<double>(2, 0.0)) << ratio.name;
    }
    Samples slower;
    slower.add(24.0, 22.0, std::vector<gpu::PassTime>{{"frame", 5.0, 0, false}});
    const std::vector<Ratio> ratios = ratiosOf(slower, twoFrames());
    ASSERT_EQ(ratios.size(), 3U);
    EXPECT_EQ(ratios[0].ratios, std::vector<double>{2.0});
    EXPECT_EQ(ratios[0].differences, std::vector<double>{12.0});
    EXPECT_EQ(ratios[2].ratios, std::vector<double>{0.5});
}

TEST(Samples, HostTimeToRecordIsComparedOnlyIfBothTellIt) {
    Samples tells;
    tells.add(4.0, 3.0, {}, Recording{0.5, 40, 15, 1000});
    tells.add(4.0, 3.0, {}, Recording{0.25, 41, 16, 2000});
    EXPECT_EQ(tells.find(SeriesKind::total, "record")->ms, (std::vector<double>{0.5, 0.25}));
    EXPECT_EQ(tells.recording()->passes, 41U);
    EXPECT_EQ(tells.recording()->barriers, 16U);
    EXPECT_EQ(tells.recording()->transientBytes, 2000U);
    EXPECT_FALSE(twoFrames().recording());
    const auto compares = [](const std::vector<Ratio>& ratios) {
        return std::ranges::find(ratios, "record", &Ratio::name) != ratios.end();
    };
    EXPECT_TRUE(compares(ratiosOf(tells, tells)));
    EXPECT_FALSE(compares(ratiosOf(tells, twoFrames())));
    EXPECT_FALSE(compares(ratiosOf(twoFrames(), tells)));
}

TEST(Scaling, TimesAreOverPixelsAndTheSpreadIsOfTheDearestOverTheCheapest) {
    BenchResult result;
    for (const uint32_t scale : {1U, 2U}) {
        BenchRun run;
        run.scene = "s";
        run.variant = "v";
        run.size = uvec2(100, 10) * scale;
        run.steady.samples.add(0.0, scale == 1 ? 1.0 : 5.0, {});
        result.runs.push_back(run);
    }
    const std::vector<Scaling> scaling = scalingOf(result);
    ASSERT_EQ(scaling.size(), 1U);
    EXPECT_EQ(scaling[0].nsPerPixel, (std::vector<double>{1000.0, 1250.0}));
    EXPECT_DOUBLE_EQ(scaling[0].spread, 0.25);
    result.runs.pop_back();
    EXPECT_TRUE(scalingOf(result).empty());
}

TEST(TruthKey, ChangesWithAllThatThePictureDependsOn) {
    const BenchScene scene = cubes();
    const TruthOptions options;
    std::vector<std::string> keys{key(scene, options), key(scene, options, {}, {33, 18}), key(scene, chain())};
    const auto addOptions = [&](auto change) {
        TruthOptions other;
        change(other.reference);
        keys.push_back(key(scene, other));
    };
    addOptions([](ReferenceOptions& r) { r.bounces = 1; });
    addOptions([](ReferenceOptions& r) { r.samples = 65; });
    addOptions([](ReferenceOptions& r) { r.visibleOnly = true; });
    addOptions([](ReferenceOptions& r) { r.filter = PixelFilter::center; });
    addOptions([](ReferenceOptions& r) { r.seed = 1; });
    Settings lambert;
    lambert.materials.lambertOnly = 1;
    keys.push_back(key(scene, options, lambert));
    const auto addScene = [&](auto change) {
        BenchScene other = cubes();
        change(other);
        keys.push_back(key(other, options));
    };
    addScene([](BenchScene& s) { s.scene.materials[0].roughness += 0.01F; });
    addScene([](BenchScene& s) { s.scene.meshes[0].positions[0].x += 0.001F; });
    addScene([](BenchScene& s) { s.scene.instances[0].objectToWorld[3].y += 0.001F; });
    addScene([](BenchScene& s) { s.view.camera.fovY += 0.01F; });
    addScene([](BenchScene& s) { s.view.sun.direction.x += 0.01F; });
    addScene([](BenchScene& s) { s.view.environment.radiance.x += 0.01F; });
    std::ranges::sort(keys);
    EXPECT_EQ(std::ranges::adjacent_find(keys), keys.end());
}

TEST(TruthKey, DoesNotChangeWithWhatThePathTracerDoesNotKnow) {
    const BenchScene scene = cubes();
    TruthOptions threads;
    threads.reference.threads = 3;
    threads.folder = "elsewhere";
    EXPECT_EQ(key(scene, {}), key(scene, threads));
    Settings rays;
    rays.diffuse.rays += 1;
    EXPECT_EQ(key(scene, {}), key(scene, {}, rays));
}

TEST(TruthKey, OfAChainChangesWithSettingsAndRays) {
    const BenchScene scene = cubes();
    Settings thick;
    thick.traceScreen.thickness *= 2.0F;
    EXPECT_NE(key(scene, chain()), key(scene, chain(), thick));
    TruthOptions more = chain();
    more.chainRays *= 2;
    EXPECT_NE(key(scene, chain()), key(scene, more));
    Settings rays;  // the chain has rays of its own
    rays.diffuse.rays += 1;
    EXPECT_EQ(key(scene, chain()), key(scene, chain(), rays));
}

TEST(Truth, AChainIsAMeanOfManyRaysOfTheLobesThatAreOn) {
    Settings settings;
    settings.diffuse.rays = 2;
    settings.specular.rays = 0;
    const Settings chained = chainSettings(settings, 16);
    EXPECT_EQ(chained.diffuse.rays, 16U);
    EXPECT_EQ(chained.specular.rays, 0U);
    EXPECT_EQ(chained.accumulate.enabled, 1U);
}

TEST(Truth, KindsAreSaidByName) {
    TruthOptions options;
    parseTruth("chain:48", options);
    EXPECT_EQ(options.kind, TruthKind::chain);
    EXPECT_EQ(options.chainRays, 48U);
    parseTruth("none", options);
    EXPECT_EQ(options.kind, TruthKind::none);
    parseTruth("reference", options);
    EXPECT_EQ(options.kind, TruthKind::reference);
    for (const char* wrong : {"", "chain", "chain:", "chain:0", "chain:4x", "chain:-1", "truth"}) {
        EXPECT_THROW(parseTruth(wrong, options), UsageError) << wrong;
    }
}

TEST(Motion, APictureThatOnlyMovesDoesNotChangeBeyondItsMotion) {
    FloatImage before{8, 4, {"Y"}, {}};
    FloatImage now = before;
    FloatImage motion{8, 4, {"X", "Y"}, {}};
    for (uint32_t i = 0; i < 32; ++i) {
        before.data.push_back(static_cast<float>((i % 8) * (i % 8)));
        now.data.push_back(i % 8 >= 2 ? static_cast<float>((i % 8 - 2) * (i % 8 - 2)) : 77.0F);  // two pixels right
        motion.data.insert(motion.data.end(), {0.25F, 0.0F});
    }
    EXPECT_EQ(changeBeyondMotion(now, before, motion), 0.0);
    EXPECT_GT(changeBeyondMotion(before, before, motion), 1.0);
    now.data[10] += 6.0F;  // one of the 24 pixels that were in the picture
    EXPECT_DOUBLE_EQ(changeBeyondMotion(now, before, motion), 6.0 / 24.0);
}

TEST(Motion, TheCameraTurnsRoundWhatItLooksAt) {
    View view;
    view.camera.position = {2, 1, 5};
    view.camera.target = {2, 0, 1};
    const MotionPlan plan{10, 90.0F, 0};
    EXPECT_EQ(viewInMotion(view, plan, 0).camera.position, view.camera.position);
    const vec3 last = viewInMotion(view, plan, 10).camera.position;
    EXPECT_NEAR(last.x, 6.0F, 1e-5F);
    EXPECT_NEAR(last.y, 1.0F, 1e-5F);
    EXPECT_NEAR(last.z, 1.0F, 1e-5F);
    EXPECT_EQ(viewInMotion(view, plan, 10).camera.target, view.camera.target);
    EXPECT_DOUBLE_EQ(viewInMotion(view, plan, 12).time, 0.5);
}

TEST(Motion, WhatComesToRestIsHeldAgainstItsFinalValueWhereTheMotionChangedIt) {
    const FloatImage before{2, 1, {"Y"}, {1.0F, 4.0F}};
    const FloatImage final{2, 1, {"Y"}, {1.01F, 2.0F}};
    const FloatImage frame{2, 1, {"Y"}, {9.0F, 2.5F}};
    EXPECT_DOUBLE_EQ(changeAtRest(frame, final, before), 0.25);
    EXPECT_EQ(changeAtRest(frame, final, final), 0.0);
}

TEST_F(BenchDeviceTest, APassCountsTheBytesOfWhatItBinds) {
    gpu::Frame& f = frame();
    f.begin();
    const gpu::Image from = f.image("from", VK_FORMAT_R16G16B16A16_SFLOAT, {64, 32});
    const gpu::Image to = f.image("to", VK_FORMAT_R16G16B16A16_SFLOAT, {16, 8});
    showLive(f, from, to);
    f.keep(to);
    f.submit();
    f.wait();
    ASSERT_EQ(f.passTimes().size(), 2U);
    EXPECT_EQ(f.passTimes()[1].bytes, (64U * 32U + 16U * 8U) * 8U);
    EXPECT_EQ(f.passTimes()[0].bytes, f.passTimes()[1].bytes);
    EXPECT_FALSE(f.passTimes()[1].raster);
    EXPECT_GT(f.submittedMs(), 0.0);
}

TEST_F(BenchDeviceTest, BytesOfAnImageAreThoseOfAllItsLevelsAndLayers) {
    const gpu::Texture texture(
        device(), {VK_FORMAT_R8G8B8A8_UNORM, {8, 2}, 4, 3, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT},
        "levels");
    EXPECT_EQ(bytesOf(texture.image()), (8U * 2U + 4U + 2U + 1U) * 3U * 4U);
    EXPECT_EQ(bytesOf(texture.mip(1)), 4U * 3U * 4U);
}

TEST_F(BenchDeviceTest, InvalidatedHistoryIsNotValidForOneFrame) {
    gpu::Frame& f = frame();
    std::vector<bool> valid;
    gpu::HistoryImage history("bench_history");
    for (int i = 0; i < 5; ++i) {
        if (i == 3) {
            f.forget();
        }
        f.begin();
        const gpu::History images = history.swap(f, VK_FORMAT_R32_SFLOAT, {4, 4});
        valid.push_back(images.valid);
        f.clear(images.next);  // what is not written is not valid either
        f.submit();
        f.wait();
    }
    EXPECT_EQ(valid, (std::vector<bool>{false, true, true, false, true}));
}

TEST_F(BenchDeviceTest, UsedMemoryIsWhatResourcesHold) {
    const auto used = [] { return device().memory().used(gpu::MemoryUse::device); };
    device().runNow([](VkCommandBuffer) {});
    const VkDeviceSize before = used();
    {
        const gpu::Buffer buffer(device(), 1U << 20U, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryUse::device, "b");
        EXPECT_GE(used(), before + (1U << 20U));
        EXPECT_LT(used(), before + (1U << 21U));
    }
    device().runNow([](VkCommandBuffer) {});
    EXPECT_EQ(used(), before);
}

// The first frame after the history was invalidated equals the very first one.
TEST_F(BenchDeviceTest, ASubjectWithItsHistoryInvalidatedRepeatsItsFirstImage) {
    const BenchScene scene = cubes();
    Settings settings;
    settings.traceScreen.light = HitLight::previous;
    Subject subject(device(), scene, {32, 18}, settings);
    const FloatImage first = subject.picture({"final"}).at("final");
    const FloatImage second = subject.picture({"final"}).at("final");
    subject.forgetHistory();
    const auto error = [&](const FloatImage& picture) {
        return compareImages(picture, first, {}).difference.relativeMse;
    };
    // Cube maps may differ in the last bit (docs/conventions.md).
    EXPECT_LT(error(subject.picture({"final"}).at("final")), 1e-9);
    EXPECT_GT(error(second), 1e-6);
    EXPECT_GT(subject.memory(), 32U * 18U * 8U);
}

TEST_F(BenchDeviceTest, FewTrianglesAndAMillionLookAlike) {
    std::vector<FloatImage> pictures;
    for (const char* name : {"tessellated-100", "tessellated-1000000"}) {
        BenchScene scene{name, *makeBuiltinScene(name), {}, 0};
        scene.view = defaultView(scene.scene);
        pictures.push_back(Subject(device(), scene, {64, 36}, {}).picture({"direct"}).at("direct"));
    }
    CompareOptions options;
    EXPECT_LT(compareImages(pictures[0], pictures[1], options).difference.relativeMse, 1e-3);
}

}  // namespace
}  // namespace reflet::test::bench_test
