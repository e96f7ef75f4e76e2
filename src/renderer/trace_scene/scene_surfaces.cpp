// Uploads the surface data for ray hits.
#include "renderer/trace_scene/scene_surfaces.h"

#include "base/error.h"
#include "device/device.h"
#include "device/texture_array.h"
#include "device/upload.h"
#include "gpu/pass.h"
#include "renderer/trace_scene/scene_materials.h"

#include <algorithm>
#include <map>
#include <vector>

namespace reflet {

namespace {

uint32_t wrapOf(Wrap wrap) {
    return wrap == Wrap::mirror ? wrapMirror : wrap == Wrap::clamp ? wrapClamp : wrapRepeat;
}

// The images of one kind (colour or data) used by materials, and their layers.
class Layers {
public:
    Layers(const Scene& scene, bool srgb) : srgb_(srgb) {
        for (const Material& material : scene.materials) {
            const auto slots = textureSlots(material);
            for (uint32_t i = 0; i < sceneSlotCount; ++i) {
                if (slots[i]->image >= 0 && isSrgb(i) == srgb) {
                    layers_.try_emplace(slots[i]->image, static_cast<uint32_t>(layers_.size()));
                }
            }
        }
        images_.resize(layers_.size());
        for (const auto& [image, layer] : layers_) {
            const TextureImage& source = scene.images.at(static_cast<size_t>(image));
            images_[layer] = {{source.width, source.height}, source.rgba, source.name};
            size_ = max(size_, images_[layer].size);
        }
    }

    gpu::Texture upload(gpu::Device& device, uint32_t largest, const std::function<void(const std::string&)>& warn) {
        const uint32_t most = device.limits().maxImageArrayLayers;
        if (images_.size() > most) {
            warn(fmt::format(
                "the scene has {} textures of one kind, but only {} are used at ray hits, the others left out",
                images_.size(), most));
            images_.resize(most);
        }
        const auto shrunk = std::ranges::count_if(
            images_, [&](const auto& image) { return image.size.x > largest || image.size.y > largest; });
        if (shrunk > 0) {
            warn(
                fmt::format("{} of the scene's textures are shrunk to {} texels for ray hits: trace_scene.texture_size "
                            "is the limit",
                            shrunk, largest));
        }
        size_ = min(size_, uvec2(largest));
        constexpr uint8_t white[] = {255, 255, 255, 255};
        if (images_.empty()) {
            images_.push_back({uvec2(1), white, "no texture"});
            size_ = uvec2(1);
        }
        return gpu::uploadTextureArray(device, size_, images_, srgb_, srgb_ ? "scene colours" : "scene data");
    }

    /// False if the slot has no image.
    [[nodiscard]] bool find(const Scene& scene, const TextureSlot& slot, SceneTexture& texture) const {
        const auto found = layers_.find(slot.image);
        if (found == layers_.end() || found->second >= images_.size()) {
            return false;
        }
        const Sampler sampler = slot.sampler < 0 ? Sampler{} : scene.samplers.at(static_cast<size_t>(slot.sampler));
        texture.layer = found->second;
        texture.wrapU = wrapOf(sampler.wrapU);
        texture.wrapV = wrapOf(sampler.wrapV);
        texture.nearest = sampler.magLinear ? 0U : 1U;
        texture.mips = sampler.mips ? 1U : 0U;
        texture.size = images_[found->second].size;
        texture.firstLevel = static_cast<float>(gpu::layerLevel(size_, images_[found->second].size));
        return true;
    }

private:
    bool srgb_;
    std::map<int32_t, uint32_t> layers_;  ///< by image
    std::vector<gpu::LayerImage> images_;
    uvec2 size_{1};
};

// There is one draw per instance, in the same order.
std::vector<SceneInstance> sceneInstances(const Scene& scene, const DrawList& draws) {
    std::vector<SceneInstance> instances;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const mat3 m(draws.draws[i].objectToWorld);
        instances.push_back({.axisX = m[0],
                             .material = scene.meshes.at(scene.instances[i].mesh).material,
                             .axisY = m[1],
                             .firstVertex = static_cast<uint32_t>(draws.draws[i].firstVertex),
                             .axisZ = m[2],
                             .unused = 0});
    }
    return instances;
}

}  // namespace

SceneSurfaces::SceneSurfaces(gpu::Device& device, const Scene& scene, const GpuScene& onDevice, uint32_t textureSize,
                             const std::function<void(const std::string&)>& warn)
    : attributes_(onDevice.attributes()),
      indices_(onDevice.indices()),
      instances_(gpu::uploadVector(device, sceneInstances(scene, onDevice.draws()), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                   "scene instances")) {
    Layers colors(scene, true);
    Layers data(scene, false);
    colors_ = colors.upload(device, textureSize, warn);
    data_ = data.upload(device, textureSize, warn);
    std::vector<SceneMaterial> materials;
    for (const Material& material : scene.materials) {
        SceneMaterial m{onDevice.paramsOf(material, static_cast<uint32_t>(materials.size())), {}};
        const auto slots = textureSlots(material);
        for (uint32_t i = 0; i < sceneSlotCount; ++i) {
            if (!(isSrgb(i) ? colors : data).find(scene, *slots[i], m.textures[i])) {
                m.params.textured &= ~(1U << i);
            }
        }
        materials.push_back(m);
    }
    materials_ = gpu::uploadVector(device, materials, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "scene materials");
    if (hasAnimatedMaterials(scene)) {
        posedMaterials_ = std::move(materials);
    }
    sampler_ = device.sampler({.mag = VK_FILTER_LINEAR,
                               .min = VK_FILTER_LINEAR,
                               .mip = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                               .u = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                               .v = VK_SAMPLER_ADDRESS_MODE_REPEAT});
}

void SceneSurfaces::pose(gpu::Device& device, const Scene& scene, const GpuScene& onDevice, const ScenePose& now) {
    instances_ = gpu::uploadVector(device, sceneInstances(scene, onDevice.draws()), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                   "scene instances");
    if (!posedMaterials_.empty()) {
        for (const auto& [index, material] : now.properties.materials) {
            MaterialParams& params = posedMaterials_[index].params;
            const uint32_t textured = params.textured;
            params = onDevice.paramsOf(material, index);
            params.textured = textured;
        }
        materials_ = gpu::uploadVector(device, posedMaterials_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "scene materials");
    }
}

gpu::ComputePass& SceneSurfaces::bind(gpu::ComputePass& pass) const {
    return pass.read("sceneVertices", attributes_)
        .read("sceneIndices", indices_)
        .read("sceneInstances", instances_.view())
        .read("sceneMaterials", materials_.view())
        .read("sceneColors", colors_.image(), sampler_)
        .read("sceneData", data_.image(), sampler_);
}

}  // namespace reflet
