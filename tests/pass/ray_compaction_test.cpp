// trace_screen.compaction: rays that go on in later passes end as they would have in one.
#include "pass/harness.h"
#include "scene/builtin.h"

#include <algorithm>

namespace reflet::test::ray_compaction_test {
namespace {

constexpr uvec2 size(192, 108);

class RayCompaction : public testing::TestWithParam<const char*> {};

// Over 5 s on an empty shader cache: the tracer is compiled for a single pass and for each of three.
TEST_P(RayCompaction, ChangesNoRay) {
    // With that many steps of single pixels more rays go on than the lists have room for.
    const Scene scene = findBuiltinScene("cave")->make();
    const auto rendered = [&](const char* compaction) {
        return render(scene, defaultView(scene), size,
                      settingsOf({"diffuse.rays=0", "denoise.enabled=false", "trace_screen.first_steps=64",
                                  "trace_screen.count_steps=true", GetParam(),
                                  std::string("trace_screen.compaction=") + compaction}),
                      {"indirect_specular", "specular_steps"});
    };
    const Pictures once = rendered("never");
    const Pictures compacted = rendered("always");
    const std::vector<float>& steps = once.images.at("specular_steps").data;
    EXPECT_GT(std::ranges::count_if(steps, [](float s) { return s > 32.0F; }), steps.size() / 2);
    EXPECT_GT(std::ranges::count_if(steps, [](float s) { return s > 64.0F; }), steps.size() / 4);
    EXPECT_EQ(steps, compacted.images.at("specular_steps").data);
    EXPECT_EQ(once.images.at("indirect_specular").data, compacted.images.at("indirect_specular").data);
    expectSilentValidation(GetParam());
}

// Without and with lists of rays between the passes.
INSTANTIATE_TEST_SUITE_P(Forms, RayCompaction,
                         testing::Values("trace_screen.count_hits=false", "trace_screen.count_hits=true"),
                         [](const auto& chosen) { return chosen.index == 0 ? "atOnce" : "listed"; });

}  // namespace
}  // namespace reflet::test::ray_compaction_test
