// Temporal antialiasing of whole frames: convergence to the mean over the pixel's area, motion vectors without jitter,
// and interaction with other histories.
#include "pass/harness.h"
#include "scene/builtin.h"

#include <cmath>

namespace reflet::test::temporal_frame_test {
namespace {

constexpr uvec2 size(96, 54);
const std::vector<std::string> plain{"diffuse.rays=0", "specular.rays=0", "shadow.filter=hard"};

Settings settingsWith(std::vector<std::string> more) {
    more.insert(more.end(), plain.begin(), plain.end());
    return settingsOf(more);
}

double relativeMse(const FloatImage& image, const FloatImage& truth) {
    double sum = 0.0;
    for (size_t i = 0; i < image.data.size(); i += 3) {
        const vec3 t(truth.data[i], truth.data[i + 1], truth.data[i + 2]);
        const vec3 off = vec3(image.data[i], image.data[i + 1], image.data[i + 2]) - t;
        sum += double(glm::dot(off, off)) / (double(glm::dot(t, t)) + 0.01);
    }
    return sum / (double(image.data.size()) / 3.0);
}

// Over 5 s: the mean that it is compared with is one of 128 frames.
TEST(TemporalFrame, AtRestItConvergesToTheMeanOverThePixelsArea) {
    for (const char* name : {"cubes", "colonnade"}) {
        const Scene scene = findBuiltinScene(name)->make();
        const View view = defaultView(scene);
        const FloatImage truth =
            render(scene, view, size, settingsWith({"accumulate.enabled=on"}), {"final"}, 128).images.at("final");
        const Pictures p =
            render(scene, view, size, settingsWith({"temporal.enabled=on"}), {"final", "unfiltered"}, 32);
        const double with = relativeMse(p.images.at("final"), truth);
        const double without =
            relativeMse(render(scene, view, size, settingsWith({}), {"final"}).images.at("final"), truth);
        RecordProperty(std::string(name) + "_with", std::to_string(with));
        RecordProperty(std::string(name) + "_without", std::to_string(without));
        EXPECT_LT(with, 0.1 * without) << name << ": " << with << " of " << without;
    }
    expectSilentValidation("temporal antialiasing");
}

// Over 5 s: as above.
TEST(TemporalFrame, SmallerFramesConvergeToTheSamePictureOfFullSize) {
    for (const char* name : {"cubes", "colonnade"}) {
        const Scene scene = findBuiltinScene(name)->make();
        const View view = defaultView(scene);
        const FloatImage truth =
            render(scene, view, size, settingsWith({"accumulate.enabled=on"}), {"final"}, 128).images.at("final");
        const double without =
            relativeMse(render(scene, view, size, settingsWith({}), {"final"}).images.at("final"), truth);
        for (const char* scale : {"temporal.scale=0.5", "temporal.scale=0.6667"}) {
            const Pictures p = render(scene, view, size, settingsWith({"temporal.enabled=on", scale}), {"final"}, 96);
            ASSERT_EQ(p.images.at("final").width, size.x);
            const double with = relativeMse(p.images.at("final"), truth);
            RecordProperty(std::string(name) + scale, std::to_string(with / without));
            // Letters of two pixels, in cubes, are half a small frame's neighbourhood: their history is clipped more.
            EXPECT_LT(with, 0.35 * without) << name << ", " << scale << ": " << with << " of " << without;
        }
    }
    expectSilentValidation("temporal upscaling");
}

TEST(TemporalFrame, MotionIsZeroAtRestWhateverTheJitterAndWithoutItWhenTheCameraMoves) {
    const Scene scene = findBuiltinScene("cubes")->make();
    const View view = defaultView(scene);
    const Settings settings = settingsWith({"temporal.enabled=on"});
    for (const uint32_t frames : {1U, 2U, 5U}) {
        const Range motion = rangeOf(render(scene, view, size, settings, {"motion"}, frames).images.at("motion"));
        EXPECT_EQ(motion.min, 0.0F) << frames;
        EXPECT_EQ(motion.max, 0.0F) << frames;
    }
    // Of a plane, what is half a pixel off moves almost alike.
    Scene plane = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({50, 50}, {1, 1}, {1, 1}));
    View before;
    before.camera.position = {0, 2, 6};
    before.camera.target = {0, 0, 0};
    View now = before;
    now.camera.position.x += 0.2F;
    const std::vector<std::string> shows{"motion", "depth"};
    const Pictures still = renderMoved(plane, before, now, size, settingsWith({}), shows, 3);
    const Pictures jittered = renderMoved(plane, before, now, size, settings, shows, 3);
    for (unsigned y = size.y / 2; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            for (unsigned channel = 0; channel < 2; ++channel) {
                EXPECT_NEAR(jittered.value("motion", x, y, channel), still.value("motion", x, y, channel),
                            0.1F / float(size.y))
                    << x << ", " << y;  // a tenth of a pixel; the jitter's own steps are half of one
            }
        }
    }
}

TEST(TemporalFrame, ACameraThatMovesSeesEdgesNearerToTheTruthThanASingleFrame) {
    const Scene scene = findBuiltinScene("cubes")->make();
    std::vector<View> path(12, defaultView(scene));
    for (size_t i = 0; i < path.size(); ++i) {
        path[i].camera.position += vec3(0.02F, 0.005F, 0.01F) * float(i);
    }
    const FloatImage truth =
        render(scene, path.back(), size, settingsWith({"accumulate.enabled=on"}), {"final"}, 128).images.at("final");
    const Pictures p =
        renderPath(scene, path, size, settingsWith({"temporal.enabled=on"}), {"final", "unfiltered"}).back();
    const double with = relativeMse(p.images.at("final"), truth);
    const double without =
        relativeMse(render(scene, path.back(), size, settingsWith({}), {"final"}).images.at("final"), truth);
    RecordProperty("with", std::to_string(with));
    RecordProperty("without", std::to_string(without));
    const double unfiltered = relativeMse(p.images.at("unfiltered"), truth);
    // An unjittered frame is nearer to the reference than the jittered ones that are averaged.
    EXPECT_LT(with, 0.9 * without) << with << " of " << without;
    EXPECT_LT(with, 0.45 * unfiltered) << with << " of " << unfiltered;
}

TEST(TemporalFrame, LayersAreThoseOfTheFrameAndTheirSumIsThePictureBefore) {
    const Scene scene = findBuiltinScene("gloss")->make();
    const std::vector<std::string> shows{"final", "unfiltered", "direct", "indirect_diffuse", "indirect_specular"};
    const Pictures p = render(scene, defaultView(scene), size, settingsOf({"temporal.enabled=on"}), shows, 3);
    for (size_t i = 0; i < p.images.at("final").data.size(); ++i) {
        const float sum = p.images.at("direct").data[i] + p.images.at("indirect_diffuse").data[i] +
                          p.images.at("indirect_specular").data[i];
        ASSERT_NEAR(p.images.at("unfiltered").data[i], sum, 0.002F * sum + 1e-4F);
    }
    EXPECT_NE(p.images.at("final").data, p.images.at("unfiltered").data);
    const Pictures without = render(scene, defaultView(scene), size, settingsOf({}), {"final", "unfiltered"}, 2);
    EXPECT_EQ(without.images.at("final").data, without.images.at("unfiltered").data);
}

TEST(TemporalFrame, TheSameFramesGiveTheSameBytes) {
    const Scene scene = findBuiltinScene("cubes")->make();
    const auto picture = [&] {
        return render(scene, defaultView(scene), size,
                      settingsOf({"temporal.enabled=on", "trace_screen.light=previous"}), {"final", "temporal_frames"},
                      6);
    };
    const Pictures a = picture();
    const Pictures b = picture();
    EXPECT_EQ(a.images.at("final").data, b.images.at("final").data);
    EXPECT_EQ(a.images.at("temporal_frames").data, b.images.at("temporal_frames").data);
}

TEST(TemporalFrame, ReflectionsOfTheLastFramesLightStayWhereTheyAreUnderJitter) {
    // A mirror in front of striped walls, which do not reflect: the light of the last frame equals that of this one.
    const Scene scene = findBuiltinScene("tilted-cube")->make();
    const View view = defaultView(scene);
    const auto reflections = [&](const char* light, const char* jitter) {
        return render(scene, view, size,
                      settingsOf({"diffuse.rays=0", "shadow.filter=hard", "planar.enabled=false", jitter,
                                  "trace_screen.method=exhaustive", std::string("trace_screen.light=") + light}),
                      {"indirect_specular"}, 3)
            .images.at("indirect_specular");
    };
    const auto difference = [&](const char* jitter) {
        return relativeMse(reflections("previous", jitter), reflections("direct", jitter));
    };
    const double still = difference("temporal.enabled=off");
    const double jittered = difference("temporal.enabled=on");
    RecordProperty("still", std::to_string(still));
    RecordProperty("jittered", std::to_string(jittered));
    EXPECT_LT(jittered, still + 0.01);
}

TEST(TemporalFrame, DenoisedShadowsConvergeUnderJitterToo) {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({8, 8}, {1, 1}, {1, 1}));
    builtin::place(scene, "ceiling", 0, builtin::box({3.0F, 0.005F, 6.0F}), builtin::at({-3, 2, 0}));
    View view;
    view.camera.position = {0.4F, 1.5F, 4.5F};
    view.camera.target = {0.1F, 0, 0.5F};
    view.sun = builtin::sun({0, -1, 0}, vec3(1.0F));
    view.sun.angularDiameter = glm::radians(6.0F);
    const std::vector<std::string> soft{"diffuse.rays=0", "specular.rays=0", "shadow.filter=pcss", "shadow.history=32"};
    const auto visibility = [&](const char* jitter, uint32_t frames, const char* samples = "shadow.samples=16") {
        std::vector<std::string> all = soft;
        all.emplace_back(jitter);
        all.emplace_back(samples);
        return render(scene, view, size, settingsOf(all), {"sun_visibility"}, frames).images.at("sun_visibility").data;
    };
    const auto errorOf = [&](const std::vector<float>& v, const std::vector<float>& truth) {
        double sum = 0.0;
        for (size_t i = 0; i < v.size(); ++i) {
            sum += (v[i] - truth[i]) * (v[i] - truth[i]);
        }
        return sum / double(v.size());
    };
    const char* off = "temporal.enabled=off";
    const char* on = "temporal.enabled=on";
    const double first = errorOf(visibility(off, 1), visibility(off, 1, "shadow.samples=256"));
    const double still = errorOf(visibility(off, 32), visibility(off, 32, "shadow.samples=256"));
    const double jittered = errorOf(visibility(on, 32), visibility(on, 32, "shadow.samples=256"));
    RecordProperty("first", std::to_string(first));
    RecordProperty("still", std::to_string(still));
    RecordProperty("jittered", std::to_string(jittered));
    // A frame is jittered by up to half a pixel against the mean of the earlier ones, over which the penumbra has a
    // slope.
    EXPECT_LT(still, 0.5 * first);
    EXPECT_LT(jittered, 2e-4) << still << ", first frame " << first;
}

TEST(TemporalFrame, NothingThatWasInFrontOfTheSkyLeavesAGhost) {
    Scene scene;
    for (int i = -3; i <= 3; ++i) {
        const Scene post = sceneOf(lambertMaterial(vec3(0.9F, 0.2F, 0.1F)), builtin::box(vec3(0.05F, 4.0F, 0.05F)));
        Instance instance = post.instances.front();
        instance.mesh = static_cast<uint32_t>(scene.meshes.size());
        instance.objectToWorld = glm::translate(mat4(1.0F), vec3(0.7F * float(i), 0.0F, 0.0F));
        scene.meshes.push_back(post.meshes.front());
        scene.meshes.back().material = static_cast<uint32_t>(scene.materials.size());
        scene.materials.push_back(post.materials.front());
        scene.instances.push_back(instance);
    }
    View view;
    view.camera.position = {0, 0, 5};
    view.environment.radiance = {0.3F, 0.5F, 0.8F};
    view.sun.irradiance = vec3(3.0F);
    view.sun.direction = glm::normalize(vec3(0.2F, -0.5F, -1.0F));
    std::vector<View> path(12, view);  // at rest: the edges are in the frames by turns
    for (int i = 1; i <= 4; ++i) {
        View turned = view;
        const float angle = glm::radians(6.0F * float(i));
        turned.camera.position = 5.0F * vec3(std::sin(angle), 0.0F, std::cos(angle));
        path.push_back(turned);
    }
    const std::vector<Pictures> frames =
        renderPath(scene, path, size, settingsWith({"temporal.enabled=on"}), {"final", "depth"});
    for (size_t i = 12; i < frames.size(); ++i) {
        const Pictures& p = frames[i];
        int sky = 0;
        for (unsigned y = 2; y + 2 < size.y; ++y) {
            for (unsigned x = 2; x + 2 < size.x; ++x) {
                bool empty = true;
                for (unsigned k = 0; k < 25; ++k) {
                    empty = empty && !p.hasSurface(x - 2 + k % 5, y - 2 + k / 5);
                }
                if (empty) {
                    EXPECT_LT(glm::length(p.color("final", x, y) - view.environment.radiance), 0.01F)
                        << "frame " << i << ", pixel " << x << ' ' << y;
                    ++sky;
                }
            }
        }
        EXPECT_GT(sky, 1000);
    }
}

}  // namespace
}  // namespace reflet::test::temporal_frame_test
