// Compositing of indirect light onto surfaces.
#include "pass/harness.h"
#include "scene/builtin.h"

namespace reflet::test::composite_test {
namespace {

constexpr uvec2 size(160, 90);

TEST(Composite, GainIsAFactorOnDiffuseLightAloneAndNothingElseChanges) {
    const Scene scene = findBuiltinScene("gloss")->make();
    const std::vector<std::string> shows{"indirect_diffuse", "indirect_specular", "direct"};
    const auto withGain = [&](const char* gain) {
        return render(scene, defaultView(scene), size,
                      settingsOf({std::string("diffuse.gain=") + gain, "trace_screen.light=direct"}), shows);
    };
    const Pictures one = withGain("1");
    const Pictures four = withGain("4");
    EXPECT_EQ(rangeOf(withGain("0").images.at("indirect_diffuse")).max, 0.0F);
    EXPECT_EQ(four.images.at("indirect_specular").data, one.images.at("indirect_specular").data);
    EXPECT_EQ(four.images.at("direct").data, one.images.at("direct").data);
    const std::vector<float>& before = one.images.at("indirect_diffuse").data;
    const std::vector<float>& after = four.images.at("indirect_diffuse").data;
    unsigned checked = 0;
    for (size_t i = 0; i < before.size(); ++i) {
        if (before[i] > 1e-4F) {  // halves are exact under a power of two, but for those near zero
            ASSERT_EQ(after[i], 4.0F * before[i]) << i;
            ++checked;
        }
    }
    EXPECT_GT(checked, 10000U);
}

}  // namespace
}  // namespace reflet::test::composite_test
