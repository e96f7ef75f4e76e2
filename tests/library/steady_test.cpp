// A host's long run: sizes, cuts, masks and lamps change, and after the first rounds nothing is made or allocated any
// more. REFLET_LONG_RUN: how many frames (1000 take some minutes on a CPU).
#include "library/library_fixture.h"
#include "support/heap.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

namespace reflet::test::steady_test {
namespace {

constexpr std::array<uvec2, 4> sizes{uvec2(HostRoom::width, HostRoom::height), uvec2(56, 35), uvec2(41, 27),
                                     uvec2(48, 30)};
// After so many frames all comes again: a cut, 4 sizes, 0 to 2 lamps, with and without masks.
constexpr uint32_t roundFrames = 24;
constexpr uint32_t warmRounds = 3;

uint32_t framesToRun() {
    const char* asked = std::getenv("REFLET_LONG_RUN");  // NOLINT(concurrency-mt-unsafe): one thread
    const uint64_t frames = asked == nullptr ? 0 : std::strtoull(asked, nullptr, 10);
    return std::max(static_cast<uint32_t>(frames), (warmRounds + 1) * roundFrames);
}

class Steady : public Library {
protected:
    Steady() : context_(host_.makeContext()), settings_(makeSettings("balanced")), view_(makeView(context_, 3)) {
        for (const auto& [name, value] : {std::pair("ao.method", "bitmask"), {"shadow.history", "16"}}) {
            EXPECT_REFLET(refletSetSetting(settings_, name, value));
        }
        for (size_t i = 0; i < sizes.size(); ++i) {
            rooms_[i] = std::make_unique<HostRoom>(host_, RoomConventions{.drawn = sizes[i], .still = true});
        }
        constexpr uint32_t texels = HostRoom::width * HostRoom::height;
        std::vector<vec4> mask;
        for (uint32_t i = 0; i < texels; ++i) {
            mask.emplace_back(i % 64 < 8 ? 1.0F : 0.0F, i % 64 > 56 ? 1.0F : 0.0F, 0.5F, 0.0F);
        }
        mask_ = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, HostRoom::width, HostRoom::height, mask);
        for (uint32_t i = 0; i < lamps_.size(); ++i) {
            lamps_[i] = lamp(32U << i);
        }
        EXPECT_REFLET(refletSetOutputSize(view_, 2 * HostRoom::width, 2 * HostRoom::height));
    }
    ~Steady() override {
        host_.host.waitForAll();
        refletDestroyView(view_);
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
    }

    // A spot above the room that looks down on nothing.
    RefletLampShadow lamp(uint32_t side) {
        RefletLampShadow made{};
        made.structSize = sizeof made;
        made.position[1] = 3.0F;
        made.radius = 0.1F;
        made.direction[1] = -1.0F;
        made.coneAngle = 1.0F;
        mat4 toClip(0.0F);  // 45 degrees to each side, 0.1 to 20 m
        toClip[0][0] = 1.0F;
        toClip[1][1] = -1.0F;
        toClip[2][2] = 20.0F / (0.1F - 20.0F);
        toClip[2][3] = -1.0F;
        toClip[3][2] = 2.0F / (0.1F - 20.0F);
        toClip = toClip * glm::lookAt(vec3(0, 3, 0), vec3(0, 2, 0), vec3(0, 0, -1));
        std::memcpy(made.worldToClip[0], &toClip[0][0], sizeof made.worldToClip[0]);
        made.depth = REFLET_LAMP_DEPTH_STANDARD;
        made.map = host_.makeImage(VK_FORMAT_R32_SFLOAT, side, side, std::vector<float>(size_t(side) * side, 1.0F));
        return made;
    }

    void render(uint32_t index) {
        const uint32_t step = index % roundFrames;
        if (step == 0) {
            EXPECT_REFLET(refletResetView(view_));
        }
        const HostRoom& room = *rooms_[step % sizes.size()];
        host_.host.frame([&](VkCommandBuffer commands) {
            RefletFrameInfo frame = room.frame(commands, index);
            RefletGBuffer gbuffer = *frame.gbuffer;
            if (step % 8 >= 4) {
                gbuffer.excluded = gbuffer.unlit = gbuffer.reactive = mask_;
                gbuffer.unlitChannel = 1;
                gbuffer.reactiveChannel = 2;
            }
            frame.gbuffer = &gbuffer;
            frame.restFrames = step;
            record(room, frame, step % 3);
        });
    }

    void record(const HostRoom& room, const RefletFrameInfo& frame, uint32_t lampCount) {
        const RefletSunShadow sun = room.sun();
        const RefletIndirectLight light = room.light();
        RefletImage image{};
        RefletLobe lobe = emptyLobe();
        RefletComposite sum{};
        sum.structSize = sizeof sum;
        EXPECT_REFLET(refletBeginFrame(view_, &frame));
        EXPECT_REFLET(refletSunShadow(view_, settings_, &sun, &image));
        if (lampCount > 0) {
            EXPECT_REFLET(refletLampShadows(view_, settings_, lamps_.data(), lampCount, &image));
        }
        EXPECT_REFLET(refletAmbientOcclusion(view_, settings_, &image));
        EXPECT_REFLET(refletDiffuseGi(view_, settings_, &light, &lobe));
        EXPECT_REFLET(refletReflections(view_, settings_, &light, &lobe));
        EXPECT_REFLET(refletComposite(view_, settings_, nullptr, &sum));
        EXPECT_REFLET(refletTemporal(view_, settings_, nullptr, &image));
        const RefletLens lens{sizeof lens, 0.2F, 3.0F, 6, 0.1F};
        EXPECT_REFLET(refletDepthOfField(view_, settings_, &lens, nullptr, &image));
        EXPECT_REFLET(refletToneMap(view_, settings_, nullptr, 1, &image));
        EXPECT_REFLET(refletEndFrame(view_));
    }

    uint64_t deviceBytes() {
        uint64_t bytes = 0;
        EXPECT_REFLET(refletViewMemory(view_, &bytes));
        return bytes;
    }

    RefletContext context_;
    RefletSettings settings_;
    RefletView view_;
    std::array<std::unique_ptr<HostRoom>, sizes.size()> rooms_;
    RefletImage mask_{};
    std::array<RefletLampShadow, 2> lamps_{};
};

// Over 5 s: 96 frames, after all pipelines were made.
TEST_F(Steady, NoPipelineIsMadeAndNoMemoryAllocatedAfterTheFirstRounds) {
    const uint32_t frames = framesToRun();
    uint32_t index = 0;
    for (; index < warmRounds * roundFrames; ++index) {
        render(index);
    }
    host_.host.waitForAll();
    const LibraryHost::Made made = LibraryHost::made();
    const uint64_t bytes = deviceBytes();
    const size_t heap = heapBytes();
    for (; index < frames; ++index) {
        render(index);
        const LibraryHost::Made now = LibraryHost::made();  // VkImage objects come and go in the memory that is there
        ASSERT_EQ(now.allocations, made.allocations) << "frame " << index;
        ASSERT_EQ(now.pipelines, made.pipelines) << "frame " << index;
        ASSERT_EQ(now.pools, made.pools) << "frame " << index;
    }
    host_.host.waitForAll();
    EXPECT_EQ(deviceBytes(), bytes);
    const size_t grown = std::max(heapBytes(), heap) - heap;
    RecordProperty("heap", std::to_string(grown));
    // Objects of images, and the driver's command buffers: 308 KB after 1000 frames.
    EXPECT_LT(grown, size_t(1) << 20U);
}

}  // namespace
}  // namespace reflet::test::steady_test
