// The masks of a host's G-buffer: what rays do not see, what reflects nothing, what antialiasing forgets.
#include "library/library_fixture.h"

#include <vector>

namespace reflet::test {
namespace {

constexpr uint32_t across = HostRoom::width;

// A square on the wall, which the floor reflects.
bool inSquare(size_t i) {
    const auto x = static_cast<uint32_t>(i % across);
    const auto y = static_cast<uint32_t>(i / across);
    return x >= 24 && x < 40 && y >= 10 && y < 16;
}

class Masks : public Library {
protected:
    Masks() : context_(host_.makeContext()), settings_(makeSettings("balanced")) {
        EXPECT_REFLET(refletSetSetting(settings_, "trace_screen.light", "lit"));
        texels_ = host_.texelsOfInput(room_.light().light);
    }
    ~Masks() override {
        host_.host.waitForAll();
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
    }

    // Red in the square is what the mask's third channel holds.
    RefletImage mask(float inside) {
        std::vector<vec4> mask;
        for (size_t i = 0; i < texels_.size(); ++i) {
            mask.emplace_back(0.0F, 0.0F, inSquare(i) ? inside : 0.0F, 0.0F);
        }
        return host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, across, HostRoom::height, mask);
    }
    RefletImage light(float square) {
        std::vector<vec4> changed = texels_;
        for (size_t i = 0; i < changed.size(); ++i) {
            changed[i] = inSquare(i) ? vec4(vec3(square), 1.0F) : changed[i];
        }
        return host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, across, HostRoom::height, changed);
    }
    struct Out {
        std::vector<vec4> lit;
        std::vector<vec4> specular;
        std::vector<vec4> antialiased;
    };
    // The last of some frames at rest; lights: of each.
    Out render(const RefletGBuffer& gbuffer, const std::vector<RefletImage>& lights) {
        RefletView view = makeView(context_, 3);
        RefletComposite sum{};
        sum.structSize = sizeof sum;
        RefletImage antialiased{};
        for (uint32_t i = 0; i < lights.size(); ++i) {
            host_.host.frame([&](VkCommandBuffer commands) {
                RefletFrameInfo frame = room_.frame(commands, i);
                frame.gbuffer = &gbuffer;
                RefletIndirectLight indirect = room_.light();
                indirect.light = lights[i];
                RefletLobe lobe = emptyLobe();
                EXPECT_REFLET(refletBeginFrame(view, &frame));
                EXPECT_REFLET(refletReflections(view, settings_, &indirect, &lobe));
                EXPECT_REFLET(refletComposite(view, settings_, nullptr, &sum));
                EXPECT_REFLET(refletTemporal(view, settings_, nullptr, &antialiased));
                EXPECT_REFLET(refletEndFrame(view));
            });
        }
        host_.host.waitForAll();
        const Out out{halvesOf(host_, sum.lit), halvesOf(host_, sum.indirectSpecular), halvesOf(host_, antialiased)};
        refletDestroyView(view);
        return out;
    }
    [[nodiscard]] RefletGBuffer gbuffer() const {
        RefletGBuffer g = *room_.frame(nullptr, 0).gbuffer;
        g.motion = {};  // nothing moves
        return g;
    }
    // Sum over the floor.
    static float reflected(const Out& out) {
        float sum = 0.0F;
        for (size_t i = size_t(across) * 22; i < out.specular.size(); ++i) {
            sum += out.specular[i].y;
        }
        return sum;
    }

    RefletContext context_;
    RefletSettings settings_;
    const HostRoom room_{host_, {}};
    std::vector<vec4> texels_;
};

TEST_F(Masks, RaysDoNotSeeWhatIsExcluded) {
    const RefletImage dark = light(0.0F);
    const RefletImage bright = light(20.0F);
    RefletGBuffer g = gbuffer();
    const float seenBright = reflected(render(g, {bright, bright, bright, bright}));
    const float seenDark = reflected(render(g, {dark, dark, dark, dark}));
    g.excluded = mask(1.0F);
    g.excludedChannel = 2;
    const Out excluded = render(g, {bright, bright, bright, bright});
    const float excludedDark = reflected(render(g, {dark, dark, dark, dark}));
    EXPECT_GT(seenBright, 1.3F * seenDark) << "the floor reflects the square";
    EXPECT_NEAR(reflected(excluded), excludedDark, 0.01F * excludedDark) << "not where it is excluded";
    for (size_t i = 0; i < texels_.size(); ++i) {
        if (inSquare(i)) {
            ASSERT_NEAR(excluded.lit[i].y, 20.0F, 0.05F) << "it keeps the host's light";
            ASSERT_NEAR(excluded.specular[i].y, 0.0F, 1e-6F);
        }
    }
    g.excluded = mask(0.4F);
    EXPECT_NEAR(reflected(render(g, {bright, bright, bright, bright})), seenBright, 0.001F * seenBright);
}

TEST_F(Masks, WhatIsUnlitReflectsNothingAndIsSeen) {
    const RefletImage bright = light(20.0F);
    RefletGBuffer g = gbuffer();
    const Out lit = render(g, {bright, bright, bright});
    g.unlit = mask(1.0F);
    g.unlitChannel = 2;
    const Out unlit = render(g, {bright, bright, bright});
    float before = 0.0F;
    for (size_t i = 0; i < texels_.size(); ++i) {
        if (inSquare(i)) {
            before += lit.specular[i].y;
            ASSERT_NEAR(unlit.specular[i].y, 0.0F, 1e-6F) << i;
            ASSERT_NEAR(unlit.lit[i].y, 20.0F, 0.05F) << i;
        }
    }
    EXPECT_GT(before, 0.01F);
    EXPECT_NEAR(reflected(unlit), reflected(lit), 0.02F * reflected(lit));
}

TEST_F(Masks, AntialiasingForgetsWhatIsReactive) {
    EXPECT_REFLET(refletSetSetting(settings_, "temporal.clip", "0"));
    const std::vector<RefletImage> lights = {light(1.0F), light(1.0F), light(1.0F), light(3.0F)};
    RefletGBuffer g = gbuffer();
    const size_t middle = size_t(across) * 13 + 32;
    const float kept = render(g, lights).antialiased[middle].y;
    g.reactive = mask(1.0F);
    g.reactiveChannel = 2;
    const Out forgotten = render(g, lights);
    EXPECT_LT(kept, 2.0F) << "a mean of four frames";
    EXPECT_NEAR(forgotten.antialiased[middle].y, forgotten.lit[middle].y, 0.02F);
    g.reactive = mask(0.5F);
    const float half = render(g, lights).antialiased[middle].y;
    EXPECT_GT(half, kept + 0.1F);
    EXPECT_LT(half, forgotten.antialiased[middle].y - 0.1F);
    EXPECT_NEAR(forgotten.antialiased[size_t(across) * 30 + 10].w,
                render(gbuffer(), lights).antialiased[size_t(across) * 30 + 10].w, 0.01F)
        << "the rest keeps its history";
}

}  // namespace
}  // namespace reflet::test
