// Tangents of MikkTSpace against those of another implementation: the npm package mikktspace 1.1.1 (WebAssembly, which
// three.js uses), run once on the same triangles. Its signs are negated, as three.js does for glTF.
#include "scene/tangent_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace reflet::tangent_space_test {
namespace {

/// Three corners per triangle, without indices.
struct Corners {
    std::vector<vec3> positions;
    std::vector<vec3> normals;
    std::vector<vec2> uvs;

    void add(const vec3& position, const vec3& normal, const vec2& uv) {
        positions.push_back(position);
        normals.push_back(normal);
        uvs.push_back(uv);
    }
};

void expectTangents(const Corners& mesh, const std::vector<vec4>& expected) {
    std::vector<uint32_t> indices(mesh.positions.size());
    std::iota(indices.begin(), indices.end(), 0U);
    const std::vector<vec4> tangents = tangentSpaces({mesh.positions, mesh.normals, mesh.uvs, indices});
    ASSERT_EQ(tangents.size(), expected.size());
    for (size_t i = 0; i < expected.size(); ++i) {
        // Without a frame the package has (1, 0, 0), and we say so.
        const vec4 tangent = tangents[i] == vec4(0.0F) ? vec4(1, 0, 0, 1) : tangents[i];
        EXPECT_NEAR(glm::distance(tangent, expected[i]), 0.0F, 1e-6F) << "corner " << i;
    }
}

// clang-format off
const std::vector<vec4> cubeTangents{
    {0.408248246F, 0.816496551F, -0.408248246F, -1}, {-0.408248276F, 0.816496611F, 0.408248276F, -1}, {-0.408248246F,
    0.816496551F, -0.408248246F, -1}, {0.408248246F, 0.816496551F, -0.408248246F, -1}, {-0.408248246F, 0.816496551F,
    -0.408248246F, -1}, {0.408248276F, 0.816496611F, 0.408248276F, -1}, {0.408248246F, 0.816496551F, 0.408248246F, 1},
    {-0.408248276F, 0.816496611F, -0.408248276F, 1}, {-0.408248246F, 0.816496551F, 0.408248246F, 1}, {0.408248246F,
    0.816496551F, 0.408248246F, 1}, {-0.408248246F, 0.816496551F, 0.408248246F, 1}, {0.408248276F, 0.816496611F,
    -0.408248276F, 1}, {-0.408248246F, 0.408248246F, 0.816496551F, -1}, {0.408248276F, -0.408248276F, 0.816496611F,
    -1}, {-0.408248246F, -0.408248246F, 0.816496551F, -1}, {-0.408248246F, 0.408248246F, 0.816496551F, -1},
    {-0.408248246F, -0.408248246F, 0.816496551F, -1}, {0.408248276F, 0.408248276F, 0.816496611F, -1}, {-0.408248246F,
    -0.408248246F, -0.816496551F, -1}, {0.408248276F, 0.408248276F, -0.816496611F, -1}, {-0.408248246F, 0.408248246F,
    -0.816496551F, -1}, {-0.408248246F, -0.408248246F, -0.816496551F, -1}, {-0.408248246F, 0.408248246F,
    -0.816496551F, -1}, {0.408248276F, -0.408248276F, -0.816496611F, -1}, {-0.816496551F, 0.408248246F, -0.408248246F,
    1}, {-0.816496611F, -0.408248276F, 0.408248276F, 1}, {-0.816496551F, 0.408248246F, 0.408248246F, 1},
    {-0.816496551F, 0.408248246F, -0.408248246F, 1}, {-0.816496551F, 0.408248246F, 0.408248246F, 1}, {-0.816496611F,
    -0.408248276F, -0.408248276F, 1}, {-0.816496551F, -0.408248246F, -0.408248246F, -1}, {-0.816496611F, 0.408248276F,
    0.408248276F, -1}, {-0.816496551F, -0.408248246F, 0.408248246F, -1}, {-0.816496551F, -0.408248246F, -0.408248246F,
    -1}, {-0.816496551F, -0.408248246F, 0.408248246F, -1}, {-0.816496611F, 0.408248276F, -0.408248276F, -1}};

const std::vector<vec4> sphereTangents{
    {1, 0, 0, 1}, {-0.707106769F, 0, 0.707106769F, -1}, {-0.223606825F, 0.387298346F, 0.89442718F, -1},
    {-0.707106769F, 0, 0.707106769F, -1}, {-1, 0, 0, -1}, {-0.223606825F, 0.387298346F, 0.89442718F, -1},
    {-0.707106769F, 0, 0.707106769F, -1}, {-0.707106769F, 0, -0.707106769F, -1}, {-1, 0, 0, -1}, {-0.707106769F, 0,
    -0.707106769F, -1}, {0, 0, -1, -1}, {-1, 0, 0, -1}, {-0.707106769F, 0, -0.707106769F, -1}, {0.707106769F, 0,
    -0.707106769F, -1}, {0, 0, -1, -1}, {0.707106769F, 0, -0.707106769F, -1}, {1, 0, 0, -1}, {0, 0, -1, -1},
    {0.707106769F, 0, -0.707106769F, -1}, {0.707106769F, 0, 0.707106769F, -1}, {1, 0, 0, -1}, {0.707106769F, 0,
    0.707106769F, -1}, {0.22360681F, -0.387298316F, 0.894427121F, -1}, {1, 0, 0, -1}, {-0.223606825F, 0.387298346F,
    0.89442718F, -1}, {-1, 0, 0, -1}, {-0.22360681F, -0.387298316F, 0.894427121F, -1}, {-1, 0, 0, -1}, {-1, 0, 0, -1},
    {-0.22360681F, -0.387298316F, 0.894427121F, -1}, {-1, 0, 0, -1}, {0, 0, -1, -1}, {-1, 0, 0, -1}, {0, 0, -1, -1},
    {0, 0, -1, -1}, {-1, 0, 0, -1}, {0, 0, -1, -1}, {1, 0, 0, -1}, {0, 0, -1, -1}, {1, 0, 0, -1}, {1, 0, 0, -1}, {0,
    0, -1, -1}, {1, 0, 0, -1}, {0.22360681F, -0.387298316F, 0.894427121F, -1}, {1, 0, 0, -1}, {0.22360681F,
    -0.387298316F, 0.894427121F, -1}, {0.223606825F, 0.387298346F, 0.89442718F, -1}, {1, 0, 0, -1}, {-0.22360681F,
    -0.387298316F, 0.894427121F, -1}, {-1, 0, 0, -1}, {-0.707106769F, 0, 0.707106769F, -1}, {-1, 0, 0, -1},
    {-0.707106769F, 0, -0.707106769F, -1}, {-0.707106769F, 0, 0.707106769F, -1}, {-1, 0, 0, -1}, {0, 0, -1, -1},
    {-0.707106769F, 0, -0.707106769F, -1}, {0, 0, -1, -1}, {0.707106769F, 0, -0.707106769F, -1}, {-0.707106769F, 0,
    -0.707106769F, -1}, {0, 0, -1, -1}, {1, 0, 0, -1}, {0.707106769F, 0, -0.707106769F, -1}, {1, 0, 0, -1},
    {0.707106769F, 0, 0.707106769F, -1}, {0.707106769F, 0, -0.707106769F, -1}, {1, 0, 0, -1}, {0.223606825F,
    0.387298346F, 0.89442718F, -1}, {0.707106769F, 0, 0.707106769F, -1}, {0.223606825F, 0.387298346F, 0.89442718F,
    -1}, {1, 0, 0, 1}, {0.707106769F, 0, 0.707106769F, -1}};

const std::vector<vec4> stripTangents{
    {0.799999952F, 0, 0.600000024F, -1}, {0.799999952F, 0, 0.600000024F, -1}, {1, 0, 0, -1}, {1, 0, 0, -1},
    {0.799999952F, 0, 0.600000024F, -1}, {1, 0, 0, -1}, {1, 0, 0, -1}, {1, 0, 0, -1}, {1, 0, 0, -1}, {0.799999952F, 0,
    0.600000024F, -1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {0.799999952F, 0, 0.600000024F, -1}, {1, 0, 0, 1}, {1, 0, 0, -1},
    {-0.951705992F, 0.245608807F, -0.184206575F, 1}, {-1, 0, 0, 1}, {-0.799999833F, 0, 0.600000083F, 1},
    {-0.951705992F, 0.245608807F, -0.184206575F, 1}, {-0.799999833F, 0, 0.600000083F, 1}, {-1, 0, 0, 1}};
// clang-format on

/// Smooth normals; the images of two sides are mirrored, and those of the last three half as high.
TEST(TangentSpace, OfACubeWithMirroredSides) {
    Corners cube;
    const vec2 places[] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const float sign = side % 2 == 1 ? -1.0F : 1.0F;
        for (const vec2& at : places) {
            vec3 p(0.0F);
            p[axis] = sign;
            p[(axis + 1) % 3] = (2.0F * at.x - 1.0F) * sign;
            p[(axis + 2) % 3] = 2.0F * at.y - 1.0F;
            cube.add(p, p * (1.0F / std::sqrt(3.0F)),
                     {side % 3 == 1 ? 1.0F - at.x : at.x, at.y * (side < 3 ? 1.0F : 0.5F)});
        }
    }
    expectTangents(cube, cubeTangents);
}

/// Four segments, three rings, a seam; half of the triangles at the poles have no area.
TEST(TangentSpace, OfASphereWithTrianglesWithoutAreaAtItsPoles) {
    const float cosine[] = {1, 0, -1, 0, 1};
    const float sine[] = {0, 1, 0, -1, 0};
    Corners sphere;
    for (unsigned ring = 0; ring < 3; ++ring) {
        for (unsigned segment = 0; segment < 4; ++segment) {
            const glm::uvec2 quad[] = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}};
            for (const glm::uvec2& corner : quad) {
                const unsigned r = ring + corner.y;
                const unsigned s = segment + corner.x;
                const double height = r * glm::pi<double>() / 3.0;
                const auto radius = static_cast<float>(r == 0 || r == 3 ? 0.0 : std::sin(height));
                const vec3 p(radius * cosine[s], std::cos(height), radius * sine[s]);
                sphere.add(p, p, {float(s) / 4.0F, static_cast<float>(r / 3.0)});
            }
        }
    }
    expectTangents(sphere, sphereTangents);
}

/// A triangle without area, and three quads: one with a plain image, one whose image is a line, a mirrored one.
TEST(TangentSpace, OfAStripWithDegenerateUvs) {
    const vec3 positions[] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}, {2, 0, 0}, {2, 1, 0}, {3, 0, 1}, {3, 1, 0}};
    const vec3 normals[] = {{0, 0, 1},       {0, 0, 1}, {-0.6F, 0, 0.8F}, {0, 0, 1},
                            {0, 0.6F, 0.8F}, {0, 0, 1}, {0, 0, 1},        {0.6F, 0, 0.8F}};
    const vec2 uvs[] = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {1, 0}, {1, 1}, {0, 0}, {0, 1}};
    std::vector<unsigned> indices{2, 2, 3};
    for (unsigned a = 0; a < 6; a += 2) {
        indices.insert(indices.end(), {a, a + 2, a + 3, a, a + 3, a + 1});
    }
    Corners strip;
    for (const unsigned i : indices) {
        strip.add(positions[i], normals[i], uvs[i]);
    }
    expectTangents(strip, stripTangents);
}

TEST(TangentSpace, OfAFanOfManyTrianglesTakesTimeInProportion) {
    Corners fan;
    constexpr int many = 300000;
    const auto rim = [](int i) {
        const double angle = 2.0 * glm::pi<double>() * i / many;
        return vec3(std::cos(angle), std::sin(angle), 0.0);
    };
    for (int i = 0; i < many; ++i) {
        for (const vec3& p : {vec3(0.0F), rim(i), rim(i + 1)}) {
            fan.add(p, {0, 0, 1}, vec2(p));
        }
    }
    std::vector<uint32_t> indices(fan.positions.size());
    std::iota(indices.begin(), indices.end(), 0U);
    const std::vector<vec4> tangents = tangentSpaces({fan.positions, fan.normals, fan.uvs, indices});
    EXPECT_NEAR(glm::distance(tangents[0], vec4(1, 0, 0, -1)), 0.0F, 0.02F);
    EXPECT_EQ(tangents[0], tangents[3 * (many - 1)]) << "one vertex";
}

}  // namespace
}  // namespace reflet::tangent_space_test
