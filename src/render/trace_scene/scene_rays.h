// The scene's triangles on the device, for rays. A pass that traces has two shaders, which include the same body:
// x.comp after scene_rays.glsl (a hierarchy traversed in the shader, on every device) and x_query.comp after
// scene_rays_query.glsl (VK_KHR_ray_query). Both files say what they ask of their includer; both give
//     bool closestHit(vec3 origin, vec3 direction, float nearest, float farthest, out SceneHit hit)
//     bool anyHit(vec3 origin, vec3 direction, float nearest, float farthest)
//     SceneTriangle loadSceneTriangle(uint triangle)
#pragma once

#include "gpu/acceleration.h"
#include "gpu/resource.h"
#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <string_view>

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

    [[nodiscard]] RayMethod method() const { return method_; }
    [[nodiscard]] uint32_t triangleCount() const { return triangleCount_; }

    /// The variant of a shader: "trace_scene" gives "trace_scene.comp" or "trace_scene_query.comp".
    [[nodiscard]] std::string shader(std::string_view name) const;
    /// States what the shader's include reads.
    gpu::Pass& bind(gpu::Pass& pass) const;

private:
    RayMethod method_;
    uint32_t triangleCount_ = 0;
    gpu::Buffer triangles_;
    gpu::Buffer nodes_;                        ///< traversal
    gpu::AccelerationStructure acceleration_;  ///< query
};

}  // namespace reflet
