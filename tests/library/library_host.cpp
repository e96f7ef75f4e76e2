// Host of the library's tests.
#include "library/library_host.h"

#include "base/math.h"

#include <volk.h>

#include <atomic>
#include <cstring>

namespace reflet::test {

namespace {

// ---- what the library makes on the device --------------------------------------------------------------------------

// Several threads may look them up.
std::atomic<PFN_vkCreateComputePipelines> realPipelines = nullptr;
std::atomic<PFN_vkAllocateMemory> realAllocate = nullptr;
std::atomic<PFN_vkCreateImage> realImage = nullptr;
std::atomic<PFN_vkCreateDescriptorPool> realPool = nullptr;
std::atomic<PFN_vkGetDeviceProcAddr> realLookUp = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL notePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                             const VkComputePipelineCreateInfo* infos,
                                             const VkAllocationCallbacks* host, VkPipeline* pipelines) {
    std::atomic_ref(LibraryHost::made().pipelines) += count;
    return realPipelines.load()(device, cache, count, infos, host, pipelines);
}

VKAPI_ATTR VkResult VKAPI_CALL noteAllocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                            const VkAllocationCallbacks* host, VkDeviceMemory* memory) {
    ++std::atomic_ref(LibraryHost::made().allocations);
    return realAllocate.load()(device, info, host, memory);
}

VKAPI_ATTR VkResult VKAPI_CALL noteImage(VkDevice device, const VkImageCreateInfo* info,
                                         const VkAllocationCallbacks* host, VkImage* image) {
    ++std::atomic_ref(LibraryHost::made().images);
    return realImage.load()(device, info, host, image);
}

VKAPI_ATTR VkResult VKAPI_CALL notePool(VkDevice device, const VkDescriptorPoolCreateInfo* info,
                                        const VkAllocationCallbacks* host, VkDescriptorPool* pool) {
    ++std::atomic_ref(LibraryHost::made().pools);
    return realPool.load()(device, info, host, pool);
}

template <class F>
PFN_vkVoidFunction wrap(std::atomic<F>& real, F wrapper, PFN_vkVoidFunction found) {
    real = reinterpret_cast<F>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(wrapper);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL lookUpOnDevice(VkDevice device, const char* name) {
    const PFN_vkVoidFunction found = realLookUp.load()(device, name);
    const std::string_view wanted(name);
    if (wanted == "vkCreateComputePipelines") {
        return wrap<PFN_vkCreateComputePipelines>(realPipelines, notePipelines, found);
    }
    if (wanted == "vkAllocateMemory") {
        return wrap<PFN_vkAllocateMemory>(realAllocate, noteAllocate, found);
    }
    if (wanted == "vkCreateImage") {
        return wrap<PFN_vkCreateImage>(realImage, noteImage, found);
    }
    if (wanted == "vkCreateDescriptorPool") {
        return wrap<PFN_vkCreateDescriptorPool>(realPool, notePool, found);
    }
    return found;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL lookUp(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction found = vkGetInstanceProcAddr(instance, name);
    if (std::string_view(name) == "vkGetDeviceProcAddr") {
        return wrap<PFN_vkGetDeviceProcAddr>(realLookUp, lookUpOnDevice, found);
    }
    return found;
}

// ---- the host's own images
// -------------------------------------------------------------------------------------------

uint32_t memoryType(VkPhysicalDevice physical, uint32_t allowed, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties known;
    vkGetPhysicalDeviceMemoryProperties(physical, &known);
    uint32_t i = 0;
    while (i + 1 < known.memoryTypeCount &&
           ((allowed >> i & 1U) == 0 || (known.memoryTypes[i].propertyFlags & wanted) != wanted)) {
        ++i;
    }
    return i;
}

void move(VkCommandBuffer commands, const RefletImage& image, VkImageLayout from, VkImageLayout to,
          VkPipelineStageFlags2 stages, VkAccessFlags2 access, VkPipelineStageFlags2 next, VkAccessFlags2 nextAccess,
          uint32_t firstLayer = 0, uint32_t layers = VK_REMAINING_ARRAY_LAYERS) {
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = stages;
    barrier.srcAccessMask = access;
    barrier.dstStageMask = next;
    barrier.dstAccessMask = nextAccess;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.image = image.image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, firstLayer, layers};
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace

void waitFor(VkCommandBuffer commands, const RefletBuffer& buffer, VkPipelineStageFlags2 stages,
             VkAccessFlags2 access) {
    VkBufferMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2};
    barrier.srcStageMask = buffer.stages;
    barrier.srcAccessMask = buffer.access;
    barrier.dstStageMask = stages;
    barrier.dstAccessMask = access;
    barrier.buffer = buffer.buffer;
    barrier.offset = buffer.offset;
    barrier.size = buffer.size;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.bufferMemoryBarrierCount = 1;
    info.pBufferMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

HostBuffer::HostBuffer(const gpu::OpenDevice& open, size_t bytes, VkBufferUsageFlags usage) : device_(open.device) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes;
    info.usage = usage;
    vkCreateBuffer(device_, &info, nullptr, &buffer);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device_, buffer, &needs);
    const VkMemoryAllocateInfo allocate{
        VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
        memoryType(open.physical, needs.memoryTypeBits,
                   VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
    vkAllocateMemory(device_, &allocate, nullptr, &memory_);
    vkBindBufferMemory(device_, buffer, memory_, 0);
    vkMapMemory(device_, memory_, 0, VK_WHOLE_SIZE, 0, &mapped);
}

HostBuffer::~HostBuffer() {
    vkDestroyBuffer(device_, buffer, nullptr);
    vkFreeMemory(device_, memory_, nullptr);
}

LibraryHost::Made& LibraryHost::made() {
    static Made all;
    return all;
}

LibraryHost::LibraryHost() {
    v13_ = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    v13_.synchronization2 = VK_TRUE;
    v12_ = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v13_};
    v12_.scalarBlockLayout = VK_TRUE;
    features_ = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v12_};
    features_.features.shaderStorageImageExtendedFormats = VK_TRUE;
    features_.features.imageCubeArray = VK_TRUE;
    features_.features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
    volkLoadInstance(host.device().instance);
    made() = {};
}

LibraryHost::~LibraryHost() {
    host.waitForAll();
    for (const VkImageView view : layerViews_) {
        vkDestroyImageView(host.device().device, view, nullptr);
    }
    for (const HostImage& image : images_) {
        vkDestroyImageView(host.device().device, image.view, nullptr);
        vkDestroyImage(host.device().device, image.image, nullptr);
        vkFreeMemory(host.device().device, image.memory, nullptr);
    }
}

RefletContextInfo LibraryHost::contextInfo() const {
    const gpu::OpenDevice open = host.device();
    RefletContextInfo info{};
    info.structSize = sizeof info;
    info.version = REFLET_VERSION;
    info.instance = open.instance;
    info.physicalDevice = open.physical;
    info.device = open.device;
    info.getInstanceProcAddr = lookUp;
    info.enabledFeatures = &features_;
    return info;
}

RefletContext LibraryHost::makeContext() const {
    const RefletContextInfo info = contextInfo();
    RefletContext context = nullptr;
    EXPECT_REFLET(refletCreateContext(&info, &context));
    return context;
}

RefletImage LibraryHost::makeImage(VkFormat format, uint32_t width, uint32_t height, const void* texels, size_t bytes,
                                   uint32_t layers, VkImageUsageFlags more) {
    const gpu::OpenDevice open = host.device();
    HostImage made;
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.flags = layers == 6 && width == height ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {width, height, 1};
    info.mipLevels = 1;
    info.arrayLayers = layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    info.usage |= more;
    vkCreateImage(open.device, &info, nullptr, &made.image);
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(open.device, made.image, &needs);
    const VkMemoryAllocateInfo allocate{
        VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
        memoryType(open.physical, needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    vkAllocateMemory(open.device, &allocate, nullptr, &made.memory);
    vkBindImageMemory(open.device, made.image, made.memory, 0);
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = made.image;
    view.viewType = layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, layers};
    vkCreateImageView(open.device, &view, nullptr, &made.view);
    made.told = {made.image, made.view, format, width, height, VK_IMAGE_LAYOUT_GENERAL, 0, 0};
    const HostBuffer staging(open, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(staging.mapped, texels, bytes);
    host.frame([&](VkCommandBuffer commands) {
        move(commands, made.told, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0, 0,
             VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, layers};
        copy.imageExtent = {width, height, 1};
        vkCmdCopyBufferToImage(commands, staging.buffer, made.image, VK_IMAGE_LAYOUT_GENERAL, 1, &copy);
        move(commands, made.told, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COPY_BIT,
             VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
             VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
    });
    host.waitForAll();
    images_.push_back(made);
    return made.told;
}

RefletImage LibraryHost::makeCube(VkFormat format, uint32_t side, const void* faces, size_t bytes) {
    RefletImage cube = makeImage(format, side, side, faces, bytes, 6);
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = cube.image;
    info.viewType = VK_IMAGE_VIEW_TYPE_CUBE;
    info.format = format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 6};
    vkCreateImageView(host.device().device, &info, nullptr, &cube.view);
    layerViews_.push_back(cube.view);
    return cube;
}

VkImageView LibraryHost::layerView(const RefletImage& image, uint32_t layer) {
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = image.image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = image.format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, layer, 1};
    VkImageView view = VK_NULL_HANDLE;
    vkCreateImageView(host.device().device, &info, nullptr, &view);
    return layerViews_.emplace_back(view);
}

void LibraryHost::setLayout(const RefletImage& image, uint32_t layer, VkImageLayout from, VkImageLayout to) {
    host.frame([&](VkCommandBuffer commands) {
        move(commands, image, from, to, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
             VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT, layer,
             1);
    });
    host.waitForAll();
}

std::vector<vec4> LibraryHost::texelsOfInput(const RefletImage& image) {
    const std::vector<std::byte> bytes = read(image, sizeof(vec4));
    std::vector<vec4> texels(bytes.size() / sizeof(vec4));
    std::memcpy(texels.data(), bytes.data(), bytes.size());
    return texels;
}

std::vector<std::byte> LibraryHost::read(const RefletImage& image, size_t bytesPerTexel) {
    const size_t bytes = bytesPerTexel * image.width * image.height;
    const HostBuffer staging(host.device(), bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    host.frame([&](VkCommandBuffer commands) {
        move(commands, image, image.layout, VK_IMAGE_LAYOUT_GENERAL, image.stages, image.access,
             VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {image.width, image.height, 1};
        vkCmdCopyImageToBuffer(commands, image.image, VK_IMAGE_LAYOUT_GENERAL, staging.buffer, 1, &copy);
        VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
        VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.memoryBarrierCount = 1;
        info.pMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(commands, &info);
    });
    host.waitForAll();
    const auto* from = static_cast<const std::byte*>(staging.mapped);
    return {from, from + bytes};
}

}  // namespace reflet::test
