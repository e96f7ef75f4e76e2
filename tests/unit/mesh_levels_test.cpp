// Levels of detail of meshes that are placed many times.
#include "scene/mesh_levels.h"

#include "scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reflet {
namespace {

// A ball with bumps of 2 % of its radius, of 2 * rings * rings triangles.
Mesh bumpyBall(uint32_t rings) {
    Mesh mesh;
    const auto angle = [&](uint32_t i, float whole) {
        return whole * static_cast<float>(i) / static_cast<float>(rings);
    };
    for (uint32_t row = 0; row <= rings; ++row) {
        for (uint32_t column = 0; column <= rings; ++column) {
            const float down = angle(row, std::numbers::pi_v<float>);
            const float around = angle(column % rings, 2.0F * std::numbers::pi_v<float>);
            const float radius = 1.0F + 0.02F * std::sin(7.0F * around) * std::sin(down);
            const vec3 direction(std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around));
            mesh.positions.push_back(radius * direction);
            mesh.bounds.add(mesh.positions.back());
        }
    }
    mesh.attributes.resize(mesh.positions.size());
    for (uint32_t row = 0; row < rings; ++row) {
        for (uint32_t column = 0; column < rings; ++column) {
            const uint32_t a = row * (rings + 1) + column;
            const uint32_t b = a + rings + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
        }
    }
    return mesh;
}

Scene placed(Mesh mesh, size_t count) {
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(std::move(mesh));
    scene.instances.resize(count);
    return scene;
}

// Of the mesh's vertices from the level's triangles along rays from the centre.
float largestGap(const Mesh& mesh, const MeshLevel& level) {
    float largest = 0.0F;
    for (const vec3& p : mesh.positions) {
        float nearest = 1e9F;
        for (size_t i = 0; i < level.indices.size(); i += 3) {
            const vec3& a = mesh.positions[level.indices[i]];
            const vec3 u = mesh.positions[level.indices[i + 1]] - a;
            const vec3 v = mesh.positions[level.indices[i + 2]] - a;
            const mat3 basis(u, v, -p);
            if (std::abs(glm::determinant(basis)) < 1e-12F) {
                continue;
            }
            const vec3 s = glm::inverse(basis) * -a;  // a + s.x u + s.y v = s.z p
            if (s.x >= -1e-3F && s.y >= -1e-3F && s.x + s.y <= 1.001F && s.z > 0.0F) {
                nearest = std::min(nearest, std::abs(s.z - 1.0F) * glm::length(p));
            }
        }
        largest = std::max(largest, nearest);
    }
    return largest;
}

TEST(MeshLevels, StayAsNearToTheMeshAsTheySay) {
    const Scene scene = placed(bumpyBall(40), 100);
    const Mesh& mesh = scene.meshes.front();
    const std::vector<MeshLevel> levels = meshLevels(scene).front();
    ASSERT_GE(levels.size(), 4U);
    size_t triangles = mesh.indices.size() / 3;
    float error = 0.0F;
    for (const MeshLevel& level : levels) {
        EXPECT_LE(level.indices.size(), 2 * triangles);  // two thirds of the triangles
        EXPECT_GT(level.error, error);
        EXPECT_LE(largestGap(mesh, level), 3.0F * level.error + 1e-4F) << level.indices.size() / 3 << " triangles";
        EXPECT_LT(*std::ranges::max_element(level.indices), mesh.positions.size());
        triangles = level.indices.size() / 3;
        error = level.error;
    }
    EXPECT_LE(triangles, 100U);
}

TEST(MeshLevels, AreMadeOnlyWhereTheySaveTime) {
    EXPECT_TRUE(meshLevels(placed(bumpyBall(40), 7)).front().empty());
    EXPECT_TRUE(meshLevels(placed(bumpyBall(8), 1000)).front().empty());
    EXPECT_TRUE(meshLevels(placed(bumpyBall(12), 100)).front().empty());
    Scene bent = placed(bumpyBall(40), 100);
    bent.meshes.front().skin.resize(bent.meshes.front().positions.size());
    EXPECT_TRUE(meshLevels(bent).front().empty());
}

}  // namespace
}  // namespace reflet
