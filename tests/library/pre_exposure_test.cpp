// Pre-exposure: whatever a host has multiplied its radiance by, the same comes out, multiplied by that.
#include "library/library_fixture.h"

#include <array>
#include <cmath>
#include <map>

namespace reflet::test::pre_exposure_test {
namespace {

constexpr uint32_t frames = 12;

// Radiance of a frame, and its tone map.
struct Pictures {
    std::array<std::vector<vec4>, 6> radiance;  // without pre-exposure
    std::vector<glm::u8vec4> display;
    float exposure = 0.0F;
};

constexpr const char* names[] = {"diffuse", "specular", "lit", "indirect diffuse", "antialiased", "defocused"};

class PreExposure : public Library {
protected:
    PreExposure() : context_(host_.makeContext()), settings_(makeSettings("balanced")) {
        EXPECT_REFLET(refletSetSetting(settings_, "diffuse.adaptive", "true"));
        texels_ = host_.texelsOfInput(room_.light().light);
    }
    ~PreExposure() override {
        host_.host.waitForAll();
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
    }

    RefletImage lightTimes(float factor) {
        const auto known = lights_.find(factor);
        if (known != lights_.end()) {
            return known->second;
        }
        std::vector<vec4> scaled = texels_;
        for (vec4& texel : scaled) {
            texel = vec4(factor * vec3(texel), texel.a);
        }
        return lights_[factor] =
                   host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, HostRoom::width, HostRoom::height, scaled);
    }

    // The last frame; factors: pre-exposures. With lobes that the host has traced, and its own picture for
    // antialiasing, or with all that the library makes itself.
    Pictures render(const std::array<float, frames>& factors, bool own, uint32_t shown = frames) {
        RefletView view = makeView(context_, 3);
        RefletLobe diffuse = emptyLobe();
        RefletLobe specular = emptyLobe();
        RefletComposite sum{sizeof sum, {}, {}, {}};
        RefletImage antialiased{};
        RefletImage defocused{};
        RefletDisplay display{sizeof display, {}, {}};
        for (uint32_t i = 0; i < shown; ++i) {
            const RefletImage lit = lightTimes(factors[i]);
            host_.host.frame([&](VkCommandBuffer commands) {
                RefletFrameInfo frame = room_.frame(commands, i);
                frame.preExposure = factors[i];
                RefletIndirectLight light = room_.light();
                light.light = lit;
                EXPECT_REFLET(refletBeginFrame(view, &frame));
                if (own) {
                    EXPECT_REFLET(refletDenoise(view, settings_, REFLET_LOBE_DIFFUSE, &lit, &diffuse));
                    EXPECT_REFLET(refletDenoise(view, settings_, REFLET_LOBE_SPECULAR, &lit, &specular));
                    EXPECT_REFLET(refletComposite(view, settings_, &lit, &sum));
                } else {
                    EXPECT_REFLET(refletDiffuseGi(view, settings_, &light, &diffuse));
                    EXPECT_REFLET(refletReflections(view, settings_, &light, &specular));
                    EXPECT_REFLET(refletComposite(view, settings_, nullptr, &sum));
                }
                EXPECT_REFLET(refletTemporal(view, settings_, own ? &lit : nullptr, &antialiased));
                const RefletLens lens{sizeof lens, 0.2F, 3.0F, 6, 0.1F};
                EXPECT_REFLET(refletDepthOfField(view, settings_, &lens, nullptr, &defocused));
                RefletToneMapInfo to{};
                to.structSize = sizeof to;
                to.autoExposure = 1;
                EXPECT_REFLET(refletToneMapTo(view, settings_, &to, &display));
                EXPECT_REFLET(refletEndFrame(view));
            });
        }
        host_.host.waitForAll();
        Pictures out;
        const RefletImage* images[] = {&diffuse.radiance,    &specular.radiance, &sum.lit,
                                       &sum.indirectDiffuse, &antialiased,       &defocused};
        for (size_t k = 0; k < out.radiance.size(); ++k) {
            out.radiance[k] = halvesOf(host_, *images[k]);
            for (vec4& texel : out.radiance[k]) {
                texel /= factors[shown - 1];
            }
        }
        out.display = texelsOf<glm::u8vec4>(host_, display.image);
        out.exposure = texelsOf<float>(host_, display.exposure).at(0);
        refletDestroyView(view);
        return out;
    }

    static double difference(const std::vector<vec4>& a, const std::vector<vec4>& b) {
        double sum = 0.0;
        double all = 0.0;
        for (size_t i = 0; i < a.size(); ++i) {
            sum += glm::compAdd(glm::abs(vec3(a[i]) - vec3(b[i])));
            all += glm::compAdd(vec3(b[i]));
        }
        return sum / all;
    }
    static void expectSame(const Pictures& changed, const Pictures& constant, double tolerance) {
        for (size_t k = 0; k < changed.radiance.size(); ++k) {
            EXPECT_LT(difference(changed.radiance[k], constant.radiance[k]), tolerance) << names[k];
        }
        double off = 0.0;
        for (size_t i = 0; i < changed.display.size(); ++i) {
            off += glm::compAdd(glm::abs(vec3(changed.display[i]) - vec3(constant.display[i])));
        }
        EXPECT_LT(off / double(changed.display.size()), 3.0) << "the display image, of 255";
        EXPECT_NEAR(std::log2(changed.exposure), std::log2(constant.exposure), 0.03F);
    }

    RefletContext context_;
    RefletSettings settings_;
    const HostRoom room_{host_, {.still = true}};
    std::vector<vec4> texels_;
    std::map<float, RefletImage> lights_;
};

std::array<float, frames> constant() {
    std::array<float, frames> all{};
    all.fill(1.0F);
    return all;
}

// Over 5 s: six runs of twelve frames with every effect.
TEST_F(PreExposure, ChangesNothingButTheFactor) {
    std::array<float, frames> wanders{};
    for (uint32_t i = 0; i < frames; ++i) {
        wanders[i] = std::exp2(1.7F * std::sin(1.3F * float(i)));
    }
    std::array<float, frames> jumps{};
    for (uint32_t i = 0; i < frames; ++i) {
        jumps[i] = i < frames - 1 ? 0.1F : 10.0F;  // in the last frame, by 100
    }
    std::array<float, frames> falls{};
    for (uint32_t i = 0; i < frames; ++i) {
        falls[i] = i < frames - 2 ? 10.0F : 0.1F;
    }
    for (const bool own : {false, true}) {
        SCOPED_TRACE(own ? "the host's lobes" : "traced lobes");
        const Pictures wanted = render(constant(), own);
        expectSame(render(wanders, own), wanted, 0.02);
        expectSame(render(jumps, own), wanted, 0.03);
        expectSame(render(falls, own), wanted, 0.03);
    }
}

// What the test above would say if the library did not follow.
TEST_F(PreExposure, TellsWhatIsNotFollowed) {
    std::array<float, frames> jumps{};
    jumps.fill(1.0F);
    jumps[frames - 1] = 2.0F;
    const Pictures wanted = render(constant(), false);
    const Pictures first = render(constant(), false, 1);
    EXPECT_GT(difference(first.radiance[0], wanted.radiance[0]), 0.06) << "a frame without history is noisier";
    expectSame(render(jumps, false), wanted, 0.02);
}

TEST_F(PreExposure, WrongOnesAreRefused) {
    RefletView view = makeView(context_, 3);
    host_.host.frame([&](VkCommandBuffer commands) {
        RefletFrameInfo frame = room_.frame(commands, 0);
        for (const float wrong : {-1.0F, 9e-9F, 1.1e8F, INFINITY, NAN}) {
            frame.preExposure = wrong;
            EXPECT_EQ(refletBeginFrame(view, &frame), REFLET_ERROR_INVALID_ARGUMENT) << wrong;
            EXPECT_NE(std::string(refletLastError()).find("RefletFrameInfo.preExposure: is"), std::string::npos);
        }
        frame.preExposure = 16.0F;
        EXPECT_REFLET(refletBeginFrame(view, &frame));
        RefletIndirectLight light = room_.light();
        RefletEnvironment bright = *light.environment;
        bright.factor[0] = 5000.0F;  // and 16 times that
        light.environment = &bright;
        RefletLobe lobe = emptyLobe();
        EXPECT_EQ(refletDiffuseGi(view, settings_, &light, &lobe), REFLET_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::string(refletLastError()).find("65504 / preExposure"), std::string::npos) << refletLastError();
        EXPECT_REFLET(refletEndFrame(view));
    });
    host_.host.waitForAll();
    refletDestroyView(view);
}

}  // namespace
}  // namespace reflet::test::pre_exposure_test
