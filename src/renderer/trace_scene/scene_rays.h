// The scene's triangles and BVH on the device. A pass that traces rays has two shaders, which include the same body:
// x.comp after scene_rays.glsl (software BVH traversal, on every device) and x_query.comp after scene_rays_query.glsl
// (VK_KHR_ray_query). Both files document what the includer must define; both provide
//     bool closestHit(vec3 origin, vec3 direction, float nearest, float farthest, out SceneHit hit)
//     bool anyHit(vec3 origin, vec3 direction, float nearest, float farthest)
//     SceneTriangle loadSceneTriangle(uint triangle)
#pragma once

#include "device/acceleration.h"
#include "gpu/resource.h"
#include "scene/bvh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::gpu {
class Device;
class ComputePass;
}  // namespace reflet::gpu

namespace reflet {

/// Ray tracing method.
enum class RayMethod : uint8_t {
    traversal,  ///< software BVH traversal in the shader
    query,      ///< hardware, by VK_KHR_ray_query
};

class SceneRays {
public:
    /// Keeps no reference to the scene. Throws Error if ray query is requested but not supported.
    SceneRays(gpu::Device& device, const Scene& scene, RayMethod method);

    /// Updates all triangles to a pose of the same scene. The BVH of static geometry is not rebuilt. No frame that
    /// traces may be in flight.
    void pose(gpu::Device& device, const Scene& scene, const ScenePose& pose);

    [[nodiscard]] RayMethod method() const { return method_; }

    /// The shader variant for the method: "trace_scene" gives "trace_scene.comp" or "trace_scene_query.comp".
    [[nodiscard]] std::string shader(std::string_view name) const;
    /// Binds the resources of the shader's include.
    gpu::ComputePass& bind(gpu::ComputePass& pass) const;

private:
    void upload(gpu::Device& device, const Bvh& bvh);
    void upload(gpu::Device& device, std::vector<SceneTriangle> triangles);

    RayMethod method_;
    std::optional<std::vector<SceneTriangle>> standing_;  ///< static triangles, once something has moved
    std::optional<Bvh> standingBvh_;  ///< traversal: BVH of the static triangles, which then replaces `standing_`
    gpu::Buffer triangles_;
    gpu::Buffer nodes_;                        ///< traversal
    gpu::AccelerationStructure acceleration_;  ///< query
};

}  // namespace reflet
