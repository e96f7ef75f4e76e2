// effects/cube_map: faces, filtered lobes against an integral over the GGX lobe, irradiance against closed forms.
#include "shader/cube_map_test.h"

#include "device/device.h"
#include "effects/cube_map/cube_map.h"
#include "shader/directions.h"
#include "shader/harness.h"
#include "support/ggx_reference.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace reflet::test::cube_map_test {
namespace {

using LightFrom = std::function<glm::dvec3(const glm::dvec3& direction, uint32_t cube)>;

// Written from the table "Cube map face selection" of the Vulkan specification, not from the shader.
glm::dvec3 faceDirection(uint32_t face, const glm::dvec2& uv) {
    const double s = 2.0 * uv.x - 1.0;
    const double t = 2.0 * uv.y - 1.0;
    const glm::dvec3 directions[] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    return glm::normalize(directions[face]);
}

class CubeMaps : public ShaderTest {
protected:
    /// A map whose texels are the mean of a few samples of their area.
    static CubeMap make(uint32_t side, uint32_t cubes, const LightFrom& light) {
        constexpr uint32_t parts = 4;
        std::vector<vec3> colors;
        for (uint32_t i = 0; i < 6 * cubes * side * side; ++i) {
            const glm::dvec2 texel(i % side, i / side % side);
            const uint32_t layer = i / (side * side);
            glm::dvec3 sum(0.0);
            for (uint32_t part = 0; part < parts * parts; ++part) {
                const glm::dvec2 inside = (glm::dvec2(part % parts, part / parts) + 0.5) / double(parts);
                sum += light(faceDirection(layer % 6, (texel + inside) / double(side)), layer / 6);
            }
            colors.emplace_back(sum / double(parts * parts));
        }
        CubeMap map(device(), side, cubes, "test");
        fill(map, colors);
        return map;
    }

    static void fill(const CubeMap& map, const std::vector<vec3>& colors) {
        const gpu::Buffer upload(device(), colors.size() * sizeof(vec3), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                 gpu::MemoryUse::upload, "colors");
        std::memcpy(upload.bytes().data(), colors.data(), colors.size() * sizeof(vec3));
        registerTestShaders();
        record([&](gpu::Frame& f) {
            const gpu::Image faces = map.sharp.mip(0);
            f.compute("fill", "cube_map_fill_test.comp")
                .read("colors", upload.view())
                .write("faces", faces)
                .dispatch(faces.size.x, faces.size.y, faces.layers);
        });
    }

    static CubeMap filtered(uint32_t side, uint32_t cubes, const LightFrom& light) {
        CubeMap map = make(side, cubes, light);
        record([&](gpu::Frame& f) { filterCubeMap(f, map, 0, cubes); });
        return map;
    }

    static std::vector<CubeLight> lookUp(const CubeMap& map, const std::vector<CubeLookup>& lookups) {
        const VkSampler linear = device().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR, VK_SAMPLER_MIPMAP_MODE_LINEAR});
        return mapOnDevice<CubeLight>("cube_map_test.comp", lookups, NoParams{}, [&](gpu::ComputePass& pass) {
            pass.read("sharp", map.sharp.image(), linear)
                .read("lobes", map.lobes.image(), linear)
                .read("irradiance", map.irradiance.image());
        });
    }
};

glm::dvec3 perpendicularTo(const glm::dvec3& n) {
    return glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

/// Mean radiance, weighted by the GGX lobe of a surface that faces n, for a view along n.
glm::dvec3 lobeMean(const LightFrom& light, const glm::dvec3& n, double roughness) {
    constexpr int steps = 200;
    const double alpha = roughness * roughness;
    const glm::dvec3 x = perpendicularTo(n);
    const glm::dvec3 y = glm::cross(n, x);
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double s = (i + 0.5) / steps;
        const double tangent = alpha * s / (1.0 - s);
        const double theta = std::atan(tangent);
        const double thetaStep = alpha / ((1.0 - s) * (1.0 - s)) / (1.0 + tangent * tangent);
        if (2.0 * theta >= glm::half_pi<double>()) {
            continue;
        }
        const double weight = ggxBrdf({0, 0, 1}, {std::sin(2.0 * theta), 0, std::cos(2.0 * theta)}, alpha, 1.0) *
                              std::cos(2.0 * theta) * std::sin(2.0 * theta) * thetaStep;
        for (int j = 0; j < steps; ++j) {
            const double phi = 2.0 * glm::pi<double>() * (j + 0.5) / steps;
            const glm::dvec3 l =
                std::sin(2.0 * theta) * (std::cos(phi) * x + std::sin(phi) * y) + std::cos(2.0 * theta) * n;
            sum += weight * light(l, 0);
            weights += weight;
        }
    }
    return sum / weights;
}

std::vector<CubeLookup> everywhere(size_t count, float roughness, uint32_t cube = 0) {
    std::vector<CubeLookup> lookups;
    for (const vec3& direction : spreadDirections(count)) {
        lookups.push_back({direction, roughness, cube});
    }
    return lookups;
}

const vec3 spotDirection = glm::normalize(vec3(1, 0.8F, -0.3F));

TEST_F(CubeMaps, aDirectionFindsTheLightThatComesFromIt) {
    const CubeMap map = filtered(64, 1, [](const glm::dvec3& d, uint32_t) { return 2.0 + d; });
    const auto lookups = everywhere(3000, 0.0F);
    const auto found = lookUp(map, lookups);
    for (size_t i = 0; i < found.size(); ++i) {
        ASSERT_LT(glm::length(found[i].sharp - 2.0F - lookups[i].direction), 0.01F) << i;
        ASSERT_LT(glm::length(found[i].lobe - found[i].sharp), 1e-3F) << "the smoothest lobe is sharp";
    }
}

TEST_F(CubeMaps, constantLightIsItselfAtEveryRoughnessInEveryCubeOfAnArray) {
    const vec3 colors[] = {{0.5F, 60000.0F, 1e-3F}, {7.0F, 0.0F, 1.0F}};
    const CubeMap map = filtered(32, 2, [&](const glm::dvec3&, uint32_t cube) { return glm::dvec3(colors[cube]); });
    for (uint32_t cube = 0; cube < 2; ++cube) {
        for (int step = 0; step <= 20; ++step) {
            for (const CubeLight& light : lookUp(map, everywhere(500, static_cast<float>(step) / 20.0F, cube))) {
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(light.lobe[c], colors[cube][c], 1e-3F * colors[cube][c]) << step;
                    ASSERT_NEAR(light.irradiance[c], colors[cube][c], 1e-3F * colors[cube][c]);
                }
            }
        }
    }
}

struct LightCase {
    const char* name;
    LightFrom light;
    double meanError;  ///< of the light's largest mean over a lobe
    double largestError;
};

class CubeLobes : public CubeMaps, public testing::WithParamInterface<LightCase> {};

TEST_P(CubeLobes, holdTheMeanOfTheLightWeightedByGgx) {
    const auto& [name, light, meanError, largestError] = GetParam();
    const CubeMap map = filtered(128, 1, light);
    for (const float roughness : {0.1F, 0.2F, 0.3F, 0.4F, 0.6F, 0.7F, 0.8F, 0.9F, 1.0F}) {
        auto lookups = everywhere(60, roughness);
        lookups.push_back({spotDirection, roughness, 0});
        lookups.push_back({glm::normalize(vec3(1, 0.6F, -0.1F)), roughness, 0});
        const auto found = lookUp(map, lookups);
        double sum = 0.0;
        double largest = 0.0;
        double peak = 0.0;
        for (size_t i = 0; i < lookups.size(); ++i) {
            const double truth = lobeMean(light, lookups[i].direction, roughness).x;
            const double off = std::abs(found[i].lobe.x - truth);
            sum += off;
            largest = std::max(largest, off);
            peak = std::max(peak, truth);
        }
        EXPECT_LT(sum / double(lookups.size()), meanError * peak) << roughness;
        EXPECT_LT(largest, largestError * peak) << roughness;
    }
}

// Measured: gradient 1.1 % and 2.1 %, half 2.8 % and 7.7 % (roughness 0.1: the edge is as wide as two texels), spot
// 2.2 % and 15 % (roughness 0.1, between two levels).
INSTANTIATE_TEST_SUITE_P(
    Lights, CubeLobes,
    testing::Values(
        LightCase{"gradient", [](const glm::dvec3& d, uint32_t) { return glm::dvec3(1.0 + d.x); }, 0.013, 0.025},
        LightCase{"half", [](const glm::dvec3& d, uint32_t) { return glm::dvec3(d.y > 0.3 * d.x ? 1.0 : 0.0); }, 0.03,
                  0.09},
        LightCase{"spot",
                  [](const glm::dvec3& d, uint32_t) {
                      return glm::dvec3(glm::dot(d, glm::dvec3(spotDirection)) > std::cos(0.1) ? 100.0 : 0.1);
                  },
                  0.025, 0.16}),
    [](const auto& light) { return light.param.name; });

TEST_F(CubeMaps, irradianceUnderAWhiteHalfIsAnalytic) {
    const glm::dvec3 up = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
    const CubeMap map =
        filtered(64, 1, [&](const glm::dvec3& d, uint32_t) { return glm::dvec3(glm::dot(d, up) > 0.0 ? 1.0 : 0.0); });
    const auto lookups = everywhere(500, 0.0F);
    const auto found = lookUp(map, lookups);
    for (size_t i = 0; i < found.size(); ++i) {
        // Exact with degrees 0 and 1: (1 + cos) / 2.
        ASSERT_NEAR(found[i].irradiance.x, 0.5 + 0.5 * glm::dot(glm::dvec3(lookups[i].direction), up), 3e-3) << i;
    }
}

TEST_F(CubeMaps, irradianceOfOneBrightTexelIsThatOfItsNineCoefficientsAndNeverNegative) {
    constexpr uint32_t side = 64;
    CubeMap map(device(), side, 1, "texel");
    for (const uvec2 texel : {uvec2(31, 31), uvec2(0, 0), uvec2(50, 12)}) {
        constexpr uint32_t face = 4;
        std::vector<vec3> colors(size_t{6} * side * side, vec3(0.0F));
        colors[(size_t{face} * side + texel.y) * side + texel.x] = vec3(10000.0F);
        fill(map, colors);
        record([&](gpu::Frame& f) { filterCubeMap(f, map, 0, 1); });
        const glm::dvec2 at = (glm::dvec2(texel) + 0.5) / double(side);
        const glm::dvec3 light = faceDirection(face, at);
        const double distance2 = 1.0 + glm::dot(2.0 * at - 1.0, 2.0 * at - 1.0);
        const double irradiance = 10000.0 * 4.0 / (side * side) / std::pow(distance2, 1.5);
        const auto lookups = everywhere(500, 0.0F);
        const auto found = lookUp(map, lookups);
        for (size_t i = 0; i < found.size(); ++i) {
            const double c = glm::dot(glm::dvec3(lookups[i].direction), light);
            const double degrees = 0.25 + 0.5 * c + 5.0 / 32.0 * (3.0 * c * c - 1.0);  // of max(c, 0)
            // The coefficients come from texels of twice the size, whose centre is 1 degree off.
            ASSERT_NEAR(found[i].irradiance.x, irradiance / glm::pi<double>() * std::max(degrees, 0.0),
                        0.03 * irradiance / glm::pi<double>())
                << i << ", " << texel.x;
            ASSERT_GE(found[i].irradiance.x, 0.0F);
        }
    }
}

TEST_F(CubeMaps, filteringSomeFacesLeavesTheOthersAsTheyAre) {
    const auto bright = [](float factor) { return std::vector<vec3>(size_t{12} * 16 * 16, vec3(factor)); };
    CubeMap map(device(), 16, 2, "two");
    fill(map, bright(1.0F));
    record([&](gpu::Frame& f) { filterCubeMap(f, map, 0, 2); });
    fill(map, bright(3.0F));
    record([&](gpu::Frame& f) {
        makeCubeMips(f, map, {6, 6});
        filterCubeLobes(f, map, {8, 1});  // +Y of the second cube
        projectCubeIrradiance(f, map, 1, 1);
    });
    const auto found = lookUp(map, {{{0, 1, 0}, 0.3F, 0}, {{0, 1, 0}, 0.3F, 1}, {{1, 0, 0}, 0.3F, 1}});
    EXPECT_NEAR(found[0].lobe.x, 1.0F, 1e-3F) << "the other cube";
    EXPECT_NEAR(found[1].lobe.x, 3.0F, 1e-3F) << "the face";
    EXPECT_NEAR(found[2].lobe.x, 1.0F, 1e-3F) << "another face of its cube";
    EXPECT_NEAR(found[0].irradiance.x, 1.0F, 1e-3F);
    EXPECT_NEAR(found[1].irradiance.x, 3.0F, 1e-3F);
}

}  // namespace
}  // namespace reflet::test::cube_map_test
