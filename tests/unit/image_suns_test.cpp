// Suns in environment images: what is one, what it brings, what remains of the image.
#include "scene/image_suns.h"

#include "base/color.h"
#include "scene/environment.h"
#include "scene/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

namespace reflet::image_suns_test {
namespace {

constexpr float degree = glm::pi<float>() / 180.0F;
const vec3 blue(0.3F, 0.4F, 0.5F);
const vec3 warm(40000.0F, 36000.0F, 30000.0F);

FloatImage imageOf(uvec2 size, const std::function<vec3(const vec3& direction)>& light) {
    FloatImage image{size.x, size.y, {"R", "G", "B"}, {}};
    for (uint32_t row = 0; row < size.y; ++row) {
        for (uint32_t column = 0; column < size.x; ++column) {
            const vec3 c = light(environmentDirection((vec2(column, row) + 0.5F) / vec2(size), 0.0F));
            image.data.insert(image.data.end(), {c.x, c.y, c.z});
        }
    }
    return image;
}

bool isWithin(const vec3& direction, const vec3& axis, float degrees) {
    return glm::dot(direction, glm::normalize(axis)) > std::cos(degrees * degree);
}

float diskSolidAngle(float degrees) {
    return 2.0F * glm::pi<float>() * (1.0F - std::cos(degrees * degree));
}

void expectNear(const vec3& a, const vec3& b, float share) {
    EXPECT_LT(glm::length(a - b), share * glm::length(b)) << a.x << ", " << a.y << ", " << a.z;
}

TEST(ImageSuns, ADiskIsOneOfItsSizeDirectionAndLightAndLeavesTheSky) {
    for (const vec3 axis : {vec3(0.5F, 0.6F, -0.6F), vec3(0.01F, 0.3F, 1.0F), vec3(0.01F, 1.0F, 0.01F)}) {
        const FloatImage image =
            imageOf({1024, 512}, [&](const vec3& d) { return isWithin(d, axis, 1.5F) ? warm : blue; });
        const ImageSuns found = findImageSuns(image);
        ASSERT_EQ(found.suns.size(), 1U);
        expectNear(found.suns[0].irradiance, diskSolidAngle(1.5F) * (warm - blue), 0.08F);  // of whole texels
        expectNear(found.suns[0].toSun, glm::normalize(axis), 0.002F);
        EXPECT_NEAR(found.suns[0].angularDiameter, 3.0F * degree, 0.15F * degree);
        expectNear(meanRadiance(*found.image), blue, 1e-3F);
        // Nothing is lost: of the mean over the sphere of 4 pi.
        const vec3 sum = meanRadiance(*found.image) + found.suns[0].irradiance / (4.0F * glm::pi<float>());
        expectNear(sum, meanRadiance(image), 1e-3F);
    }
}

TEST(ImageSuns, AGlowAroundBelongsToIt) {
    const vec3 axis = glm::normalize(vec3(0.2F, 0.5F, -0.9F));
    const FloatImage image = imageOf({1024, 512}, [&](const vec3& d) {
        const float angle = std::acos(std::min(glm::dot(d, axis), 1.0F)) / degree;
        return blue + warm * (angle < 0.5F ? 1.0F : 0.02F * std::exp(-2.0F * angle));
    });
    const ImageSuns found = findImageSuns(image);
    ASSERT_EQ(found.suns.size(), 1U);
    const float brightest = *std::ranges::max_element(found.image->data);
    EXPECT_LT(brightest, 16.0F * luminance(meanRadiance(*found.image)));
}

TEST(ImageSuns, TwoAreSortedByTheirLight) {
    const FloatImage image = imageOf({512, 256}, [](const vec3& d) {
        return isWithin(d, {1, 1, 0}, 2.0F) ? 0.3F * warm : isWithin(d, {-1, 0.5F, 0}, 2.0F) ? warm : blue;
    });
    const ImageSuns found = findImageSuns(image);
    ASSERT_EQ(found.suns.size(), 2U);
    EXPECT_LT(found.suns[0].toSun.x, 0.0F);
    EXPECT_GT(found.suns[1].toSun.x, 0.0F);
}

TEST(ImageSuns, LargeBrightAreasFaintPointsAndMadeSkiesHaveNone) {
    const auto count = [](const FloatImage& image) { return findImageSuns(image).suns.size(); };
    EXPECT_EQ(count(imageOf({512, 256},
                            [](const vec3& d) {
                                return isWithin(d, {1, 1, 0}, 10.0F)   ? vec3(60.0F)
                                       : isWithin(d, {0, 1, 1}, 25.0F) ? vec3(9.0F)
                                                                       : vec3(0.1F);
                            })),
              0U);
    EXPECT_EQ(count(imageOf({512, 256},
                            [](const vec3& d) {
                                return isWithin(d, {1, 1, 0}, 0.6F) ? 40.0F * blue : blue;
                            })),
              0U);
    EXPECT_EQ(count(imageOf({4, 2}, [](const vec3& d) { return isWithin(d, {1, 1, -1}, 60.0F) ? warm : blue; })), 0U);
    EXPECT_EQ(count(imageOf({64, 32}, [](const vec3&) { return vec3(0.0F); })), 0U);
    EXPECT_EQ(count(makeStudio()), 0U);
    for (const float elevation : {-4.0F, 1.0F, 10.0F, 50.0F, 90.0F}) {
        EXPECT_EQ(count(makeSky(elevation * degree).image), 0U) << elevation;
    }
}

TEST(ImageSuns, TheStrongestLightIsTheViewsSunTheOthersAreLamps) {
    View view;
    view.environment.image = std::make_shared<FloatImage>(imageOf({512, 256}, [](const vec3& d) {
        return isWithin(d, {1, 1, 0}, 2.0F) ? warm : blue;
    }));
    view.environment.rotation = 0.7F;
    view.environment.intensity = 0.5F;
    const ImageSuns found = findImageSuns(*view.environment.image);
    std::vector<Lamp> others;
    const View lit = withImageSuns(view, found, others);
    EXPECT_TRUE(others.empty());
    EXPECT_EQ(lit.environment.image, found.image);
    // In that direction the turned image shows it.
    expectNear(radianceFrom(view.environment, -lit.sun.direction), 0.5F * warm, 1e-3F);
    expectNear(lit.sun.irradiance, 0.5F * found.suns[0].irradiance, 1e-3F);

    view.sun.irradiance = vec3(1.0F);
    EXPECT_EQ(withImageSuns(view, found, others).sun, lit.sun);
    ASSERT_EQ(others.size(), 1U);
    EXPECT_EQ(others[0].type, Lamp::Type::directional);
    EXPECT_EQ(others[0].intensity, view.sun.irradiance);

    view.sun.irradiance = vec3(1000.0F);
    others.clear();
    EXPECT_EQ(withImageSuns(view, found, others).sun, view.sun);
    EXPECT_EQ(others.size(), 1U);
}

}  // namespace
}  // namespace reflet::image_suns_test
