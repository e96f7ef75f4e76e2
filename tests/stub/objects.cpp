// Pipelines, samplers, descriptors and queries of the driver without a device.
#include "stub/objects.h"

#include "stub/functions.h"

#include <algorithm>

namespace reflet::stub {

namespace {

std::atomic<bool> isLost = false;

// Objects that have nothing to tell. Create functions of Vulkan that have the usual parameters.
template <Kind K>
struct Plain : Object {
    Plain() : Object(K) {}
};

template <Kind K, class Pfn>
struct Creating;
template <Kind K, class Info, class Handle>
struct Creating<K, VkResult(VKAPI_PTR*)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*)> {
    static VKAPI_ATTR VkResult VKAPI_CALL call(VkDevice /*device*/, const Info* /*info*/,
                                               const VkAllocationCallbacks* /*host*/, Handle* handle) {
        return make<Plain<K>>(handle);
    }
};

VKAPI_ATTR VkResult VKAPI_CALL createCache(VkDevice /*device*/, const VkPipelineCacheCreateInfo* info,
                                           const VkAllocationCallbacks* /*host*/, VkPipelineCache* cache) {
    const auto* const bytes = static_cast<const unsigned char*>(info->pInitialData);
    static std::atomic<unsigned> sum = 0;  // all of it is read
    for (size_t i = 0; i < info->initialDataSize; ++i) {
        sum += bytes[i];
    }
    return make<Plain<Kind::pipelineCache>>(cache);
}

VKAPI_ATTR VkResult VKAPI_CALL cacheData(VkDevice /*device*/, VkPipelineCache cache, size_t* size, void* data) {
    constexpr size_t all = 32;
    (void)known<Plain<Kind::pipelineCache>>(cache, Kind::pipelineCache, "vkGetPipelineCacheData");
    if (data != nullptr) {
        std::fill_n(static_cast<unsigned char*>(data), std::min(*size, all), 7);
    }
    const VkResult result = data != nullptr && *size < all ? VK_INCOMPLETE : VK_SUCCESS;
    *size = data != nullptr ? std::min(*size, all) : all;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice /*device*/, VkPipelineCache /*cache*/, uint32_t count,
                                               const VkComputePipelineCreateInfo* infos,
                                               const VkAllocationCallbacks* /*host*/, VkPipeline* pipelines) {
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < count; ++i) {
        (void)known<Object>(infos[i].stage.module, Kind::shader, "vkCreateComputePipelines");
        (void)known<Object>(infos[i].layout, Kind::layout, "vkCreateComputePipelines");
        if (const VkResult one = make<Plain<Kind::pipeline>>(&pipelines[i]); one != VK_SUCCESS) {
            pipelines[i] = VK_NULL_HANDLE;  // by the specification
            result = one;
        }
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createPool(VkDevice /*device*/, const VkDescriptorPoolCreateInfo* info,
                                          const VkAllocationCallbacks* /*host*/, VkDescriptorPool* handle) {
    const VkResult result = make<Pool>(handle);
    if (result == VK_SUCCESS) {
        known<Pool>(*handle, Kind::pool, "vkCreateDescriptorPool").most = info->maxSets;
    }
    return result;
}

void dropSet(Set& set, const char* call) {
    checkUnused(set, call);
    drop(set);
}

VKAPI_ATTR void VKAPI_CALL destroyPool(VkDevice /*device*/, VkDescriptorPool handle,
                                       const VkAllocationCallbacks* /*host*/) {
    if (handle != VK_NULL_HANDLE) {
        auto& pool = known<Pool>(handle, Kind::pool, "vkDestroyDescriptorPool");
        for (Set* set : pool.sets) {
            dropSet(*set, "vkDestroyDescriptorPool");
        }
        drop(pool);
    }
}

VKAPI_ATTR VkResult VKAPI_CALL allocateSets(VkDevice /*device*/, const VkDescriptorSetAllocateInfo* info,
                                            VkDescriptorSet* sets) {
    auto& pool = known<Pool>(info->descriptorPool, Kind::pool, "vkAllocateDescriptorSets");
    std::fill_n(sets, info->descriptorSetCount, VkDescriptorSet{});
    if (pool.sets.size() + info->descriptorSetCount > pool.most) {
        return VK_ERROR_OUT_OF_POOL_MEMORY;
    }
    for (uint32_t i = 0; i < info->descriptorSetCount; ++i) {
        (void)known<Object>(info->pSetLayouts[i], Kind::setLayout, "vkAllocateDescriptorSets");
        if (const VkResult result = make<Set>(&sets[i]); result != VK_SUCCESS) {
            sets[i] = VK_NULL_HANDLE;
            return result;
        }
        auto& set = known<Set>(sets[i], Kind::set, "vkAllocateDescriptorSets");
        set.pool = &pool;
        pool.sets.push_back(&set);
    }
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL freeSets(VkDevice /*device*/, VkDescriptorPool handle, uint32_t count,
                                        const VkDescriptorSet* sets) {
    auto& pool = known<Pool>(handle, Kind::pool, "vkFreeDescriptorSets");
    for (uint32_t i = 0; i < count; ++i) {
        auto& set = known<Set>(sets[i], Kind::set, "vkFreeDescriptorSets");
        if (std::erase(pool.sets, &set) != 1) {
            misuse("a set of another pool", "vkFreeDescriptorSets");
        }
        dropSet(set, "vkFreeDescriptorSets");
    }
    return VK_SUCCESS;
}

void writeOne(Set& set, const VkWriteDescriptorSet& write) {
    constexpr const char* call = "vkUpdateDescriptorSets";
    Object* object = nullptr;
    switch (write.descriptorType) {
        case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
            (void)known<Object>(write.pImageInfo->sampler, Kind::sampler, call);
            [[fallthrough]];
        case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
            if (write.pImageInfo->imageView == VK_NULL_HANDLE) {
                misuse("an image view that is NULL", call);
            }
            if (isOwn(write.pImageInfo->imageView)) {
                object = &known<Object>(write.pImageInfo->imageView, Kind::imageView, call);
            }
            break;
        default:
            object = &known<Object>(write.pBufferInfo->buffer, Kind::buffer, call);
    }
    const auto place = std::ranges::find(set.bound, write.dstBinding, &std::pair<uint32_t, Object*>::first);
    if (place == set.bound.end()) {
        set.bound.emplace_back(write.dstBinding, object);
    } else {
        place->second = object;
    }
}

VKAPI_ATTR void VKAPI_CALL updateSets(VkDevice /*device*/, uint32_t count, const VkWriteDescriptorSet* writes,
                                      uint32_t /*copies*/, const VkCopyDescriptorSet* /*copied*/) {
    for (uint32_t i = 0; i < count; ++i) {
        auto& set = known<Set>(writes[i].dstSet, Kind::set, "vkUpdateDescriptorSets");
        checkUnused(set, "vkUpdateDescriptorSets");
        writeOne(set, writes[i]);
    }
}

VKAPI_ATTR VkResult VKAPI_CALL queryResults(VkDevice /*device*/, VkQueryPool pool, uint32_t /*first*/, uint32_t count,
                                            size_t bytes, void* data, VkDeviceSize stride,
                                            VkQueryResultFlags /*flags*/) {
    (void)known<Object>(pool, Kind::queryPool, "vkGetQueryPoolResults");
    if (isLost) {
        return VK_ERROR_DEVICE_LOST;
    }
    if (count * stride != bytes) {
        misuse("another size", "vkGetQueryPoolResults");
    }
    for (uint32_t i = 0; i < count; ++i) {
        static_cast<uint64_t*>(data)[i] = uint64_t{1000} * i;
    }
    return VK_SUCCESS;
}

}  // namespace

void lose(bool lost) {
    isLost = lost;
}

void addObjectFunctions(Functions& to) {
#define REFLET_PLAIN(kind, creating, destroying)                        \
    REFLET_STUB(creating, (Creating<Kind::kind, PFN_##creating>::call)) \
    REFLET_STUB(destroying, (Destroying<Plain<Kind::kind>, Kind::kind, PFN_##destroying>::call))
    REFLET_PLAIN(shader, vkCreateShaderModule, vkDestroyShaderModule)
    REFLET_PLAIN(setLayout, vkCreateDescriptorSetLayout, vkDestroyDescriptorSetLayout)
    REFLET_PLAIN(layout, vkCreatePipelineLayout, vkDestroyPipelineLayout)
    REFLET_PLAIN(sampler, vkCreateSampler, vkDestroySampler)
    REFLET_PLAIN(queryPool, vkCreateQueryPool, vkDestroyQueryPool)
#undef REFLET_PLAIN
    REFLET_STUB(vkCreatePipelineCache, createCache)
    REFLET_STUB(vkDestroyPipelineCache,
                (Destroying<Plain<Kind::pipelineCache>, Kind::pipelineCache, PFN_vkDestroyPipelineCache>::call))
    REFLET_STUB(vkGetPipelineCacheData, cacheData)
    REFLET_STUB(vkCreateComputePipelines, createPipelines)
    REFLET_STUB(vkDestroyPipeline, (Destroying<Plain<Kind::pipeline>, Kind::pipeline, PFN_vkDestroyPipeline>::call))
    REFLET_STUB(vkCreateDescriptorPool, createPool)
    REFLET_STUB(vkDestroyDescriptorPool, destroyPool)
    REFLET_STUB(vkAllocateDescriptorSets, allocateSets)
    REFLET_STUB(vkFreeDescriptorSets, freeSets)
    REFLET_STUB(vkUpdateDescriptorSets, updateSets)
    REFLET_STUB(vkGetQueryPoolResults, queryResults)
}

}  // namespace reflet::stub
