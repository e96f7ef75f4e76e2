// Finds or writes the descriptor set of a pass.
#include "gpu/descriptor_sets.h"

#include "gpu/context.h"
#include "gpu/vulkan.h"

#include <algorithm>

namespace reflet::gpu {

namespace {

constexpr uint32_t setsPerPool = 256;
// Of one pass and layout: histories swap every other frame, and each frame in flight has uniforms of its own.
constexpr size_t setsPerPass = 16;

VkDescriptorPool makePool(Context& context) {
    std::vector<VkDescriptorPoolSize> sizes{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 2 * setsPerPool},
                                            {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2 * setsPerPool},
                                            {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 4 * setsPerPool},
                                            {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8 * setsPerPool}};
    if (context.hasRayQuery()) {
        sizes.push_back({VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, setsPerPool});
    }
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = setsPerPool;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    ++context.counts().descriptorPools;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateDescriptorPool(context.handle(), &info, context.allocator(), &pool),
            "creating a descriptor pool");
    return pool;
}

}  // namespace

DescriptorSets::~DescriptorSets() {
    for (const VkDescriptorPool pool : pools_) {
        context_.vk.vkDestroyDescriptorPool(context_.handle(), pool, context_.allocator());
    }
}

// Empty if something has no identity: a host's image, and an acceleration structure, which is made anew as it grows.
void DescriptorSets::writeKey(const PassRecord& pass, uint64_t uniformsId) {
    key_.clear();
    key_.push_back(uniformsId);
    for (const Bound& bound : pass.bound) {
        const uint64_t id = bound.image ? bound.image.state->id : bound.buffer ? bound.buffer.state->id : 0;
        if (id == 0) {
            key_.clear();
            return;
        }
        key_.push_back(id);
        key_.push_back(bound.image ? static_cast<uint64_t>(bound.image.level + 1) : 0);
        key_.push_back(reinterpret_cast<uint64_t>(bound.sampler));
    }
    // Calls in another order bind the same values to other names.
    key_.insert(key_.end(), pass.slots.begin(), pass.slots.end());
}

VkDescriptorSet DescriptorSets::setOf(PassRecord& pass, const std::pair<VkBuffer, uint64_t>& uniforms, uint64_t frame,
                                      uint64_t finished) {
    const VkDescriptorSetLayout layout = pass.pipeline->set;
    writeKey(pass, uniforms.second);
    const auto known = std::ranges::find_if(pass.sets, [&](const CachedSet& s) {
        return !key_.empty() && s.key == key_ && s.layout == layout && s.pipelines == pass.pipelinesVersion;
    });
    if (known != pass.sets.end()) {
        known->lastUse = frame;
        return known->set;
    }
    CachedSet& entry = makeRoom(pass, layout, finished);
    if (entry.set == VK_NULL_HANDLE || entry.layout != layout || entry.pipelines != pass.pipelinesVersion) {
        allocate(entry, layout);
        entry.pipelines = pass.pipelinesVersion;
    }
    entry.key.clear();  // until it is written
    write(pass, entry.set, uniforms.first);
    entry.key = key_;
    entry.lastUse = frame;
    return entry.set;
}

// An entry that no unfinished frame uses: one without identity or of pipelines that are gone first, then the oldest
// once there are many. Of other layouts, which the pass has with other settings, nothing is taken: they come back.
CachedSet& DescriptorSets::makeRoom(PassRecord& pass, VkDescriptorSetLayout layout, uint64_t finished) {
    CachedSet* oldest = nullptr;
    size_t count = 0;
    for (CachedSet& entry : pass.sets) {
        const bool gone = entry.pipelines != pass.pipelinesVersion;
        if (entry.lastUse <= finished && (gone || (entry.layout == layout && entry.key.empty()))) {
            return entry;
        }
        if (!gone && entry.layout == layout) {
            ++count;
            oldest = oldest == nullptr || entry.lastUse < oldest->lastUse ? &entry : oldest;
        }
    }
    const bool takes = count >= setsPerPass && oldest->lastUse <= finished;
    return takes ? *oldest : pass.sets.emplace_back();
}

void DescriptorSets::allocate(CachedSet& entry, VkDescriptorSetLayout layout) {
    if (entry.set != VK_NULL_HANDLE) {
        context_.vk.vkFreeDescriptorSets(context_.handle(), entry.pool, 1, &entry.set);
        entry.set = VK_NULL_HANDLE;
    }
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    for (size_t i = 0; i <= pools_.size(); ++i) {
        // The newest first: the others are full, but for what was freed.
        const bool fresh = i == pools_.size();
        if (fresh) {
            pools_.reserve(pools_.size() + 1);
            pools_.push_back(makePool(context_));
        }
        info.descriptorPool = fresh ? pools_.back() : pools_[pools_.size() - 1 - i];
        const VkResult result = context_.vk.vkAllocateDescriptorSets(context_.handle(), &info, &entry.set);
        const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
        if (fresh || !full) {
            if (result != VK_SUCCESS) {
                entry.set = VK_NULL_HANDLE;
            }
            vkCheck(result, "allocating a descriptor set");
            entry.pool = info.descriptorPool;
            entry.layout = layout;
            return;
        }
    }
}

void DescriptorSets::write(const PassRecord& pass, VkDescriptorSet set, VkBuffer uniforms) {
    const std::vector<ShaderBinding>& bindings = pass.interface->bindings;
    images_.assign(bindings.size(), {});
    buffers_.assign(bindings.size(), {});
    structures_.assign(bindings.size(), {});
    writes_.clear();
    for (size_t i = 0; i < bindings.size(); ++i) {
        const ShaderBinding& binding = bindings[i];
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = set;
        write.dstBinding = binding.binding;
        write.descriptorCount = 1;
        write.descriptorType = binding.type;
        write.pImageInfo = &images_[i];
        write.pBufferInfo = &buffers_[i];
        if (binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) {
            write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
            buffers_[i] = {uniforms, 0, binding.blockSize};
        } else if (const Bound& bound = pass.bound[pass.boundOf[i]]; bound.image) {
            const VkSampler sampler = bound.sampler != VK_NULL_HANDLE ? bound.sampler : context_.sampler({});
            images_[i] = {sampler, bound.image.view(), bound.image.state->layout};
        } else if (bound.structure) {
            structures_[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR, nullptr, 1,
                              &bound.structure.structure};
            write.pNext = &structures_[i];
        } else {
            buffers_[i] = {bound.buffer.state->buffer, 0, VK_WHOLE_SIZE};
        }
        writes_.push_back(write);
    }
    context_.vk.vkUpdateDescriptorSets(context_.handle(), static_cast<uint32_t>(writes_.size()), writes_.data(), 0,
                                       nullptr);
}

}  // namespace reflet::gpu
