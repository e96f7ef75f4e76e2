// What the scene's triangles are made of, for rays: vertex attributes, instances, materials, textures as layers of two
// arrays (colours and data). A pass binds it all beside SceneRays; scene_surfaces.glsl reads it.
#pragma once

#include "gpu/resource.h"
#include "render/gpu_scene.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <string>

namespace reflet::gpu {
class Device;
class Pass;
}  // namespace reflet::gpu

namespace reflet {

class SceneSurfaces {
public:
    /// textureSize: texels along each side of the largest layer; images that are larger are shrunk, of which `warn`
    /// hears. Vertices are those of `onDevice`, which must be of the same scene and outlive this.
    SceneSurfaces(gpu::Device& device, const Scene& scene, const GpuScene& onDevice, uint32_t textureSize,
                  const std::function<void(const std::string&)>& warn);

    /// Instances to where the draws of `onDevice` are. No frame that traces may be in flight.
    void pose(gpu::Device& device, const Scene& scene, const GpuScene& onDevice);

    /// States what scene_surfaces.glsl reads.
    gpu::Pass& bind(gpu::Pass& pass) const;

private:
    gpu::BufferView attributes_;
    gpu::BufferView indices_;
    gpu::Buffer instances_;
    gpu::Buffer materials_;
    gpu::Texture colors_;
    gpu::Texture data_;
    VkSampler sampler_ = VK_NULL_HANDLE;
};

}  // namespace reflet
