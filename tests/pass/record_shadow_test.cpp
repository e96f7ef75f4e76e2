// The recorded shadow of one pixel is the shadow of the frame.
#include "effects/shadow/record_shadow.h"

#include "pass/harness.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"

#include <cmath>

namespace reflet::test::record_shadow_test {
namespace {

constexpr uvec2 size{60, 34};

class RecordShadow : public DeviceTest {
protected:
    RecordShadow() : scene_(findBuiltinScene("colonnade")->make()), view_(defaultView(scene_)) {}

    // Of pixels with a surface, in a row.
    std::vector<std::pair<uvec2, RecordedShadow>> record(const Settings& settings, const Pictures& p) {
        Renderer renderer(device(), scene_, [](const std::string&) {});
        std::vector<std::pair<uvec2, RecordedShadow>> all;
        const float slope = std::tan(0.5F * view_.sun.angularDiameter);
        for (uvec2 pixel(1, size.y * 3 / 4); pixel.x < size.x; pixel.x += 5) {
            if (!p.hasSurface(pixel.x, pixel.y)) {
                continue;
            }
            gpu::Readback readback;
            renderer.render(view_, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
                readback = recordShadow(f, images.g, {{images.shadowMap}, images.shadowRange, {}},
                                        {images.view, images.sun, settings.shadow, slope, pixel});
            });
            all.emplace_back(pixel, recordedShadow(renderer.frame(), readback));
        }
        return all;
    }

    Scene scene_;
    View view_;
};

TEST_F(RecordShadow, HasTheVisibilityOfTheFrame) {
    for (const char* filter : {"hard", "pcss"}) {
        const Settings settings =
            settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.denoise=false", "shadow.samples=64",
                        "shadow.blocker_samples=64", std::string("shadow.filter=") + filter});
        const Pictures p = render(scene_, view_, size, settings, {"depth", "sun_visibility", "normal"});
        const auto all = record(settings, p);
        ASSERT_GT(all.size(), 6U);
        int lit = 0;
        int shadowed = 0;
        for (const auto& [pixel, shadow] : all) {
            const vec3 normal(p.value("normal", pixel.x, pixel.y, 0), p.value("normal", pixel.x, pixel.y, 1),
                              p.value("normal", pixel.x, pixel.y, 2));
            if (glm::dot(normal, -view_.sun.direction) < 0.1F) {
                continue;  // faces away: the shadow map is not asked
            }
            const float visible = p.value("sun_visibility", pixel.x, pixel.y);
            EXPECT_NEAR(shadow.visibility, visible, 0.12F) << filter << ' ' << pixel.x;
            lit += shadow.visibility > 0.9F ? 1 : 0;
            shadowed += shadow.visibility < 0.1F ? 1 : 0;
        }
        EXPECT_GT(lit, 0) << filter;
        EXPECT_GT(shadowed, 0) << filter;
    }
}

TEST_F(RecordShadow, DrawsBlockersTowardTheSunAndTheOthersBesideThePoint) {
    const Settings settings = settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.early_out=false"});
    const Pictures p = render(scene_, view_, size, settings, {"depth"});
    size_t blocking = 0;
    for (const auto& [pixel, shadow] : record(settings, p)) {
        EXPECT_LE(shadow.texels.size(), size_t(shadow.lookups));
        for (const RecordedShadow::Texel& texel : shadow.texels) {
            const float height = glm::dot(texel.place - shadow.point, -view_.sun.direction);
            blocking += texel.blocks ? 1 : 0;
            if (texel.blocks) {
                EXPECT_GT(height, 0.0F);
            } else {
                EXPECT_NEAR(height, 0.0F, 1e-3F);
            }
        }
    }
    EXPECT_GT(blocking, 10U);
}

}  // namespace
}  // namespace reflet::test::record_shadow_test
