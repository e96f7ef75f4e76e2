// The recorded mirror ray of one pixel is the ray that the frame traced.
#include "effects/lobe/record_ray.h"

#include "pass/mirror_room.h"
#include "support/device_fixture.h"

namespace reflet::test::record_ray_test {
namespace {

constexpr uvec2 size{64, 36};

class RecordRay : public DeviceTest {
protected:
    RecordRay() : scene_(makeMirrorRoom()), view_(viewOfMirrorRoom()) {}

    // The recorded rays of some pixels; with a frame of the same settings beside them.
    std::vector<std::optional<RecordedRay>> record(const Settings& settings, const std::vector<uvec2>& pixels) {
        Renderer renderer(device(), scene_, [](const std::string&) {});
        std::vector<std::optional<RecordedRay>> rays;
        for (const uvec2& pixel : pixels) {
            gpu::Readback readback;
            renderer.render(view_, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
                readback = recordRay(f, {images.g, images.backDepth, images.pyramid},
                                     makeViewParams(view_.camera, size, 0, 0), settings.traceScreen, pixel);
            });
            rays.push_back(recordedRay(renderer.frame(), readback));
        }
        return rays;
    }

    Scene scene_;
    View view_;
};

TEST_F(RecordRay, IsTheRayOfTheFrame) {
    for (const char* method : {"exhaustive", "hiz", "dda", "linear", "halving"}) {
        const Settings settings =
            settingsOf({"diffuse.rays=0", "specular.rays=1", "trace_screen.jitter=false", "trace_screen.edge_fade=0.2",
                        "trace_screen.count_hits=true", std::string("trace_screen.method=") + method});
        const Pictures p = render(scene_, view_, size, settings, {"depth", "roughness", "hit_distance", "confidence"});
        std::vector<uvec2> mirrors;
        for (uvec2 pixel(2, 4); pixel.y < size.y; pixel.y += 5) {
            for (pixel.x = 2; pixel.x < size.x; pixel.x += 7) {
                if (p.hasSurface(pixel.x, pixel.y) && p.value("roughness", pixel.x, pixel.y) == 0.0F) {
                    mirrors.push_back(pixel);
                }
            }
        }
        ASSERT_GT(mirrors.size(), 10U);
        const auto rays = record(settings, mirrors);
        int hits = 0;
        for (size_t i = 0; i < mirrors.size(); ++i) {
            ASSERT_TRUE(rays[i]);
            const bool answered = rays[i]->outcome == RayOutcome::hit && !rays[i]->unseen;
            const float confidence = p.value("confidence", mirrors[i].x, mirrors[i].y, 1);
            EXPECT_NEAR(answered ? rays[i]->confidence : 0.0F, confidence, 0.01F)
                << method << ' ' << mirrors[i].x << ' ' << mirrors[i].y;
            if (answered && confidence > 0.99F) {
                const float distance = p.value("hit_distance", mirrors[i].x, mirrors[i].y, 1);
                EXPECT_NEAR(rays[i]->distance, distance, 0.01F * distance) << method;
            }
            EXPECT_NEAR(rays[i]->confidence, rays[i]->edge * rays[i]->far * rays[i]->camera, 1e-5F);
            hits += answered ? 1 : 0;
        }
        EXPECT_GE(hits, 3) << method;
    }
}

TEST_F(RecordRay, HasAStepForEachDepthThatWasLookedAt) {
    const Settings settings = settingsOf({"trace_screen.method=exhaustive", "specular.rays=1"});
    const auto ray = record(settings, {{size.x / 2, size.y / 2}}).front();
    ASSERT_TRUE(ray);
    ASSERT_GT(ray->steps.size(), 1U);
    EXPECT_EQ(ray->steps.size(), ray->samples);
    EXPECT_EQ(ray->steps.front().cell, uvec2(size.x / 2, size.y / 2)) << "where it starts";
    for (const RayStep& step : ray->steps) {
        EXPECT_EQ(step.level, 0U);
        EXPECT_TRUE(glm::all(glm::lessThan(step.cell, size)));
    }
}

// Its rays are as many as one pixel's of the frame, in other directions of the same distribution.
TEST_F(RecordRay, AsManyDiffuseRaysHitTheScreenAsInTheFrame) {
    const Settings settings = settingsOf({"diffuse.rays=64", "specular.rays=0", "trace_screen.jitter=false"});
    const Pictures p = render(scene_, view_, size, settings, {"depth", "confidence"});
    std::vector<float> shares;
    for (uint32_t x = 1; x < size.x; x += 9) {
        const uvec2 pixel(x, size.y * 2 / 3);
        if (!p.hasSurface(pixel.x, pixel.y)) {
            continue;
        }
        Renderer renderer(device(), scene_, [](const std::string&) {});
        gpu::Readback readback;
        renderer.render(view_, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
            readback = recordHemisphere(f, {images.g, images.backDepth, images.pyramid},
                                        makeViewParams(view_.camera, size, 0, 0), settings.traceScreen, pixel);
        });
        const std::vector<RecordedSample> samples = recordedHemisphere(renderer.frame(), readback);
        ASSERT_EQ(samples.size(), recordedSamples);
        float hits = 0.0F;
        for (const RecordedSample& sample : samples) {
            EXPECT_NEAR(glm::length(sample.direction), 1.0F, 1e-4F);
            hits += sample.hits ? 1.0F : 0.0F;
        }
        shares.push_back(hits / float(recordedSamples));
        EXPECT_NEAR(shares.back(), p.value("confidence", pixel.x, pixel.y, 0), 0.12F) << pixel.x << ' ' << pixel.y;
    }
    ASSERT_GT(shares.size(), 3U);
    EXPECT_GT(*std::ranges::max_element(shares) - *std::ranges::min_element(shares), 0.1F) << "pixels that differ";
}

TEST_F(RecordRay, SaysThatTheSkyHasNone) {
    scene_ = sceneOf(lambertMaterial(vec3(0.5F)), builtin::box(vec3(0.1F)));
    view_ = View{};
    view_.camera.position = {0, 0, 3};
    const auto rays = record(settingsOf({"specular.rays=1"}), {{0, 0}, {size.x / 2, size.y / 2}});
    EXPECT_FALSE(rays[0]);
    EXPECT_TRUE(rays[1]);
}

}  // namespace
}  // namespace reflet::test::record_ray_test
