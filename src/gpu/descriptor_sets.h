// Descriptor sets, cached by the resources that they bind.
#pragma once

#include "gpu/pass_record.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace reflet::gpu {

class Context;

class DescriptorSets {
public:
    explicit DescriptorSets(Context& context) : context_(context) {}
    /// The device must have finished all frames.
    ~DescriptorSets();
    DescriptorSets(const DescriptorSets&) = delete;
    DescriptorSets& operator=(const DescriptorSets&) = delete;

    /// The set of a pass in this frame. uniforms: the buffer of its uniform blocks. finished: number of the last frame
    /// that the device has finished.
    VkDescriptorSet setOf(PassRecord& pass, const std::pair<VkBuffer, uint64_t>& uniforms, uint64_t frame,
                          uint64_t finished);

private:
    void writeKey(const PassRecord& pass, uint64_t uniformsId);
    static CachedSet& makeRoom(PassRecord& pass, VkDescriptorSetLayout layout, uint64_t finished);
    void allocate(CachedSet& entry, VkDescriptorSetLayout layout);
    void write(const PassRecord& pass, VkDescriptorSet set, VkBuffer uniforms);

    Context& context_;
    std::vector<VkDescriptorPool> pools_;
    std::vector<uint64_t> key_;  ///< cache key of the current pass
    // Scratch of write().
    std::vector<VkDescriptorImageInfo> images_;
    std::vector<VkDescriptorBufferInfo> buffers_;
    std::vector<VkWriteDescriptorSetAccelerationStructureKHR> structures_;
    std::vector<VkWriteDescriptorSet> writes_;
};

}  // namespace reflet::gpu
