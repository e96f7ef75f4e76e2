// The window's search finds settings by names, help and the field's terms.
#include "view/setting_search.h"

#include <gtest/gtest.h>

namespace reflet::test::setting_search_test {
namespace {

bool finds(std::string_view typed, std::string_view name) {
    return isFound(findSetting(name), typed);
}

TEST(SettingSearch, FindsByNameWhateverTheCase) {
    EXPECT_TRUE(finds("max_steps", "trace_screen.max_steps"));
    EXPECT_TRUE(finds("THICK", "trace_screen.thickness"));
    EXPECT_TRUE(finds("", "trace_screen.thickness"));
    EXPECT_FALSE(finds("thick", "tonemap.curve"));
}

TEST(SettingSearch, FindsByTheTermsOfTheField) {
    EXPECT_TRUE(finds("reflection", "specular.rays"));
    EXPECT_TRUE(finds("ssr", "specular.rays"));
    EXPECT_TRUE(finds("ssr", "trace_screen.method"));
    EXPECT_TRUE(finds("indirect", "diffuse.rays"));
    EXPECT_TRUE(finds("ssgi", "diffuse.rays"));
    EXPECT_TRUE(finds("gi", "diffuse.rays"));
    EXPECT_TRUE(finds("blur", "denoise.radius"));
    EXPECT_TRUE(finds("taa", "temporal.frames"));
    EXPECT_TRUE(finds("half res", "diffuse.downsample"));
    EXPECT_FALSE(finds("gi", "tonemap.exposure"));
    EXPECT_FALSE(finds("ssr", "tonemap.exposure"));
}

TEST(SettingSearch, WantsEveryWord) {
    EXPECT_TRUE(finds("soft shadow samples", "shadow.samples"));
    EXPECT_FALSE(finds("soft shadow samples", "trace_screen.stride"));
}

}  // namespace
}  // namespace reflet::test::setting_search_test
