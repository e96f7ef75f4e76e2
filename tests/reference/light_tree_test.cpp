// Choice of emissive triangles: probabilities, and none that is forgotten.
#include "reference/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reflet::test::light_tree_test {
namespace {

// Uniform in [-1, 1); the same on all platforms.
struct Random {
    std::mt19937 generator{7};

    float operator()() { return static_cast<float>(generator()) * 0x1p-31F - 1.0F; }
    vec3 point() { return {(*this)(), (*this)(), (*this)()}; }
    float unit() { return std::min(0.5F + 0.5F * (*this)(), 0x1.fffffep-1F); }
};

TriangleLight triangle(const vec3& a, const vec3& b, const vec3& c, float power, bool bothSides = false) {
    return {a, b, c, glm::normalize(glm::cross(b - a, c - a)), bothSides, power};
}

std::vector<TriangleLight> manyTriangles(Random& random, size_t count) {
    std::vector<TriangleLight> lights;
    for (size_t i = 0; i < count; ++i) {
        const vec3 at = 4.0F * random.point();
        const float size = std::exp(2.0F * random() - 1.5F);
        lights.push_back(triangle(at, at + size * random.point(), at + size * random.point(), std::exp(3.0F * random()),
                                  i % 3 == 0));
    }
    return lights;
}

LightReceiver receiver(Random& random) {
    return {5.0F * random.point(), random() > 0.5F ? vec3(0.0F) : glm::normalize(random.point())};
}

// Irradiance of the triangle's middle.
float arrives(const TriangleLight& light, const LightReceiver& at) {
    const vec3 offset = (light.a + light.b + light.c) / 3.0F - at.position;
    const float distance = glm::length(offset);
    const float emitted = -glm::dot(light.normal, offset) / distance;
    const float received = at.normal == vec3(0.0F) ? 1.0F : glm::dot(at.normal, offset) / distance;
    return light.power * std::max(light.bothSides ? std::abs(emitted) : emitted, 0.0F) * std::max(received, 0.0F) /
           (distance * distance);
}

TEST(LightTree, EveryLightThatArrivesMayBeChosen) {
    Random random;
    for (const size_t count : {1, 2, 3, 40, 500}) {
        const auto lights = manyTriangles(random, count);
        const LightTree tree(lights);
        for (int i = 0; i < 200; ++i) {
            const LightReceiver at = receiver(random);
            for (uint32_t k = 0; k < lights.size(); ++k) {
                if (arrives(lights[k], at) > 1e-5F * lights[k].power) {
                    ASSERT_GT(tree.probability(at, k), 0.0F) << count << " " << i << " " << k;
                }
            }
        }
    }
}

TEST(LightTree, DrawsByItsProbabilities) {
    Random random;
    const auto lights = manyTriangles(random, 60);
    const LightTree tree(lights);
    constexpr int draws = 100000;
    for (int i = 0; i < 5; ++i) {
        const LightReceiver at = receiver(random);
        std::vector<int> counts(lights.size());
        for (int k = 0; k < draws; ++k) {
            if (const auto choice = tree.draw(at, random.unit())) {
                ++counts[choice->light];
                ASSERT_NEAR(choice->probability, tree.probability(at, choice->light), 1e-5F * choice->probability);
            }
        }
        for (uint32_t k = 0; k < lights.size(); ++k) {
            const float expected = draws * tree.probability(at, k);
            EXPECT_NEAR(counts[k], expected, 5.0F * std::sqrt(expected) + 1.0F) << k;
        }
    }
}

TEST(LightTree, ChoosesWhatIsNearAndFacesThePoint) {
    std::vector<TriangleLight> lights;
    for (int i = 0; i < 100; ++i) {  // a row of lights that face down, and as many that face up
        const vec3 at(static_cast<float>(i), 1.0F, 0.0F);
        const vec3 side(0.1F, 0.0F, 0.0F);
        const vec3 back(0.0F, 0.0F, 0.1F);
        lights.push_back(triangle(at, at + side, at + back, 1.0F));
        lights.push_back(triangle(at, at + back, at + side, 1.0F));
    }
    const LightTree tree(lights);
    const LightReceiver floor{{50.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    float near = 0.0F;
    float away = 0.0F;
    for (uint32_t k = 0; k < lights.size(); ++k) {
        near += std::abs(lights[k].a.x - 50.0F) < 2.5F ? tree.probability(floor, k) : 0.0F;
        away += lights[k].normal.y > 0.0F ? tree.probability(floor, k) : 0.0F;
    }
    EXPECT_GT(near, 0.75F);
    EXPECT_LT(away, 0.01F);
    EXPECT_FALSE(tree.draw({{50.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F}}, 0.5F));
}

TEST(LightTree, LightsWithoutPowerAreNeverChosen) {
    const LightTree none(std::vector<TriangleLight>{triangle({0, 1, 0}, {1, 1, 0}, {0, 1, 1}, 0.0F)});
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(none.probability({}, 0), 0.0F);
    EXPECT_FALSE(none.draw({}, 0.5F));
}

// Thousands of triangles in one place cannot be divided by space.
TEST(LightTree, EqualTrianglesShareAlike) {
    const std::vector<TriangleLight> lights(4096, triangle({0, 1, 0}, {1, 1, 0}, {0, 1, 1}, 1.0F));
    const LightTree tree(lights);
    for (const uint32_t k : {0U, 1000U, 4095U}) {
        EXPECT_NEAR(tree.probability({}, k), 1.0F / 4096.0F, 1e-7F);
    }
}

}  // namespace
}  // namespace reflet::test::light_tree_test
