// What the window says of how far the picture is.
#include "view/progress_text.h"

#include <gtest/gtest.h>

namespace reflet::test::progress_text_test {
namespace {

class ProgressText : public ::testing::Test {
protected:
    std::string text(Running running = Running::onDemand, const std::string& job = "") {
        published_.live = std::make_shared<const RenderedImage>(live_);
        return progressText(published_, running, job);
    }
    void rendered(uint32_t frames, uint32_t of) {
        live_.rendered += frames;
        live_.frames = frames;
        live_.framesToConverge = of;
    }

    RenderedImage live_;
    RenderThread::State published_;
};

TEST_F(ProgressText, APictureThatIsNotThereYetIsNotFinished) {
    EXPECT_EQ(text(), "compiling shaders");
    published_.compiling = 40;
    EXPECT_EQ(text(), "compiling 40 shaders");
    published_.compiling = 0;
    EXPECT_EQ(text(Running::paused), "paused");
    live_.problem = "not enough memory";
    EXPECT_EQ(text(), "not rendered");
}

TEST_F(ProgressText, CountsFramesUntilTheLastOne) {
    rendered(3, 32);
    EXPECT_EQ(text(), "frame 3 of 32");
    EXPECT_EQ(text(Running::continuous), "frame 3 of 32");
    EXPECT_EQ(text(Running::paused), "frame 3, paused");
    rendered(32, 32);
    EXPECT_EQ(text(), "finished");
    rendered(33, 32);
    EXPECT_EQ(text(Running::continuous), "frame 33");
}

TEST_F(ProgressText, SaysWhatItWaitsFor) {
    rendered(32, 32);
    published_.compiling = 2;
    EXPECT_EQ(text(), "compiling 2 shaders");
    EXPECT_EQ(text(Running::onDemand, "reading a pixel"), "reading a pixel");
    published_.compiling = 0;
    published_.effort = {.scale = 0.5F, .fewRays = true};
    EXPECT_EQ(text(), "moving: resolution x 0.50, 1 ray");
}

}  // namespace
}  // namespace reflet::test::progress_text_test
