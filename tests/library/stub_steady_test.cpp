// A host's long run on a driver that executes nothing: sizes, masks, lamps, cuts and settings change, and after the
// first rounds no object is made and nothing grows. REFLET_STUB_FRAMES: how many frames.
#include "library/library_host.h"
#include "stub/host.h"
#include "support/heap.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

namespace reflet::test::stub_steady_test {
namespace {

struct Size {
    uint32_t width;
    uint32_t height;
};
constexpr Size largest{160, 90};
// As dynamic resolution has them, between a half and all.
constexpr std::array<Size, 8> sizes{
    {{160, 90}, {152, 86}, {144, 81}, {128, 72}, {120, 68}, {104, 59}, {96, 54}, {80, 45}}};
// Then all comes again: 8 sizes, 0 to 2 lamps, with and without masks, two settings, and a cut.
constexpr uint32_t roundFrames = 96;
constexpr uint32_t warmRounds = 4;

uint32_t framesToRun() {
    const char* asked = std::getenv("REFLET_STUB_FRAMES");  // NOLINT(concurrency-mt-unsafe): one thread
    const uint64_t frames = asked == nullptr ? 1000 : std::strtoull(asked, nullptr, 10);
    return std::max(static_cast<uint32_t>(frames), (warmRounds + 1) * roundFrames);
}

class StubSteady : public ::testing::Test {
protected:
    StubSteady() {
        stub::setDevice({});
        const RefletContextInfo info = stub::contextInfo();
        EXPECT_REFLET(refletCreateContext(&info, &context_));
        EXPECT_REFLET(refletCreateRadianceCache(context_, &cache_));
        const RefletViewInfo size{sizeof size, largest.width, largest.height, framesInFlight, 0, 0};
        EXPECT_REFLET(refletCreateView(context_, &size, &view_));
        EXPECT_REFLET(refletSetOutputSize(view_, 2 * largest.width, 2 * largest.height));
        for (RefletSettings& settings : settings_) {
            EXPECT_REFLET(refletCreateSettings("balanced", &settings));
            EXPECT_REFLET(refletSetSetting(settings, "ao.method", "bitmask"));
            EXPECT_REFLET(refletSetSetting(settings, "shadow.history", "16"));
        }
        EXPECT_REFLET(refletSetSetting(settings_[1], "motion_blur.enabled", "true"));
        for (size_t i = 0; i < sizes.size(); ++i) {
            hosts_[i] = std::make_unique<stub::HostFrame>(sizes[i].width, sizes[i].height);
            hosts_[i]->frame.renderSize[0] = sizes[i].width;
            hosts_[i]->frame.renderSize[1] = sizes[i].height;
            hosts_[i]->light.radianceCache = cache_;
        }
    }
    ~StubSteady() override {
        finish(0);
        refletDestroyView(view_);
        refletDestroyRadianceCache(cache_);
        for (RefletSettings settings : settings_) {
            refletDestroySettings(settings);
        }
        refletDestroyContext(context_);
        EXPECT_EQ(stub::leaks(), "");
    }

    void finish(size_t left) {
        for (; commands_.size() > left; commands_.erase(commands_.begin())) {
            stub::finishCommands(commands_.front());
        }
    }

    // As a load that changes: a few frames of one size, then a neighbour.
    static size_t sizeOf(uint32_t step) {
        const size_t place = step / 3 % (2 * sizes.size() - 2);
        return place < sizes.size() ? place : 2 * sizes.size() - 2 - place;
    }

    void render(uint32_t index) {
        const uint32_t step = index % roundFrames;
        if (step == 0) {
            EXPECT_REFLET(refletResetView(view_));
        }
        stub::HostFrame& host = *hosts_.at(sizeOf(step));
        host.look(0.01F * static_cast<float>(step));
        const RefletGBuffer all = host.gbuffer;
        if (step % 8 < 4) {
            host.gbuffer.excluded = host.gbuffer.unlit = host.gbuffer.reactive = {};
        }
        finish(framesInFlight - 1);
        commands_.push_back(stub::beginCommands());
        host.frame.commandBuffer = commands_.back();
        host.frame.frameIndex = index;
        record(host, settings_.at(step / 48), step % 3);
        host.gbuffer = all;
    }

    void record(const stub::HostFrame& host, RefletSettings settings, uint32_t lamps) {
        RefletImage image{};
        RefletLobe lobe = emptyLobe();
        RefletComposite sum{};
        sum.structSize = sizeof sum;
        EXPECT_REFLET(refletBeginFrame(view_, &host.frame));
        EXPECT_REFLET(refletSunShadow(view_, settings, &host.sun, &image));
        if (lamps > 0) {
            EXPECT_REFLET(refletLampShadows(view_, settings, host.lamps.data(), lamps, &image));
        }
        EXPECT_REFLET(refletAmbientOcclusion(view_, settings, &image));
        EXPECT_REFLET(refletDiffuseGi(view_, settings, &host.light, &lobe));
        EXPECT_REFLET(refletReflections(view_, settings, &host.light, &lobe));
        EXPECT_REFLET(refletComposite(view_, settings, nullptr, &sum));
        EXPECT_REFLET(refletTemporal(view_, settings, nullptr, &image));
        EXPECT_REFLET(refletDepthOfField(view_, settings, &host.lens, nullptr, &image));
        EXPECT_REFLET(refletMotionBlur(view_, settings, nullptr, &image));
        EXPECT_REFLET(refletToneMap(view_, settings, nullptr, 1, &image));
        EXPECT_REFLET(refletEndFrame(view_));
    }

    static constexpr uint32_t framesInFlight = 3;
    RefletRadianceCache cache_ = nullptr;
    RefletContext context_ = nullptr;
    RefletView view_ = nullptr;
    std::array<RefletSettings, 2> settings_{};
    std::array<std::unique_ptr<stub::HostFrame>, sizes.size()> hosts_;
    std::vector<VkCommandBuffer> commands_;
};

TEST_F(StubSteady, NothingIsMadeAfterTheFirstRounds) {
    const uint32_t frames = framesToRun();
    uint32_t index = 0;
    for (; index < warmRounds * roundFrames; ++index) {
        render(index);
    }
    const stub::Counts before = stub::counts();
    const size_t heap = heapBytes();
    for (; index < frames; ++index) {
        render(index);
    }
    const stub::Counts after = stub::counts();
    for (size_t kind = 0; kind < stub::kinds; ++kind) {
        EXPECT_EQ(after.made.at(kind), before.made.at(kind)) << stub::nameOf(kind) << " objects were made";
        EXPECT_EQ(after.live.at(kind), before.live.at(kind)) << stub::nameOf(kind);
    }
    const size_t grown = std::max(heapBytes(), heap) - heap;
    RecordProperty("heap", std::to_string(grown));
    EXPECT_LT(grown, size_t(1) << 16U);
}

}  // namespace
}  // namespace reflet::test::stub_steady_test
