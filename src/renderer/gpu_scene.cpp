// Uploads a scene.
#include "renderer/gpu_scene.h"

#include "base/error.h"
#include "device/device.h"
#include "device/upload.h"
#include "renderer/live/live_picture.h"
#include "renderer/material.h"
#include "scene/mesh_levels.h"
#include "scene/mesh_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numeric>

namespace reflet {

namespace {

// Binding 0: MaterialParams; the others: the slots' textures.
VkDescriptorSetLayout materialLayout(gpu::Device& device) {
    std::vector<VkDescriptorType> bindings(1 + slotCount, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    bindings.front() = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    return device.setLayout(bindings);
}

VkDescriptorPool makeMaterialPool(gpu::Device& device, uint32_t materials) {
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, materials},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, materials * slotCount}};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = materials;
    info.poolSizeCount = static_cast<uint32_t>(std::size(sizes));
    info.pPoolSizes = sizes;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    gpu::vkCheck(device.vk.vkCreateDescriptorPool(device.handle(), &info, nullptr, &pool), "creating material sets");
    return pool;
}

VkSamplerAddressMode addressMode(Wrap wrap) {
    switch (wrap) {
        case Wrap::mirror:
            return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
        case Wrap::clamp:
            return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
        default:
            return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    }
}

gpu::SamplerInfo samplerInfo(const Sampler& s) {
    return {.mag = s.magLinear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
            .min = s.minLinear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
            .mip = s.mipLinear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
            .u = addressMode(s.wrapU),
            .v = addressMode(s.wrapV),
            .maxLod = s.mips ? VK_LOD_CLAMP_NONE : 0.0F};
}

// The material shows the live image of its camera.
void showLive(MaterialParams& params) {
    params.emissive = vec3(1.0F);
    params.preExposed = 1.0F;
    params.textured |= 1U << slotEmissive;
}

}  // namespace

LampParams lampParams(const Lamp& lamp) {
    LampParams p{};
    p.position = lamp.position;
    p.type = lamp.type == Lamp::Type::point ? lampPoint : lamp.type == Lamp::Type::spot ? lampSpot : lampDirectional;
    p.toLamp = -lamp.direction;
    p.inverseRange = lamp.range > 0.0F ? 1.0F / lamp.range : 0.0F;
    p.intensity = lamp.intensity;
    const float inner = std::cos(lamp.innerAngle);
    const float outer = std::cos(lamp.outerAngle);
    p.spotScale = 1.0F / std::max(inner - outer, 1e-4F);
    p.spotOffset = -outer * p.spotScale;
    p.cosOuter = outer;
    p.radius = lamp.radius;
    p.shadow = noLampShadow;
    return p;
}

GpuScene::GpuScene(gpu::Device& device, const Scene& scene, const std::function<void(const std::string&)>& warn)
    : GpuScene(device) {  // so that the destructor runs if something fails below
    materialLayout_ = materialLayout(device);
    uploadMeshes(scene);
    addLamps(scene, warn);
    emitters_.emplace(scene, lamps_.count);
    uploadMaterials(scene, warn);
    addDraws(scene);
}

GpuScene::~GpuScene() {
    device_.retire([device = &device_, pool = materialPool_] {
        device->vk.vkDestroyDescriptorPool(device->handle(), pool, nullptr);
    });
}

void GpuScene::uploadMeshes(const Scene& scene) {
    std::vector<vec3> positions;
    std::vector<VertexAttributes> attributes;
    std::vector<uint32_t> indices;
    for (const Mesh& mesh : scene.meshes) {
        ranges_.push_back({static_cast<uint32_t>(indices.size()), static_cast<int32_t>(positions.size())});
        positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
        attributes.insert(attributes.end(), mesh.attributes.begin(), mesh.attributes.end());
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    addLevels(scene, indices);
    addSkinned(scene, positions, attributes);
    constexpr VkBufferUsageFlags forRays = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const VkBufferUsageFlags forSkins = skinned_.empty() ? 0U : forRays;
    positions_ = gpu::uploadVector(device_, positions, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | forSkins, "positions");
    if (!skinned_.empty()) {
        previousPositions_ =
            gpu::uploadVector(device_, positions, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | forSkins, "previous positions");
    }
    attributes_ = gpu::uploadVector(device_, attributes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | forRays, "attributes");
    indices_ = gpu::uploadVector(device_, indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT | forRays, "indices");
}

// Their indices come after those of all meshes.
void GpuScene::addLevels(const Scene& scene, std::vector<uint32_t>& indices) {
    for (const std::vector<MeshLevel>& made : meshLevels(scene)) {
        std::vector<DrawLevel>& levels = levels_.emplace_back();
        for (const MeshLevel& level : made) {
            levels.push_back({static_cast<uint32_t>(indices.size()), static_cast<uint32_t>(level.indices.size()),
                              level.error, level.edge});
            indices.insert(indices.end(), level.indices.begin(), level.indices.end());
        }
    }
}

gpu::Image GpuScene::texture(const Scene& scene, int32_t image, bool srgb) {
    gpu::Texture& texture = textures_[{image, srgb}];
    if (texture.info().format == VK_FORMAT_UNDEFINED) {
        if (image < 0) {  // an empty slot binds one white texel that the shader never reads
            constexpr std::array<uint8_t, 4> white{255, 255, 255, 255};
            texture = gpu::uploadTexture(device_, uvec2(1), white, srgb, false, "white");
        } else {
            const TextureImage& source = scene.images.at(static_cast<size_t>(image));
            texture = gpu::uploadTexture(device_, {source.width, source.height}, source.rgba, srgb, true, source.name);
        }
    }
    return texture.image();
}

void GpuScene::bindMaterial(const Scene& scene, const Material& material, MaterialBinding& binding) {
    const auto slots = textureSlots(material);
    for (uint32_t i = 0; i < slotCount; ++i) {
        const TextureSlot& slot = *slots[i];
        binding.samplers[i] =
            samplerInfo(slot.sampler < 0 ? Sampler{} : scene.samplers.at(static_cast<size_t>(slot.sampler)));
        binding.views[i] = texture(scene, slot.image, isSrgb(i)).view();
    }
}

void GpuScene::writeMaterialSet(const MaterialBinding& binding) {
    const VkDescriptorBufferInfo block{materials_.handle(), binding.offset, sizeof(MaterialParams)};
    std::array<VkDescriptorImageInfo, slotCount> images{};
    std::array<VkWriteDescriptorSet, 1 + slotCount> writes{};
    for (uint32_t i = 0; i < writes.size(); ++i) {
        writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        writes[i].dstSet = binding.set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType =
            i == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        writes[i].pBufferInfo = &block;
        if (i > 0) {
            gpu::SamplerInfo info = binding.samplers[i - 1];
            const bool live = binding.live && i - 1 == slotEmissive;
            info.lodBias = filter_.mipBias;
            info.maxLod = filter_.mips ? info.maxLod : 0.0F;
            // Without a coarser level Mesa's CPU driver looks up all texels below a pixel.
            const bool hasMips = info.maxLod > 0.0F && !live;
            info.anisotropy = hasMips ? static_cast<float>(filter_.anisotropy) : 1.0F;
            images[i - 1] = {device_.sampler(info), binding.views[i - 1],
                             live ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
            writes[i].pImageInfo = &images[i - 1];
        }
    }
    device_.vk.vkUpdateDescriptorSets(device_.handle(), static_cast<uint32_t>(writes.size()), writes.data(), 0,
                                      nullptr);
}

void GpuScene::setTextureFilter(const TextureFilter& filter) {
    if (filter != filter_) {
        filter_ = filter;
        ++draws_.version;  // alpha cut-outs may have changed
        for (const MaterialBinding& binding : materialBindings_) {
            writeMaterialSet(binding);
        }
    }
}

MaterialParams GpuScene::paramsOf(const Material& material, uint32_t index) const {
    MaterialParams params = materialParams(material);
    params.glass = params.transmission > 0.0F ? glassKind(material, index + 1) : 0;
    params.emitter = emitters_->standFor(index) ? 1U : 0U;
    return params;
}

void GpuScene::poseMaterial(const Material& material, uint32_t index) {
    const MaterialBinding& binding = materialBindings_.at(index);
    MaterialParams params = paramsOf(material, index);
    if (binding.live) {
        showLive(params);
    }
    std::memcpy(materials_.bytes().data() + binding.offset, &params, sizeof(params));
}

void GpuScene::uploadMaterials(const Scene& scene, const std::function<void(const std::string&)>& warn) {
    const auto count = static_cast<uint32_t>(scene.materials.size());
    materialPool_ = makeMaterialPool(device_, std::max(count, 1U));
    const VkDeviceSize alignment = std::max<VkDeviceSize>(device_.limits().minUniformBufferOffsetAlignment, 4);
    const VkDeviceSize stride = (sizeof(MaterialParams) + alignment - 1) / alignment * alignment;
    std::vector<std::optional<size_t>> live(count);
    std::vector<std::byte> blocks(std::max<size_t>(count, 1) * stride);
    for (uint32_t i = 0; i < count; ++i) {
        MaterialParams params = paramsOf(scene.materials[i], i);
        live[i] = livePictureOf(scene, scene.materials[i], warn);
        if (live[i]) {
            showLive(params);
        }
        draws_.textureSlots |= params.textured;
        draws_.materialFeatures |= materialFeatures(scene.materials[i]);
        std::memcpy(blocks.data() + i * stride, &params, sizeof(params));
    }
    if (hasAnimatedMaterials(scene)) {
        materials_ = gpu::Buffer(device_, blocks.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, gpu::MemoryUse::upload,
                                 "materials");
        std::ranges::copy(blocks, materials_.bytes().begin());
    } else {
        materials_ = gpu::uploadBuffer(device_, blocks, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "materials");
    }
    if (count == 0) {
        return;
    }
    const std::vector<VkDescriptorSetLayout> layouts(count, materialLayout_);
    std::vector<VkDescriptorSet> sets(count);
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = materialPool_;
    info.descriptorSetCount = count;
    info.pSetLayouts = layouts.data();
    gpu::vkCheck(device_.vk.vkAllocateDescriptorSets(device_.handle(), &info, sets.data()), "allocating material sets");
    for (uint32_t i = 0; i < count; ++i) {
        MaterialBinding& binding =
            materialBindings_.emplace_back(MaterialBinding{sets[i], i * stride, {}, {}, live[i]});
        bindMaterial(scene, scene.materials[i], binding);
        writeMaterialSet(binding);
    }
    setLiveHeight(LiveSettings{}.height);
}

void GpuScene::addLamps(const Scene& scene, const std::function<void(const std::string&)>& warn) {
    lampSources_.resize(scene.lamps.size());
    std::iota(lampSources_.begin(), lampSources_.end(), size_t(0));
    if (lampSources_.size() > maxLamps) {
        warn(fmt::format("the scene has {} lamps, but only the strongest {} are used", lampSources_.size(), maxLamps));
        const auto strength = [&](size_t i) {
            const vec3& intensity = scene.lamps[i].intensity;
            return std::max({intensity.x, intensity.y, intensity.z});
        };
        std::ranges::stable_sort(lampSources_, std::greater<>(), strength);
        lampSources_.resize(maxLamps);
    }
    lamps_.count = static_cast<uint32_t>(lampSources_.size());
    std::ranges::transform(lampSources_, lamps_.lamps, [&](size_t i) { return lampParams(scene.lamps[i]); });
}

LampBlock GpuScene::lamps(bool emitters) const {
    LampBlock block = lamps_;
    if (emitters) {
        emitters_->appendTo(block);
    }
    return block;
}

void GpuScene::addDraws(const Scene& scene) {
    draws_.positions = positions_.handle();
    draws_.previousPositions = skinned_.empty() ? VK_NULL_HANDLE : previousPositions_.handle();
    draws_.attributes = attributes_.handle();
    draws_.indices = indices_.handle();
    draws_.materialLayout = materialLayout_;
    draws_.unlit = isUnlit(scene);
    std::ranges::transform(scene.meshes, std::back_inserter(pieces_), meshPieces);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        const Material& material = scene.materials.at(mesh.material);
        Draw draw;
        draw.firstIndex = ranges_[instance.mesh].firstIndex;
        draw.indexCount = static_cast<uint32_t>(mesh.indices.size());
        draw.firstVertex = ranges_[instance.mesh].firstVertex;
        draw.objectToWorld = instance.objectToWorld;
        draw.previousObjectToWorld = instance.objectToWorld;
        draw.boundsW = transformed(mesh.bounds, instance.objectToWorld);
        if (!isDeformed(instance)) {
            draw.pieces = pieces_[instance.mesh];
            draw.levels = levels_[instance.mesh];
        }
        draw.material = materialBindings_[mesh.material].set;
        draw.masked = material.alphaCutoff > 0.0F;
        draw.glass = material.transmission.factor > 0.0F;
        draw.blended = material.blended && !draw.glass;
        draws_.glass = draws_.glass || draw.glass;
        draws_.frosted = draws_.frosted || (draw.glass && material.roughness > 0.0F);
        const Transmission& glass = material.transmission;
        draws_.dispersive = draws_.dispersive || (draw.glass && glass.thickness > 0.0F && glass.dispersion > 0.0F);
        const bool murky = material.transmission.factor < 1.0F || material.transmission.texture.image >= 0;
        draws_.murky = draws_.murky || (draw.glass && murky);
        draw.coated = material.clearcoat.factor > 0.0F;
        draw.diffuseTransmission = material.diffuseTransmission.factor > 0.0F;
        draws_.diffuseTransmission = draws_.diffuseTransmission || draw.diffuseTransmission;
        draws_.coated = draws_.coated || draw.coated;
        draws_.coatedBlended = draws_.coatedBlended || (draw.coated && draw.blended);
        draws_.coatedGlass = draws_.coatedGlass || (draw.coated && draw.glass);
        draw.alpha = draw.blended ? material.baseColor.a : 1.0F;
        draw.doubleSided = material.doubleSided;
        draw.emitter = emitters_->standFor(mesh.material);
        draws_.boundsW.add(draw.boundsW);
        draws_.draws.push_back(draw);
    }
}

}  // namespace reflet
