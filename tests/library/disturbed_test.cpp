// One frame with values in a block of one input that no host means: nothing of them lasts.
#include "library/library_fixture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <memory>

namespace reflet::test::disturbed_test {
namespace {

constexpr uint32_t width = 48;
constexpr uint32_t height = 32;
constexpr uint32_t environmentWidth = 32;
constexpr uint32_t mapSide = 32;
constexpr VkFormat four = VK_FORMAT_R32G32B32A32_SFLOAT;

enum Input : uint8_t {
    depth,
    normal,
    geometricNormal,
    roughness,
    metallic,
    baseColor,
    f0,
    motion,
    backDepth,
    light,
    environment,
    shadowMap,
    noisy,
    color,
    inputs
};
constexpr std::array<const char*, inputs> names{
    "depth",      "normal", "geometric normal", "roughness",  "metallic",   "baseColor", "f0", "motion",
    "back depth", "light",  "environment",      "shadow map", "noisy lobe", "color"};

// Which effects run: those from light (with metallic or with f0), the denoiser of a host's lobe, antialiasing of a
// host's picture.
enum class Frames : uint8_t { lit, litByF0, denoised, antialiased };

Frames framesThatRead(Input input) {
    switch (input) {
        case f0:
            return Frames::litByF0;
        case noisy:
            return Frames::denoised;
        case color:
            return Frames::antialiased;
        default:
            return Frames::lit;
    }
}

// Whether it is radiance, which means at rest may keep.
bool shines(Input input) {
    return input == light || input == environment || input == noisy || input == color;
}

// A floor 1 m below the camera before a wall 6 m away; standard depth.
struct Texel {
    vec4 values[inputs];
};

Texel texelAt(vec2 ndc) {
    const float down = 0.8F * ndc.y * float(height) / float(width);
    const bool floor = down > 1.0F / 6.0F;
    const float z = floor ? 1.0F / down : 6.0F;
    const auto depthAt = [](float away) { return (50.0F - 0.1F * 50.0F / away) / 49.9F; };
    const vec4 n = floor ? vec4(0, 1, 0, 0) : vec4(0, 0, 1, 0);
    const vec4 shine(0.5F + 0.4F * ndc.x, 0.5F, 0.5F + 0.4F * ndc.y, 2.0F);
    Texel t{};
    t.values[depth] = vec4(depthAt(z));
    t.values[normal] = t.values[geometricNormal] = n;
    t.values[roughness] = vec4(floor ? 0.2F : 0.5F);
    t.values[baseColor] = vec4(0.7F, floor ? 0.7F : 0.3F, 0.5F, 1.0F);
    t.values[f0] = vec4(0.04F);
    t.values[backDepth] = vec4(depthAt(z + 0.5F));
    t.values[light] = t.values[noisy] = t.values[color] = shine;
    t.values[environment] = vec4(0.5F);
    t.values[shadowMap] = vec4(0.7F);
    return t;
}

// The images of a frame as they are, and with a block of other values in the middle.
class Room {
public:
    explicit Room(LibraryHost& host) : host_(host) {
        for (uint8_t input = 0; input < inputs; ++input) {
            clean_[input] = make(Input(input), 0.0F, false);
        }
        restore();
    }
    RefletImage make(Input input, float value, bool block) {
        const uint32_t w = input == environment ? environmentWidth : input == shadowMap ? mapSide : width;
        const uint32_t h = input == environment ? environmentWidth / 2 : input == shadowMap ? mapSide : height;
        std::vector<vec4> texels;
        for (uint32_t i = 0; i < w * h; ++i) {
            const vec2 ndc = 2.0F * (vec2(i % w, i / w) + 0.5F) / vec2(w, h) - 1.0F;
            const bool inside = std::abs(ndc.x) < 0.4F && std::abs(ndc.y) < 0.5F;
            texels.push_back(block && inside ? vec4(value) : texelAt(ndc).values[input]);
        }
        if (input == depth || input == backDepth || input == shadowMap) {
            std::vector<float> depths;
            std::ranges::transform(texels, std::back_inserter(depths), [](const vec4& texel) { return texel.x; });
            return host_.makeImage(VK_FORMAT_R32_SFLOAT, w, h, depths);
        }
        return host_.makeImage(four, w, h, texels);
    }
    /// other: given in the place of one input.
    void disturb(Input input, const RefletImage& other) {
        now_ = clean_;
        now_[input] = other;
    }
    void restore() { now_ = clean_; }
    [[nodiscard]] const RefletImage& at(Input input) const { return now_[input]; }

private:
    LibraryHost& host_;
    std::array<RefletImage, inputs> clean_{};
    std::array<RefletImage, inputs> now_{};
};

// g: is filled, and referred to.
RefletFrameInfo frameOf(const Room& room, VkCommandBuffer commands, uint32_t index, bool rests, bool hasF0,
                        RefletGBuffer& g) {
    RefletFrameInfo info{};
    info.structSize = sizeof info;
    info.commandBuffer = commands;
    info.frameIndex = index;
    info.restFrames = rests ? 20 + index : 0;
    info.elapsed = 0.03F;
    for (int i = 0; i < 4; ++i) {
        info.worldToView[5 * i] = 1.0F;
    }
    info.viewToClip[0] = 1.0F / 0.8F;
    info.viewToClip[5] = -float(width) / (0.8F * height);
    info.viewToClip[10] = 50.0F / (0.1F - 50.0F);
    info.viewToClip[11] = -1.0F;
    info.viewToClip[14] = 0.1F * 50.0F / (0.1F - 50.0F);
    g = {};
    g.structSize = sizeof g;
    info.gbuffer = &g;
    g.depthKind = REFLET_DEPTH_STANDARD;
    g.depth = room.at(depth);
    g.normal = room.at(normal);
    g.normalKind = REFLET_NORMAL_VECTOR_SNORM;
    g.geometricNormal = room.at(geometricNormal);
    g.roughness = room.at(roughness);
    g.metallic = room.at(metallic);
    g.baseColor = room.at(baseColor);
    g.f0 = hasF0 ? room.at(f0) : RefletImage{};
    g.motion = room.at(motion);
    g.backDepth = room.at(backDepth);
    return info;
}

struct Pictures {
    RefletImage antialiased{};
    RefletImage visibility{};
    RefletImage blurred{};  ///< by the lens and the shutter
};

// environmentFactor: of the image, or without an image the radiance.
void lightFrame(const Room& room, RefletView view, RefletSettings settings, float environmentFactor, Pictures& out) {
    RefletSunShadow sun{};
    sun.structSize = sizeof sun;
    sun.map = room.at(shadowMap);
    sun.depthKind = REFLET_DEPTH_STANDARD;
    sun.cascades = 1;
    sun.worldToClip[0][0] = sun.worldToClip[0][9] = 0.1F;
    sun.worldToClip[0][6] = -0.05F;
    sun.worldToClip[0][14] = 0.5F;
    sun.worldToClip[0][15] = 1.0F;
    sun.toSun[0] = 0.1F;
    sun.toSun[1] = 1.0F;
    sun.angularDiameter = 0.03F;
    EXPECT_REFLET(refletSunShadow(view, settings, &sun, &out.visibility));
    RefletImage occlusion{};
    EXPECT_REFLET(refletAmbientOcclusion(view, settings, &occlusion));
    RefletIndirectLight indirect{};
    indirect.structSize = sizeof indirect;
    indirect.light = room.at(light);
    RefletEnvironment around{};
    around.structSize = sizeof around;
    around.image = room.at(environment);
    around.revision = std::bit_cast<uintptr_t>(room.at(environment).image);
    std::fill_n(around.factor, 3, environmentFactor);
    indirect.environment = &around;
    RefletLobe lobe = emptyLobe();
    EXPECT_REFLET(refletDiffuseGi(view, settings, &indirect, &lobe));
    EXPECT_REFLET(refletReflections(view, settings, &indirect, &lobe));
}

class Disturbed : public Library {
protected:
    void SetUp() override {
        context_ = host_.makeContext();
        settings_ = makeSettings("balanced");
        EXPECT_REFLET(refletSetSetting(settings_, "shadow.history", "32"));
        EXPECT_REFLET(refletSetSetting(settings_, "ao.method", "horizon"));
        EXPECT_REFLET(refletSetSetting(settings_, "motion_blur.enabled", "true"));
        view_ = makeView(context_, 3, width, height);
        room_ = std::make_unique<Room>(host_);
    }
    void TearDown() override {
        refletDestroyView(view_);
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
        Library::TearDown();
    }

    static constexpr uint32_t disturbedFrame = 6;
    static constexpr uint32_t cleanFrames = 8;

    Pictures record(VkCommandBuffer commands, uint32_t index, Frames frames, bool rests) {
        Pictures out;
        RefletGBuffer gbuffer{};
        const RefletFrameInfo info = frameOf(*room_, commands, index, rests, frames == Frames::litByF0, gbuffer);
        EXPECT_REFLET(refletBeginFrame(view_, &info));
        if (frames == Frames::denoised) {
            RefletLobe lobe = emptyLobe();
            for (const RefletLobeKind kind : {REFLET_LOBE_DIFFUSE, REFLET_LOBE_SPECULAR}) {
                EXPECT_REFLET(refletDenoise(view_, settings_, kind, &room_->at(noisy), &lobe));
            }
        } else {
            lightFrame(*room_, view_, settings_, index == disturbedFrame ? factorThen_ : 1.0F, out);
        }
        RefletComposite sum{};
        sum.structSize = sizeof sum;
        const RefletImage* own = frames == Frames::denoised ? &room_->at(light) : nullptr;
        EXPECT_REFLET(refletComposite(view_, settings_, own, &sum));
        const RefletImage* picture = frames == Frames::antialiased ? &room_->at(color) : nullptr;
        EXPECT_REFLET(refletTemporal(view_, settings_, picture, &out.antialiased));
        const RefletLens lens{sizeof lens, 0.02F, 3.0F, 0, 0.0F};
        EXPECT_REFLET(refletDepthOfField(view_, settings_, &lens, nullptr, &out.blurred));
        EXPECT_REFLET(refletMotionBlur(view_, settings_, nullptr, &out.blurred));
        RefletImage display{};
        EXPECT_REFLET(refletToneMap(view_, settings_, nullptr, 1, &display));
        EXPECT_REFLET(refletEndFrame(view_));
        return out;
    }

    /// The picture after the clean frames. other: none: no frame is disturbed.
    std::vector<vec4> pictureAfter(Input input, const RefletImage* other, bool rests) {
        EXPECT_REFLET(refletResetView(view_));
        Pictures last;
        for (uint32_t i = 0; i <= disturbedFrame + cleanFrames; ++i) {
            room_->restore();
            if (other != nullptr && i == disturbedFrame) {
                room_->disturb(input, *other);
            }
            host_.host.frame([&](VkCommandBuffer c) { last = record(c, i, framesThatRead(input), rests); });
            if (i == disturbedFrame) {
                host_.host.waitForAll();
                for (const vec4& texel : halvesOf(host_, last.blurred)) {
                    EXPECT_TRUE(std::isfinite(texel.x + texel.y + texel.z)) << names[input];
                }
            }
        }
        host_.host.waitForAll();
        return halvesOf(host_, last.antialiased);
    }

    RefletContext context_ = nullptr;
    RefletSettings settings_ = nullptr;
    RefletView view_ = nullptr;
    std::unique_ptr<Room> room_;
    float factorThen_ = 1.0F;  ///< on the environment, in the disturbed frame
};

double relativeError(const std::vector<vec4>& picture, const std::vector<vec4>& wanted) {
    double sum = 0.0;
    for (size_t i = 0; i < picture.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double off = picture[i][c] - wanted[i][c];
            sum += off * off / (double(wanted[i][c]) * wanted[i][c] + 1e-3);
        }
    }
    return sum / (3.0 * double(picture.size()));
}

// Takes 20 s on two busy cores: each input of the API, with a value of each kind: not finite, and too large. Of
// surfaces histories keep less at rest than in motion.
TEST_F(Disturbed, NothingOfABlockLasts) {
    for (const bool rests : {false, true}) {
        std::vector<vec4> wanted[4];
        for (const Input input : {light, f0, noisy, color}) {
            wanted[size_t(framesThatRead(input))] = pictureAfter(input, nullptr, rests);
        }
        for (uint8_t i = 0; i < inputs; ++i) {
            for (const float value : {i % 2 == 0 ? INFINITY : NAN, 65504.0F}) {
                if (rests && !shines(Input(i))) {
                    continue;
                }
                const RefletImage other = room_->make(Input(i), value, true);
                const double error =
                    relativeError(pictureAfter(Input(i), &other, rests), wanted[size_t(framesThatRead(Input(i)))]);
                EXPECT_LT(error, 0.02) << names[i] << " of " << value << (rests ? " at rest" : " in motion");
            }
        }
    }
}

TEST_F(Disturbed, NothingOfABrightFactorLasts) {
    for (const bool rests : {false, true}) {
        factorThen_ = 1.0F;
        const std::vector<vec4> wanted = pictureAfter(light, nullptr, rests);
        factorThen_ = 1000.0F;
        EXPECT_LT(relativeError(pictureAfter(light, nullptr, rests), wanted), 0.02) << rests;
    }
}

TEST_F(Disturbed, LightIsBoundedAndKeepsItsHue) {
    EXPECT_REFLET(refletSetSetting(settings_, "input.max_radiance", "100"));
    room_->restore();
    room_->disturb(
        light, host_.makeImage(four, width, height, std::vector<vec4>(size_t(width) * height, {3e38F, 1e38F, 0, 1})));
    host_.host.frame([&](VkCommandBuffer c) { record(c, 0, Frames::lit, false); });
    host_.host.waitForAll();
    RefletImage imported{};
    EXPECT_REFLET(refletFindImage(view_, "light", &imported));
    for (const vec4& texel : halvesOf(host_, imported)) {
        ASSERT_NEAR(0.2126F * texel.x + 0.7152F * texel.y, 100.0F, 0.2F);
        ASSERT_NEAR(texel.x, 3.0F * texel.y, 0.01F * texel.x);
    }
}

TEST_F(Disturbed, FactorsAndTimesHaveARange) {
    host_.host.frame([&](VkCommandBuffer commands) {
        RefletGBuffer gbuffer{};
        RefletFrameInfo info = frameOf(*room_, commands, 0, false, false, gbuffer);
        info.elapsed = NAN;
        EXPECT_EQ(refletBeginFrame(view_, &info), REFLET_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::string(refletLastError()).find("elapsed"), std::string::npos) << refletLastError();
        info.elapsed = 0.03F;
        EXPECT_REFLET(refletBeginFrame(view_, &info));
        RefletIndirectLight indirect{};
        indirect.structSize = sizeof indirect;
        indirect.light = room_->at(light);
        RefletEnvironment around{};
        around.structSize = sizeof around;
        around.factor[1] = 1e38F;
        indirect.environment = &around;
        RefletLobe lobe = emptyLobe();
        EXPECT_EQ(refletDiffuseGi(view_, settings_, &indirect, &lobe), REFLET_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::string(refletLastError()).find("0 to 65504"), std::string::npos) << refletLastError();
        EXPECT_REFLET(refletEndFrame(view_));
    });
    host_.host.waitForAll();
}

}  // namespace
}  // namespace reflet::test::disturbed_test
