// The made environments: the sky against properties of its model and of daylight, the studio, blurs.
#include "scene/sky.h"

#include "base/color.h"
#include "scene/background.h"
#include "scene/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace reflet::sky_test {
namespace {

constexpr float degree = glm::pi<float>() / 180.0F;

Environment environmentOf(FloatImage image) {
    Environment environment;
    environment.image = std::make_shared<FloatImage>(std::move(image));
    return environment;
}

/// Irradiance of the image's texels on a surface, by solid angle.
vec3 irradiance(const FloatImage& image, const vec3& normal) {
    glm::dvec3 sum(0.0);
    for (uint32_t row = 0; row < image.height; ++row) {
        const double top = std::cos(glm::pi<double>() * row / image.height);
        const double bottom = std::cos(glm::pi<double>() * (row + 1) / image.height);
        const double solidAngle = 2.0 * glm::pi<double>() / image.width * (top - bottom);
        for (uint32_t column = 0; column < image.width; ++column) {
            const vec2 uv = (vec2(column, row) + 0.5F) / vec2(image.width, image.height);
            const double cosine = std::max(glm::dot(environmentDirection(uv, 0.0F), normal), 0.0F);
            const float* texel = &image.data[3 * (size_t(row) * image.width + column)];
            sum += solidAngle * cosine * glm::dvec3(texel[0], texel[1], texel[2]);
        }
    }
    return sum;
}

float luminanceAt(const Environment& sky, float elevation, float azimuth) {
    const float across = std::cos(elevation * degree);
    return luminance(radianceFrom(sky, {across * std::sin(azimuth * degree), std::sin(elevation * degree),
                                        -across * std::cos(azimuth * degree)}));
}

TEST(Sky, IsFiniteAndNotNegativeForEveryHeightOfTheSun) {
    for (const float elevation : {-90.0F, -18.0F, -6.0F, -0.1F, 0.0F, 0.1F, 10.0F, 53.0F, 90.0F}) {
        const Sky sky = makeSky(elevation * degree);
        ASSERT_EQ(sky.image.data.size(), 3U * sky.image.width * sky.image.height);
        const auto wrong = [](float v) { return !(v >= 0.0F && v < 100.0F); };
        EXPECT_EQ(std::ranges::count_if(sky.image.data, wrong), 0) << elevation;
        EXPECT_GT(luminance(meanRadiance(sky.image)), 0.0F) << elevation;
        EXPECT_EQ(sky.sunIrradiance == vec3(0.0F), elevation <= 0.0F) << elevation;
    }
}

TEST(Sky, IsMirroredAtTheSunsAzimuthAndBrighterTowardTheSun) {
    const FloatImage image = makeSky(30.0F * degree).image;
    for (uint32_t row = 0; row < image.height; row += 7) {
        const float* texels = &image.data[size_t{3} * row * image.width];
        for (uint32_t i = 0; i < image.width / 2; ++i) {
            ASSERT_NEAR(texels[3 * i], texels[3 * (image.width - 1 - i)], 1e-4F) << row << ", " << i;
        }
    }
    const Environment sky = environmentOf(image);
    for (const float elevation : {5.0F, 30.0F, 70.0F}) {
        for (const float azimuth : {20.0F, 50.0F}) {  // the paper's function rises again toward the antisolar point
            EXPECT_GT(luminanceAt(sky, elevation, azimuth - 20.0F), luminanceAt(sky, elevation, azimuth + 20.0F));
        }
    }
    EXPECT_GT(luminanceAt(sky, 30.0F, 0.0F), 3.0F * luminanceAt(sky, 60.0F, 180.0F));
}

// F(90°, 90°) / F(0, 0) of Perez's function with the paper's coefficients for turbidity 3, by hand: 1.1620 / 3.2814.
TEST(Sky, FallsFromASunAtTheZenithToTheHorizonAsThePapersFunction) {
    const Environment sky = environmentOf(makeSky(90.0F * degree).image);
    EXPECT_NEAR(luminanceAt(sky, 0.5F, 0.0F) / luminanceAt(sky, 89.9F, 0.0F), 0.3541F, 0.02F);
}

// Zenith luminance by the paper's formula at 53 degrees, turbidity 3: 8.80 kcd/m². Direct normal illuminance of a clear
// day: 80 to 100 klx.
TEST(Sky, AndItsSunAreAsBrightAsOnAClearDay) {
    const Sky sky = makeSky(53.0F * degree);
    const float klx = 8.80F / luminanceAt(environmentOf(sky.image), 89.9F, 0.0F);
    const float ofSun = klx * luminance(sky.sunIrradiance);
    EXPECT_GT(ofSun, 80.0F);
    EXPECT_LT(ofSun, 100.0F);
    FloatImage upper = sky.image;
    std::fill(upper.data.begin() + static_cast<ptrdiff_t>(upper.data.size() / 2), upper.data.end(), 0.0F);
    const float diffuse = klx * luminance(irradiance(upper, {0, 1, 0}));
    EXPECT_GT(diffuse, 15.0F);
    EXPECT_LT(diffuse, 35.0F);
}

TEST(Sky, IsBlueAndItsSunYellowButTogetherTheyLightAHorizontalSurfaceNeutral) {
    const Sky sky = makeSky(53.0F * degree);
    const vec3 diffuse = irradiance(sky.image, {0, 1, 0});
    EXPECT_GT(diffuse.b, 1.3F * diffuse.r);
    EXPECT_GT(sky.sunIrradiance.r, 1.2F * sky.sunIrradiance.b);
    const vec3 all = diffuse + std::sin(53.0F * degree) * sky.sunIrradiance;
    EXPECT_NEAR(all.r, all.g, 0.01F * all.g);
    EXPECT_NEAR(all.b, all.g, 0.01F * all.g);
    EXPECT_NEAR(luminance(all) / glm::pi<float>(), 1.0F, 0.2F) << "white at exposure 0";
}

TEST(Sky, HasASunOfOneLuminanceThatReddensAndFallsNearTheHorizon) {
    float redness = 0.0F;
    for (const float elevation : {90.0F, 53.0F, 30.0F, 10.0F}) {
        const vec3 sun = makeSky(elevation * degree).sunIrradiance;
        EXPECT_NEAR(luminance(sun), Sky::sunLuminance, 1e-3F) << elevation;
        EXPECT_GT(sun.r / sun.b, redness) << elevation;
        redness = sun.r / sun.b;
    }
    EXPECT_LT(luminance(makeSky(5.0F * degree).sunIrradiance), 1.0F);
}

TEST(Sky, FadesInTwilight) {
    const float sunset = luminance(meanRadiance(makeSky(0.0F).image));
    EXPECT_NEAR(luminance(meanRadiance(makeSky(-6.0F * degree).image)) / sunset, 1.0F / 120.0F, 1e-4F);
    EXPECT_EQ(makeSky(-30.0F * degree).image.data, makeSky(-80.0F * degree).image.data);
}

TEST(Studio, IsGreyWithLightsUpperLeftBehindTheCameraAndOverhead) {
    const Environment studio = environmentOf(makeStudio());
    for (size_t i = 0; i < studio.image->data.size(); i += 3) {
        ASSERT_EQ(studio.image->data[i], studio.image->data[i + 2]);
        ASSERT_GT(studio.image->data[i], 0.1F);
    }
    const auto at = [&](const vec3& d) { return radianceFrom(studio, d).r; };
    EXPECT_GT(at({-0.75F, 0.6F, 0.8F}), 3.0F * at({0.3F, 0.9F, 0.9F}));
    EXPECT_GT(at({0, 1, -0.1F}), 1.0F);
    EXPECT_LT(at({0, -1, 0}), 0.2F);
    // A surface that faces the camera from below the key light: about as bright as under the sky.
    const float shown = luminance(irradiance(*studio.image, glm::normalize(vec3(0, 0.5F, 1)))) / glm::pi<float>();
    EXPECT_GT(shown, 0.7F);
    EXPECT_LT(shown, 1.4F);
}

TEST(MeanRadiance, WeighsTexelsByTheirSolidAngle) {
    FloatImage image{1, 2, {"R", "G", "B"}, {1, 1, 1, 3, 3, 3}};
    EXPECT_NEAR(meanRadiance(image).g, 2.0F, 1e-6F);
    image = {1, 3, {"R", "G", "B"}, {0, 0, 0, 1, 1, 1, 0, 0, 0}};
    EXPECT_NEAR(meanRadiance(image).g, 0.5F, 1e-6F) << "60 degrees around the horizon, by midpoints";
}

TEST(BlurredImage, KeepsAConstantAndTheMean) {
    const FloatImage constant = blurredImage({4, 2, {"R", "G", "B"}, std::vector<float>(24, 0.7F)});
    for (const float value : constant.data) {
        ASSERT_NEAR(value, 0.7F, 1e-3F);
    }
    const FloatImage studio = makeStudio();
    EXPECT_NEAR(meanRadiance(blurredImage(studio)).r, meanRadiance(studio).r, 0.01F * meanRadiance(studio).r);
}

// A texel of solid angle o and radiance 1 becomes o times the normalised von Mises-Fisher lobe, k / (2 pi) for large k.
TEST(BlurredImage, SpreadsASpotOverTheLobeWhereverItIs) {
    const float k = 1.0F / (12.0F * degree * 12.0F * degree);
    for (const uint32_t row : {3U, 12U, 16U}) {
        FloatImage image{64, 32, {"R", "G", "B"}, std::vector<float>(size_t{3} * 64 * 32, 0.0F)};
        image.data[3 * (row * 64U + 20U)] = 100.0F;
        const vec3 spot = environmentDirection((vec2(20, row) + 0.5F) / vec2(64, 32), 0.0F);
        const float solidAngle = 2.0F * glm::pi<float>() / 64.0F * glm::pi<float>() / 32.0F *
                                 std::sin((float(row) + 0.5F) / 32.0F * 180.0F * degree);
        const Environment blurred = environmentOf(blurredImage(image));
        const float peak = 100.0F * solidAngle * k / (2.0F * glm::pi<float>());
        const vec3 aside = glm::normalize(glm::cross(spot, vec3(0.3F, 1, 0.2F)));
        for (const float angle : {0.0F, 10.0F, 20.0F}) {
            const vec3 d = std::cos(angle * degree) * spot + std::sin(angle * degree) * aside;
            const float expected = peak * std::exp(k * (std::cos(angle * degree) - 1.0F));
            EXPECT_NEAR(radianceFrom(blurred, d).r, expected, 0.04F * peak) << row << ", " << angle;
        }
        EXPECT_EQ(radianceFrom(blurred, spot).g, 0.0F);
    }
}

}  // namespace
}  // namespace reflet::sky_test
