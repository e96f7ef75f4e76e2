// Synthetic scenes for the methods of march*.glsl: parts of planes, seen by a camera that looks along -Z from the
// origin.
#pragma once

#include "renderer/renderer.h"
#include "shader/harness.h"
#include "shader/march_test.h"

#include <algorithm>
#include <random>

namespace reflet::test {

inline constexpr uint32_t marchHit = 0;
inline constexpr uint32_t marchLeftScreen = 1;
inline constexpr uint32_t marchLimitReached = 2;
inline constexpr uint32_t marchOccluded = 3;
inline constexpr uvec2 pixels{320, 180};

inline Camera cameraOf(bool orthographic) {
    Camera camera;
    camera.position = vec3(0.0F);
    camera.target = vec3(0, 0, -1);
    camera.near = 0.1F;
    camera.orthographicHeight = orthographic ? 10.0F : 0.0F;
    camera.far = 100.0F;
    return camera;
}

/// The plane z = -distance, where uv lies in the given part of the screen.
inline MarchWall wallAt(float distance, vec2 firstUv = vec2(-1.0F), vec2 lastUv = vec2(2.0F)) {
    return {vec4(0, 0, 1, distance), firstUv, lastUv};
}

class March : public ShaderTest, public ::testing::WithParamInterface<bool> {
protected:
    [[nodiscard]] static MarchScene sceneOf(const std::vector<MarchWall>& walls) {
        MarchScene scene{};
        scene.view = makeViewParams(cameraOf(GetParam()), pixels, 0, 0);
        std::ranges::copy(walls, scene.walls);
        scene.wallCount = static_cast<uint32_t>(walls.size());
        return scene;
    }

    static std::vector<MarchAnswer> march(const MarchScene& scene, const std::vector<MarchInput>& rays,
                                          uint32_t method = marchMethodLinear, bool secondLayer = false) {
        return mapOnDevice<MarchAnswer>("march_test.comp", rays, scene, [&](gpu::ComputePass& pass) {
            pass.constant("method", method).constant("secondLayer", secondLayer ? 1U : 0U);
        });
    }

    /// How far a ray is from the wall z = -distance [m].
    static double toWall(const MarchInput& ray, double distance) {
        return (ray.origin.z + distance) / -static_cast<double>(ray.direction.z);
    }

    /// Where a world point is on the screen [pixels], in double precision.
    static glm::dvec2 project(const glm::dvec3& p) {
        const double scale = GetParam() ? 1.0 / 10.0 : 0.5 / (std::tan(glm::radians(30.0)) * -p.z);
        return {0.5 * pixels.x + p.x * scale * pixels.y, 0.5 * pixels.y - p.y * scale * pixels.y};
    }

    /// Rays from all over the middle of the view into its depth.
    static std::vector<MarchInput> raysIntoDepth(float jitter, float stepLength) {
        std::mt19937 random(7);
        const auto between = [&](float low, float high) {
            return low + (high - low) * static_cast<float>(random() >> 8U) / 16777216.0F;
        };
        std::vector<MarchInput> rays;
        for (int i = 0; i < 500; ++i) {
            const vec3 origin(between(-0.5F, 0.5F), between(-0.5F, 0.5F), between(-4.0F, -2.0F));
            const vec3 direction = glm::normalize(vec3(between(-0.3F, 0.3F), between(-0.25F, 0.25F), -1.0F));
            rays.push_back({origin, direction, stepLength, 4096, 0.5F, jitter, {}});
        }
        return rays;
    }
};

}  // namespace reflet::test
