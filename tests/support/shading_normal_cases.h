// Shading normals, and what both functions that bend them must give: GLSL's (src/shaders/shading_normal.glsl) and the
// path tracer's (src/reference/surface.h).
#pragma once

#include "shader/directions.h"
#include "shader/shading_normal_test.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace reflet::test {

/// Normals all around geometric normals that face the viewer, down to grazing views.
inline std::vector<NormalCase> normalCases() {
    std::vector<NormalCase> cases;
    const std::vector<vec3> directions = spreadDirections(151);
    for (const vec3& geometric : {vec3(0, 1, 0), glm::normalize(vec3(0.5F, -0.2F, 0.8F))}) {
        for (const vec3& toViewer : directions) {
            if (glm::dot(toViewer, geometric) < 1e-3F) {
                continue;
            }
            for (const vec3& normal : directions) {
                cases.push_back({normal, geometric, toViewer});
            }
            cases.push_back({geometric, geometric, toViewer});
            cases.push_back({-geometric, geometric, toViewer});
        }
    }
    return cases;
}

inline void expectConsistentNormal(const NormalCase& c, const vec3& bent) {
    const auto mirrorHeight = [&](const vec3& n) {
        return 2.0F * glm::dot(n, c.toViewer) * glm::dot(n, c.geometric) - glm::dot(c.toViewer, c.geometric);
    };
    const float lowest = std::min(0.9F * glm::dot(c.toViewer, c.geometric), 0.01F);
    ASSERT_NEAR(glm::length(bent), 1.0F, 1e-5F);
    ASSERT_GT(glm::dot(bent, c.toViewer), 0.0F);
    ASSERT_GE(mirrorHeight(bent), lowest - 1e-5F);
    if (glm::dot(c.normal, c.geometric) > 0.0F && mirrorHeight(c.normal) >= lowest + 1e-5F) {
        ASSERT_LT(glm::length(bent - c.normal), 1e-6F);
        return;
    }
    if (glm::length(glm::cross(c.normal, c.geometric)) < 1e-3F) {
        return;  // straight down: any plane will do
    }
    // No further than it must, and in the plane of both normals.
    ASSERT_LE(mirrorHeight(bent), lowest + 1e-4F);
    ASSERT_NEAR(glm::dot(bent, glm::cross(c.normal, c.geometric)), 0.0F, 1e-4F);
}

}  // namespace reflet::test
