// Suggestions for misspelled names.
#include "base/text.h"

#include "base/sha256.h"

#include <gtest/gtest.h>

#include <array>

namespace reflet::text_test {
namespace {

const std::array<std::string, 6> names{"position", "target", "up", "fov_y", "near", "trace_screen.max_steps"};

TEST(NearestName, IsTheOneWithAFewLettersWrongMissingOrSwapped) {
    EXPECT_EQ(nearestName("positon", names), "position");
    EXPECT_EQ(nearestName("traget", names), "target");
    EXPECT_EQ(nearestName("fov", names), "fov_y");
    EXPECT_EQ(nearestName("naer", names), "near");
    EXPECT_EQ(nearestName("trace_screen.maxStep", names), "trace_screen.max_steps");
}

// Examples of FIPS 180-4; the last has two blocks.
TEST(Sha256, IsThatOfTheStandard) {
    EXPECT_EQ(sha256Base64(""), "47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
    EXPECT_EQ(sha256Base64("abc"), "ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
    EXPECT_EQ(sha256Base64("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "JI1qYdIGOLjlwCaTDD5gOaM85Flk/yFn9uzt1BnbBsE=");
}

TEST(NearestName, DoesNotCareAboutUpperAndLowerCase) {
    EXPECT_EQ(nearestName("POSITION", names), "position");
    EXPECT_EQ(nearestName("fovY", names), "fov_y");
    EXPECT_EQ(nearestName("TRACE_SCREEN.MAXSTEPS", names), "trace_screen.max_steps");
}

TEST(NearestName, IsTheOneThatTheNameIsAPartOf) {
    EXPECT_EQ(nearestName("pos", names), "position");
    EXPECT_EQ(nearestName("maxSteps", names), "trace_screen.max_steps");
    EXPECT_EQ(nearestName("near_plane_distance", names), "near");
}

TEST(NearestName, IsNoneWhereNothingIsNear) {
    EXPECT_EQ(nearestName("irradiance", names), std::nullopt);
    EXPECT_EQ(nearestName("x", names), std::nullopt);
    EXPECT_EQ(nearestName("", names), std::nullopt);
    EXPECT_EQ(nearestName("position", {}), std::nullopt);
}

TEST(NearestName, IsTheFirstOfSeveralEquallyNear) {
    EXPECT_EQ(nearestName("name", std::array<std::string, 3>{"nama", "namb", "namc"}), "nama");
}

TEST(NearestName, IsTheNearestOfSeveralThatAreNear) {
    EXPECT_EQ(nearestName("steps", std::array<std::string, 3>{"maxSteps", "stops", "step_size"}), "stops");
}

TEST(Suggestion, EndsAMessageOrIsNothing) {
    EXPECT_EQ(suggestion("positon", names), "; did you mean 'position'?");
    EXPECT_EQ(suggestion("irradiance", names), "");
}

}  // namespace
}  // namespace reflet::text_test
