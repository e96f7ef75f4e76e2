// A device that is lost: what calls say then, and that all can be destroyed.
#include "library/library_host.h"
#include "stub/host.h"

#include <string>

namespace reflet::test::lost_device_test {
namespace {

class LostDevice : public ::testing::Test {
protected:
    LostDevice() {
        stub::setDevice({});
        const RefletContextInfo info = stub::contextInfo();
        EXPECT_REFLET(refletCreateContext(&info, &context_));
        EXPECT_REFLET(refletCreateSettings("fast", &settings_));
        for (RefletView& view : views_) {
            EXPECT_REFLET(refletCreateView(context_, &size_, &view));
        }
    }
    ~LostDevice() override {
        for (VkCommandBuffer commands : commands_) {
            stub::finishCommands(commands);
        }
        for (RefletView view : views_) {
            refletDestroyView(view);
        }
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
        stub::lose(false);
        EXPECT_EQ(stub::leaks(), "");
    }

    RefletResult begin(RefletView view) {
        commands_.push_back(stub::beginCommands());
        host_.frame.commandBuffer = commands_.back();
        return refletBeginFrame(view, &host_.frame);
    }

    static void expectLost(RefletResult result, const char* call) {
        EXPECT_EQ(result, REFLET_ERROR_VULKAN) << call;
        EXPECT_NE(std::string(refletLastError()).find("the device was lost"), std::string::npos)
            << call << ": " << refletLastError();
    }

    const RefletViewInfo size_{sizeof size_, 64, 40, 2, REFLET_VIEW_PASS_TIMES, 0};
    stub::HostFrame host_{64, 40};
    RefletContext context_ = nullptr;
    RefletSettings settings_ = nullptr;
    RefletView views_[2] = {};
    std::vector<VkCommandBuffer> commands_;
};

TEST_F(LostDevice, IsTheErrorOfAllLaterCallsThatNeedIt) {
    RefletImage image{};
    ASSERT_EQ(begin(views_[1]), REFLET_SUCCESS);  // a frame that is being recorded
    ASSERT_EQ(begin(views_[0]), REFLET_SUCCESS);
    EXPECT_REFLET(refletSunShadow(views_[0], settings_, &host_.sun, &image));
    EXPECT_REFLET(refletEndFrame(views_[0]));
    stub::lose(true);
    expectLost(refletFinishView(views_[0]), "finish");  // which reads times
    EXPECT_REFLET(refletFinishView(views_[0]));         // the frames are finished all the same
    expectLost(begin(views_[0]), "begin");
    expectLost(refletSunShadow(views_[1], settings_, &host_.sun, &image), "effect");
    EXPECT_REFLET(refletEndFrame(views_[1]));
    expectLost(begin(views_[1]), "begin");
    uint32_t remaining = 0;
    expectLost(refletPrepare(views_[0], settings_, &host_.prepare, 1, &remaining), "prepare");
    RefletView another = nullptr;
    expectLost(refletCreateView(context_, &size_, &another), "create");
    uint64_t bytes = 0;
    EXPECT_REFLET(refletViewMemory(views_[0], &bytes));
    EXPECT_REFLET(refletResizeView(views_[0], 32, 20));
    EXPECT_REFLET(refletResetView(views_[0]));
}

// The library learns of it when it reads times: a view that is destroyed does not.
TEST_F(LostDevice, ViewsWithUnfinishedFramesAreDestroyed) {
    for (int frame = 0; frame < 2; ++frame) {
        ASSERT_EQ(begin(views_[0]), REFLET_SUCCESS);
        EXPECT_REFLET(refletEndFrame(views_[0]));
    }
    ASSERT_EQ(begin(views_[1]), REFLET_SUCCESS);
    stub::lose(true);
}

}  // namespace
}  // namespace reflet::test::lost_device_test
