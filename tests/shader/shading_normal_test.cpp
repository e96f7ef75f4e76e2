// shading_normal.glsl
#include "shader/harness.h"
#include "support/shading_normal_cases.h"

namespace reflet::test::shading_normal_test {
namespace {

class ShadingNormal : public ShaderTest {};

TEST_F(ShadingNormal, BendsUntilItsMirrorDirectionLeavesTheSurface) {
    const std::vector<NormalCase> cases = normalCases();
    const auto bent = mapOnDevice<vec3>("shading_normal_test.comp", cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        ASSERT_NO_FATAL_FAILURE(expectConsistentNormal(cases[i], bent[i])) << i;
    }
}

}  // namespace
}  // namespace reflet::test::shading_normal_test
