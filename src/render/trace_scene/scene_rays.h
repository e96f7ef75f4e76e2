// The scene's triangles on the device, for rays. A pass that traces has two shaders, which include the same body:
// x.comp after scene_rays.glsl (a hierarchy traversed in the shader, on every device) and x_query.comp after
// scene_rays_query.glsl (VK_KHR_ray_query). Both files say what they ask of their includer; both give
//     bool closestHit(vec3 origin, vec3 direction, float nearest, float farthest, out SceneHit hit)
//     bool anyHit(vec3 origin, vec3 direction, float nearest, float farthest)
//     SceneTriangle loadSceneTriangle(uint triangle)
#pragma once

#include "gpu/acceleration.h"
#include "gpu/resource.h"
#include "scene/bvh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::gpu {
class Device;
class Pass;
}  // namespace reflet::gpu

namespace reflet {

/// How rays find what they hit.
enum class RayMethod : uint8_t {
    traversal,  ///< a hierarchy of our own, in the shader
    query,      ///< the device's, by VK_KHR_ray_query
};

class SceneRays {
public:
    /// Keeps no reference to the scene. Throws Error: the device has no ray query, but it is asked for.
    SceneRays(gpu::Device& device, const Scene& scene, RayMethod method);

    /// Everything to where it is at the pose, of the same scene. What stands still is not built anew. No frame that
    /// traces may be in flight.
    void pose(gpu::Device& device, const Scene& scene, const ScenePose& pose);

    [[nodiscard]] RayMethod method() const { return method_; }
    [[nodiscard]] uint32_t triangleCount() const { return triangleCount_; }

    /// The variant of a shader: "trace_scene" gives "trace_scene.comp" or "trace_scene_query.comp".
    [[nodiscard]] std::string shader(std::string_view name) const;
    /// States what the shader's include reads.
    gpu::Pass& bind(gpu::Pass& pass) const;

private:
    void upload(gpu::Device& device, const Bvh& bvh);
    void upload(gpu::Device& device, std::vector<SceneTriangle> triangles);

    RayMethod method_;
    std::optional<std::vector<SceneTriangle>> standing_;  ///< what stands still, once something has moved
    std::optional<Bvh> standingBvh_;                      ///< traversal: over those, which are dropped
    uint32_t triangleCount_ = 0;
    gpu::Buffer triangles_;
    gpu::Buffer nodes_;                        ///< traversal
    gpu::AccelerationStructure acceleration_;  ///< query
};

}  // namespace reflet
