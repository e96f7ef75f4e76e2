// half_float.glsl
#include "shader/harness.h"

#include <limits>

namespace reflet::test {
namespace {

class HalfFloat : public ShaderTest {};

TEST_F(HalfFloat, holdsWhatFitsAndTamesWhatDoesNot) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::vector<vec3> given = {{nan, -nan, 0.0F},      {infinity, -infinity, 1.0F},
                                     {-1.0F, -1e30F, 1e30F}, {65504.0F, 65505.0F, 65503.0F},
                                     {0.5F, 1e-30F, -0.0F},  {1.0F, nan, infinity}};
    const std::vector<vec3> kept = {{0.0F, 0.0F, 0.0F},     {65504.0F, 0.0F, 1.0F},
                                    {0.0F, 0.0F, 65504.0F}, {65504.0F, 65504.0F, 65503.0F},
                                    {0.5F, 1e-30F, 0.0F},   {1.0F, 0.0F, 65504.0F}};
    const auto result = mapOnDevice<vec3>("half_float_test.comp", given);
    for (size_t i = 0; i < given.size(); ++i) {
        EXPECT_EQ(result[i], kept[i]) << i << ": " << result[i].x << ' ' << result[i].y << ' ' << result[i].z;
    }
}

}  // namespace
}  // namespace reflet::test
