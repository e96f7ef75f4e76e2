// Surface data for ray hits: vertex attributes, instances, materials, textures as layers of two arrays (colours and
// data). Passes bind it along with SceneRays; scene_surfaces.glsl reads it.
#pragma once

#include "gpu/resource.h"
#include "renderer/gpu_scene.h"
#include "renderer/trace_scene/scene_materials.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace reflet::gpu {
class Device;
class ComputePass;
}  // namespace reflet::gpu

namespace reflet {

class SceneSurfaces {
public:
    /// textureSize: maximum side of a layer in texels; larger images are downsampled, with a message to `warn`.
    /// Uses the vertices of `onDevice`, which must be of the same scene and outlive this.
    SceneSurfaces(gpu::Device& device, const Scene& scene, const GpuScene& onDevice, uint32_t textureSize,
                  const std::function<void(const std::string&)>& warn);

    /// Updates the instances to the transforms of the draws of `onDevice`, and the materials. No frame that traces may
    /// be in flight.
    void pose(gpu::Device& device, const Scene& scene, const GpuScene& onDevice, const ScenePose& now);

    /// Binds the resources of scene_surfaces.glsl.
    gpu::ComputePass& bind(gpu::ComputePass& pass) const;

private:
    gpu::BufferView attributes_;
    gpu::BufferView indices_;
    gpu::Buffer instances_;
    gpu::Buffer materials_;
    std::vector<SceneMaterial> posedMaterials_;  ///< if materials are animated
    gpu::Texture colors_;
    gpu::Texture data_;
    VkSampler sampler_ = VK_NULL_HANDLE;
};

}  // namespace reflet
