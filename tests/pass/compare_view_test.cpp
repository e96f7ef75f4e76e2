// The window's comparison: an error is named after what it was measured against.
#include "view/compare_view.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <thread>

namespace reflet::test::compare_view_test {
namespace {

class CompareViewTest : public ::testing::Test {
protected:
    static constexpr uvec2 size{16, 9};

    CompareViewTest() {
        state_.source.scene = "builtin:cornell";
        opened_.scene = std::make_shared<const Scene>(loadScene(state_.source));
        opened_.firstView = loadView(state_.source, *opened_.scene);
        state_.view = opened_.firstView;
        state_.compare.with = CompareWith::truth;
        state_.compare.samples = 64;
        auto grey = std::make_shared<FloatImage>(FloatImage{size.x, size.y, {"R", "G", "B"}, {}});
        grey->data.assign(size_t(3) * size.x * size.y, 0.25F);
        live_.values = grey;
    }

    void update() {
        compare_.update(
            {.state = state_, .opened = opened_, .live = live_, .right = nullptr, .size = size, .mayTrace = true});
        if (compare_.values() && compare_.samples() > 0) {
            shown_[compare_.samples()] = compare_.values();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    // Updates until the error has been measured against all samples. False after a minute.
    bool finish() {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (compare_.errorSamples() < state_.compare.samples && std::chrono::steady_clock::now() < end) {
            update();
            expectTrueName();
        }
        return compare_.errorSamples() == state_.compare.samples;
    }
    void expectTrueName() {
        if (!compare_.error()) {
            EXPECT_EQ(compare_.errorSamples(), 0U);
            return;
        }
        ASSERT_TRUE(shown_.contains(compare_.errorSamples())) << compare_.errorSamples();
        const Difference measured = compareImages(*live_.values, *shown_.at(compare_.errorSamples()), {}).difference;
        EXPECT_EQ(compare_.error()->relativeMse, measured.relativeMse) << compare_.errorSamples();
    }

    ViewerState state_;
    OpenScene opened_;
    RenderedImage live_;
    CompareView compare_;
    std::map<uint32_t, std::shared_ptr<const FloatImage>> shown_;
};

TEST_F(CompareViewTest, AnErrorNamesTheSamplesThatItWasMeasuredAgainst) {
    EXPECT_EQ(compare_.errorName(), "HDR-FLIP");
    ASSERT_TRUE(finish());
    EXPECT_EQ(compare_.errorName(), "HDR-FLIP, 64 samples");
    EXPECT_GE(shown_.size(), 2U);
    EXPECT_EQ(CompareView::sampleText(1), "1 sample");
}

// Another view: what was measured for the old one must not come back under it.
TEST_F(CompareViewTest, AnErrorOfTheViewBeforeIsForgotten) {
    while (compare_.samples() == 0) {
        update();
    }
    state_.view.camera.position.x += 0.01F;  // an error of the first view is being measured
    shown_.clear();
    update();
    EXPECT_FALSE(compare_.error());
    EXPECT_FALSE(compare_.errorMap());
    EXPECT_TRUE(finish());
}

}  // namespace
}  // namespace reflet::test::compare_view_test
