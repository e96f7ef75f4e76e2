// Environment images: mapping of directions to texels, and validation of files.
#include "scene/environment.h"

#include "base/error.h"
#include "base/file.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace reflet::environment_test {
namespace {

namespace fs = std::filesystem;
constexpr auto pi = glm::pi<float>();

/// Texels are (column, row, 1).
Environment numbered(uint32_t width, uint32_t height) {
    FloatImage image{width, height, {"R", "G", "B"}, {}};
    for (uint32_t row = 0; row < height; ++row) {
        for (uint32_t column = 0; column < width; ++column) {
            image.data.insert(image.data.end(), {static_cast<float>(column), static_cast<float>(row), 1.0F});
        }
    }
    Environment environment;
    environment.image = std::make_shared<FloatImage>(std::move(image));
    return environment;
}

void expectUv(const vec2& uv, float u, float v) {
    EXPECT_NEAR(uv.x, u, 1e-6F);
    EXPECT_NEAR(uv.y, v, 1e-6F);
}

TEST(EnvironmentUv, LooksAlongMinusZAtThePicturesCentre) {
    expectUv(environmentUv({0, 0, -1}, 0), 0.5F, 0.5F);
    expectUv(environmentUv({1, 0, 0}, 0), 0.75F, 0.5F);
    expectUv(environmentUv({-1, 0, 0}, 0), 0.25F, 0.5F);
    EXPECT_GT(environmentUv({1e-4F, 0, 1}, 0).x, 0.999F);
    EXPECT_LT(environmentUv({-1e-4F, 0, 1}, 0).x, 0.001F);
    EXPECT_EQ(environmentUv({0, 1, 0}, 0).y, 0.0F);
    EXPECT_EQ(environmentUv({0, -1, 0}, 0).y, 1.0F);
    expectUv(environmentUv({0, 3, -3}, 0), 0.5F, 0.25F);  // any length
}

TEST(EnvironmentUv, TurnsCounterClockwiseFromAboveWithTheRotation) {
    expectUv(environmentUv({-1, 0, 0}, 0.5F * pi), 0.5F, 0.5F);
    expectUv(environmentUv({0, 0, -1}, 0.5F * pi), 0.75F, 0.5F);
    expectUv(environmentUv({0, 0, -1}, -1.5F * pi), 0.75F, 0.5F);
    // The same as a rotation of the direction by the right-hand rule.
    const vec3 inPicture = glm::normalize(vec3(0.3F, 0.2F, -0.7F));
    const vec3 inWorld = glm::angleAxis(0.8F, vec3(0, 1, 0)) * inPicture;
    const vec2 expected = environmentUv(inPicture, 0);
    expectUv(environmentUv(inWorld, 0.8F), expected.x, expected.y);
}

TEST(EnvironmentUv, IsInvertedByEnvironmentDirection) {
    for (const float rotation : {0.0F, 1.0F, -2.0F * pi, 5.5F}) {
        for (int column = 0; column < 15; ++column) {
            for (int row = 0; row < 15; ++row) {
                const float u = 0.01F + 0.07F * static_cast<float>(column);
                const float v = 0.01F + 0.07F * static_cast<float>(row);
                const vec3 direction = environmentDirection({u, v}, rotation);
                ASSERT_NEAR(glm::length(direction), 1.0F, 1e-6F);
                const vec2 uv = environmentUv(direction, rotation);
                ASSERT_NEAR(uv.x, u, 1e-5F) << u << ' ' << v;
                ASSERT_NEAR(uv.y, v, 1e-6F) << u << ' ' << v;
            }
        }
    }
}

TEST(EnvironmentUv, NeverLeavesThePicture) {
    for (const float tiny : {0.0F, 1e-30F, -1e-30F, 1e-8F, -1e-8F}) {
        for (const vec3& direction : {vec3(tiny, 0, 1), vec3(tiny, 0, -1), vec3(0, 1, tiny), vec3(tiny, -1, -tiny)}) {
            for (const float rotation : {0.0F, tiny, pi, -pi, 2 * pi, -2 * pi}) {
                const vec2 uv = environmentUv(direction, rotation);
                EXPECT_TRUE(uv.x >= 0.0F && uv.x < 1.0F) << uv.x;
                EXPECT_TRUE(uv.y >= 0.0F && uv.y <= 1.0F) << uv.y;
                EXPECT_EQ(radianceFrom(numbered(8, 4), direction).z, 1.0F);
            }
        }
    }
}

TEST(EnvironmentRadiance, IsConstantWithoutAnImage) {
    EXPECT_EQ(radianceFrom({.radiance = {1, 2, 3}}, {0, 1, 0}), vec3(1, 2, 3));
}

TEST(EnvironmentRadiance, IsThatOfTheTexelTimesTheIntensity) {
    Environment environment = numbered(8, 4);
    environment.intensity = 2.0F;
    for (uint32_t row = 0; row < 4; ++row) {
        for (uint32_t column = 0; column < 8; ++column) {
            for (const float inTexel : {0.05F, 0.5F, 0.95F}) {
                const vec2 uv((static_cast<float>(column) + inTexel) / 8, (static_cast<float>(row) + inTexel) / 4);
                EXPECT_EQ(radianceFrom(environment, environmentDirection(uv, 0)), 2.0F * vec3(column, row, 1));
            }
        }
    }
}

// The solid angles documented in environment.h, against counts of evenly distributed directions.
TEST(EnvironmentRadiance, SeesEachTexelInTheSolidAngleThatIsStated) {
    const Environment environment = numbered(8, 4);
    constexpr int count = 200000;
    std::array<std::array<int, 8>, 4> seen{};
    for (int i = 0; i < count; ++i) {
        const float y = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / count;
        const auto angle = static_cast<float>(std::fmod(i * 2.399963229728653, 2.0 * glm::pi<double>()));
        const float radius = std::sqrt(1.0F - y * y);
        const vec3 texel = radianceFrom(environment, {radius * std::cos(angle), y, radius * std::sin(angle)});
        ++seen.at(static_cast<size_t>(texel.y)).at(static_cast<size_t>(texel.x));
    }
    for (size_t row = 0; row < 4; ++row) {
        const auto edge = static_cast<float>(row) / 4.0F * pi;
        const float solidAngle = 2.0F * pi / 8.0F * (std::cos(edge) - std::cos(edge + pi / 4.0F));
        for (const int hits : seen.at(row)) {
            EXPECT_NEAR(4.0F * pi * static_cast<float>(hits) / count, solidAngle, 0.01F * solidAngle);
        }
    }
}

/// Files in an empty folder.
class EnvironmentFile : public ::testing::Test {
public:
    EnvironmentFile(const EnvironmentFile&) = delete;
    EnvironmentFile& operator=(const EnvironmentFile&) = delete;
    EnvironmentFile(EnvironmentFile&&) = delete;
    EnvironmentFile& operator=(EnvironmentFile&&) = delete;

protected:
    EnvironmentFile()
        : folder_(fs::path(::testing::TempDir()) / (std::string("reflet_environment_") +
                                                    ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~EnvironmentFile() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path at(const std::string& name) const { return folder_ / name; }

    fs::path writeLayer(const std::string& layer, std::vector<std::string> channels, std::vector<float> data) const {
        const auto width = static_cast<uint32_t>(data.size() / channels.size());
        const ImageLayer only{layer, {width, 1, std::move(channels), std::move(data)}, PixelType::float32};
        writeExr(at("sky.exr"), {&only, 1});
        return at("sky.exr");
    }

    static std::string errorOf(const fs::path& path) {
        try {
            (void)readEnvironmentImage(path);
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    }

private:
    fs::path folder_;
};

TEST_F(EnvironmentFile, MayBeRadianceHdr) {
    const std::string texels("\x80\x40\x20\x81\x01\x02\x03\x00", 8);  // mantissas and exponent 2^(1-8), then black
    writeFileAtomically(at("sky.HDR"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + texels);
    const FloatImage image = readEnvironmentImage(at("sky.HDR"));
    EXPECT_EQ(image.width, 2U);
    EXPECT_EQ(image.height, 1U);
    EXPECT_EQ(image.data, (std::vector<float>{1.0F, 0.5F, 0.25F, 0.0F, 0.0F, 0.0F}));
}

TEST_F(EnvironmentFile, MayBeExrWithMoreThanColours) {
    const FloatImage image =
        readEnvironmentImage(writeLayer("", {"R", "G", "B", "A", "depth"}, {1, 2, 3, 0.5F, -7, 4, 5, 6, 0.5F, -8}));
    EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(image.data, (std::vector<float>{1, 2, 3, 4, 5, 6}));
}

TEST_F(EnvironmentFile, WithoutColoursIsAnError) {
    EXPECT_EQ(
        errorOf(writeLayer("", {"R", "B"}, {1, 2})),
        at("sky.exr").string() + ": cannot be used as an environment: it has no channel 'G' in its unnamed layer");
    EXPECT_NE(errorOf(writeLayer("sky", {"R", "G", "B"}, {1, 2, 3})).find("no channel 'R'"), std::string::npos);
}

TEST_F(EnvironmentFile, WithAnInvalidRadianceIsAnErrorWithItsLocation) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const auto& [value, shown] :
         {std::pair{std::nanf(""), "nan"}, {infinity, "inf"}, {-0.5F, "-0.5"}, {2e12F, "2e+12"}}) {
        const std::string message = errorOf(writeLayer("", {"R", "G", "B"}, {0, 0, 0, 0, value, 0}));
        EXPECT_NE(message.find(std::string("channel G at column 1, row 0 (from 0, top left) is ") + shown),
                  std::string::npos)
            << message;
    }
}

TEST_F(EnvironmentFile, ThatIsMissingOrOfAnotherKindIsAnError) {
    EXPECT_NE(errorOf(at("absent.exr")).find("absent.exr"), std::string::npos);
    EXPECT_NE(errorOf(at("absent.hdr")).find("absent.hdr"), std::string::npos);
    EXPECT_NE(errorOf(at("sky.png")).find("must end in .hdr or .exr"), std::string::npos);
}

}  // namespace
}  // namespace reflet::environment_test
