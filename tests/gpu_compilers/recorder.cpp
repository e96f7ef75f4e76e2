// Stands between the library and the driver, by the lookup function that the library is given.
#include "gpu_compilers/recorder.h"

#include "gpu/listing.h"
#include "gpu/resource.h"
#include "gpu/shader.h"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <string_view>
#include <utility>

#include <volk.h>

std::span<const reflet::gpu::Shader> effectShaders();
std::span<const reflet::gpu::Shader> rendererShaders();

namespace reflet::gpu_compilers {

namespace {

struct Descriptor {
    bool stored = false;
    VkImageView view = VK_NULL_HANDLE;
};

// Vulkan's functions take no pointer of ours, so that there is one of these for the process.
struct Record {
    std::mutex mutex;  // pipelines are made on several threads
    std::map<VkShaderModule, const gpu::Shader*> modules;
    std::map<std::string, Kernel> kernels;
    std::map<VkPipeline, std::string> pipelines;
    std::map<VkImage, BoundImage> images;
    std::map<VkImageView, VkImage> views;
    std::map<VkBuffer, VkDeviceSize> buffers;
    std::map<VkDeviceMemory, VkDeviceSize> sizes;
    std::map<VkDeviceMemory, std::vector<std::byte>> mapped;
    std::map<VkDescriptorSet, std::map<uint32_t, Descriptor>> sets;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    std::string label;
    uint64_t handles = 0;
    RecordedFrame frame;
};

Record& record() {
    static Record instance;
    return instance;
}

template <class F>
F real(VkDevice device, const char* name) {
    return reinterpret_cast<F>(vkGetDeviceProcAddr(device, name));
}

// ---- pipelines -----------------------------------------------------------------------------------------------------

VKAPI_ATTR VkResult VKAPI_CALL makeModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                          const VkAllocationCallbacks* host, VkShaderModule* module) {
    const VkResult result = real<PFN_vkCreateShaderModule>(device, "vkCreateShaderModule")(device, info, host, module);
    const std::scoped_lock lock(record().mutex);
    record().modules[*module] = nullptr;
    for (const auto shaders : {effectShaders(), rendererShaders()}) {
        const auto found = std::ranges::find_if(shaders, [&](const gpu::Shader& shader) {
            return shader.words.size_bytes() == info->codeSize &&
                   std::memcmp(shader.words.data(), info->pCode, info->codeSize) == 0;
        });
        if (found != shaders.end()) {
            record().modules[*module] = &*found;
        }
    }
    return result;
}

std::string nameOf(const gpu::Shader& shader, const VkSpecializationInfo* specialization) {
    std::string name(shader.name);
    for (uint32_t i = 0; specialization != nullptr && i < specialization->mapEntryCount; ++i) {
        const VkSpecializationMapEntry& entry = specialization->pMapEntries[i];
        uint32_t value = 0;
        std::memcpy(&value, static_cast<const std::byte*>(specialization->pData) + entry.offset, sizeof value);
        const auto constant = std::ranges::find(shader.constants, entry.constantID, &gpu::SpecializationConstant::id);
        name +=
            " " + std::string(constant == shader.constants.end() ? "?" : constant->name) + "=" + std::to_string(value);
    }
    return name;
}

std::string assemblyOf(VkDevice device, const VkPipelineExecutableInfoKHR& executable) {
    const auto get = real<PFN_vkGetPipelineExecutableInternalRepresentationsKHR>(
        device, "vkGetPipelineExecutableInternalRepresentationsKHR");
    uint32_t count = 0;
    get(device, &executable, &count, nullptr);
    std::vector<VkPipelineExecutableInternalRepresentationKHR> forms(
        count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR});
    get(device, &executable, &count, forms.data());
    std::vector<std::string> texts;
    for (VkPipelineExecutableInternalRepresentationKHR& form : forms) {
        form.pData = texts.emplace_back(form.dataSize, '\0').data();
    }
    get(device, &executable, &count, forms.data());
    for (size_t i = 0; i < forms.size(); ++i) {
        if (std::string_view(forms[i].name) == "Assembly") {
            return std::move(texts[i]);
        }
    }
    return {};
}

Kernel describe(VkDevice device, VkPipeline pipeline, const VkPipelineShaderStageCreateInfo& stage) {
    const gpu::Shader* shader = [&] {
        const std::scoped_lock lock(record().mutex);
        return record().modules.at(stage.module);
    }();
    Kernel kernel;
    kernel.name = shader == nullptr ? "?" : nameOf(*shader, stage.pSpecializationInfo);
    kernel.localSize = shader == nullptr ? glm::uvec3(1) : shader->localSize;
    const VkPipelineExecutableInfoKHR executable{VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR, nullptr, pipeline, 0};
    const auto get = real<PFN_vkGetPipelineExecutableStatisticsKHR>(device, "vkGetPipelineExecutableStatisticsKHR");
    uint32_t count = 0;
    get(device, &executable, &count, nullptr);
    std::vector<VkPipelineExecutableStatisticKHR> values(count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
    get(device, &executable, &count, values.data());
    for (const VkPipelineExecutableStatisticKHR& value : values) {
        kernel.statistics[value.name] = value.value.u64;
    }
    kernel.loops = loopsOf(assemblyOf(device, executable));
    return kernel;
}

VKAPI_ATTR VkResult VKAPI_CALL makePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                             const VkComputePipelineCreateInfo* infos,
                                             const VkAllocationCallbacks* host, VkPipeline* pipelines) {
    std::vector<VkComputePipelineCreateInfo> captured(infos, infos + count);
    for (VkComputePipelineCreateInfo& info : captured) {
        info.flags |=
            VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR | VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR;
    }
    const VkResult result = real<PFN_vkCreateComputePipelines>(device, "vkCreateComputePipelines")(
        device, cache, count, captured.data(), host, pipelines);
    for (uint32_t i = 0; i < count && result == VK_SUCCESS; ++i) {
        Kernel kernel = describe(device, pipelines[i], infos[i].stage);
        const std::scoped_lock lock(record().mutex);
        record().pipelines[pipelines[i]] = kernel.name;
        record().kernels[kernel.name] = std::move(kernel);
    }
    return result;
}

// ---- resources -----------------------------------------------------------------------------------------------------

// The null device has no memory, and what is bound to none cannot be viewed: all of that is faked. Handles count up.
template <class Handle>
Handle nextHandle() {
    return reinterpret_cast<Handle>(0x1000 + 16 * ++record().handles);  // NOLINT(performance-no-int-to-ptr)
}

template <class Info, class Handle>
VKAPI_ATTR VkResult VKAPI_CALL makeFaked(VkDevice /*device*/, const Info* /*info*/,
                                         const VkAllocationCallbacks* /*host*/, Handle* handle) {
    *handle = nextHandle<Handle>();
    return VK_SUCCESS;
}

template <class Handle>
VKAPI_ATTR void VKAPI_CALL destroyFaked(VkDevice /*device*/, Handle /*handle*/, const VkAllocationCallbacks* /*host*/) {
}

// Hosts have formats that the library never makes.
uint32_t texelBytes(VkFormat format) {
    return format == VK_FORMAT_R16G16_SNORM ? 4 : gpu::bytesPerTexel(format);
}

void noteImage(VkImage image, VkFormat format, glm::uvec3 size) {
    record().images[image] = {gpu::formatName(format), size, uint64_t{size.x} * size.y * size.z * texelBytes(format)};
}

VKAPI_ATTR VkResult VKAPI_CALL makeImage(VkDevice /*device*/, const VkImageCreateInfo* info,
                                         const VkAllocationCallbacks* /*host*/, VkImage* image) {
    *image = nextHandle<VkImage>();
    noteImage(*image, info->format, {info->extent.width, info->extent.height, info->arrayLayers});
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL makeView(VkDevice /*device*/, const VkImageViewCreateInfo* info,
                                        const VkAllocationCallbacks* /*host*/, VkImageView* view) {
    *view = nextHandle<VkImageView>();
    record().views[*view] = info->image;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL makeBuffer(VkDevice /*device*/, const VkBufferCreateInfo* info,
                                          const VkAllocationCallbacks* /*host*/, VkBuffer* buffer) {
    *buffer = nextHandle<VkBuffer>();
    record().buffers[*buffer] = info->size;
    return VK_SUCCESS;
}

constexpr VkDeviceSize alignment = 256;

VKAPI_ATTR void VKAPI_CALL bufferNeeds(VkDevice /*device*/, VkBuffer buffer, VkMemoryRequirements* needs) {
    *needs = {record().buffers[buffer], alignment, 1};
}

VKAPI_ATTR void VKAPI_CALL imageNeeds(VkDevice /*device*/, VkImage image, VkMemoryRequirements* needs) {
    *needs = {2 * record().images[image].bytes, alignment, 1};  // with mips
}

VKAPI_ATTR void VKAPI_CALL memoryTypes(VkPhysicalDevice /*device*/, VkPhysicalDeviceMemoryProperties* properties) {
    *properties = {};
    properties->memoryTypeCount = properties->memoryHeapCount = 1;
    properties->memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT |
                                               VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                               VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    properties->memoryHeaps[0] = {VkDeviceSize{64} << 30U, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
}

VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice /*device*/, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* /*host*/, VkDeviceMemory* memory) {
    *memory = nextHandle<VkDeviceMemory>();
    record().sizes[*memory] = info->allocationSize;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL freeMemory(VkDevice /*device*/, VkDeviceMemory memory,
                                      const VkAllocationCallbacks* /*host*/) {
    record().mapped.erase(memory);
}

VKAPI_ATTR VkResult VKAPI_CALL map(VkDevice /*device*/, VkDeviceMemory memory, VkDeviceSize offset,
                                   VkDeviceSize /*size*/, VkMemoryMapFlags /*flags*/, void** data) {
    std::vector<std::byte>& bytes = record().mapped[memory];
    bytes.resize(record().sizes[memory]);
    *data = bytes.data() + offset;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL makeSets(VkDevice /*device*/, const VkDescriptorSetAllocateInfo* info,
                                        VkDescriptorSet* sets) {
    std::generate_n(sets, info->descriptorSetCount, nextHandle<VkDescriptorSet>);
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL succeed() {
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL updateSets(VkDevice /*device*/, uint32_t count, const VkWriteDescriptorSet* writes,
                                      uint32_t /*copies*/, const VkCopyDescriptorSet* /*copied*/) {
    for (const VkWriteDescriptorSet& write : std::span(writes, count)) {
        if (write.pImageInfo != nullptr) {
            record().sets[write.dstSet][write.dstBinding] = {write.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                                                             write.pImageInfo->imageView};
        }
    }
}

VKAPI_ATTR VkResult VKAPI_CALL noQueryResults() {
    return VK_NOT_READY;
}

// ---- commands ------------------------------------------------------------------------------------------------------

VKAPI_ATTR void VKAPI_CALL noteNothing() {}

VKAPI_ATTR void VKAPI_CALL notePipeline(VkCommandBuffer /*commands*/, VkPipelineBindPoint /*point*/,
                                        VkPipeline pipeline) {
    record().pipeline = pipeline;
}

VKAPI_ATTR void VKAPI_CALL noteSet(VkCommandBuffer /*commands*/, VkPipelineBindPoint /*point*/,
                                   VkPipelineLayout /*layout*/, uint32_t /*first*/, uint32_t /*count*/,
                                   const VkDescriptorSet* sets, uint32_t /*offsets*/, const uint32_t* /*values*/) {
    record().set = *sets;
}

VKAPI_ATTR void VKAPI_CALL noteLabel(VkCommandBuffer /*commands*/, const VkDebugUtilsLabelEXT* label) {
    record().label = label->pLabelName;
}

VKAPI_ATTR void VKAPI_CALL noteDispatch(VkCommandBuffer /*commands*/, uint32_t x, uint32_t y, uint32_t z) {
    Record& r = record();
    RecordedPass& pass = r.frame.passes.emplace_back();
    pass.label = r.label;
    pass.kernel = r.pipelines.at(r.pipeline);
    pass.groups = {x, y, z};
    for (const auto& [binding, bound] : r.sets[r.set]) {
        const auto view = r.views.find(bound.view);
        if (view != r.views.end()) {
            BoundImage& image = pass.images.emplace_back(r.images[view->second]);
            image.stored = bound.stored;
        }
    }
}

VKAPI_ATTR void VKAPI_CALL noteIndirect(VkCommandBuffer commands, VkBuffer /*buffer*/, VkDeviceSize /*offset*/) {
    noteDispatch(commands, 0, 0, 0);
}

VKAPI_ATTR void VKAPI_CALL noteBarrier(VkCommandBuffer /*commands*/, const VkDependencyInfo* /*info*/) {
    ++record().frame.barriers;
}

VKAPI_ATTR void VKAPI_CALL noteClear(VkCommandBuffer /*commands*/, VkImage image, VkImageLayout /*layout*/,
                                     const VkClearColorValue* /*value*/, uint32_t /*count*/,
                                     const VkImageSubresourceRange* /*ranges*/) {
    record().frame.clearedBytes += record().images[image].bytes;
}

// ---- lookup --------------------------------------------------------------------------------------------------------

template <class F>
PFN_vkVoidFunction plain(F function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL lookUpOnDevice(VkDevice device, const char* name) {
    static const std::map<std::string_view, PFN_vkVoidFunction> ours{
        {"vkCreateShaderModule", plain(makeModule)},
        {"vkCreateComputePipelines", plain(makePipelines)},
        {"vkCreateImage", plain(makeImage)},
        {"vkDestroyImage", plain(destroyFaked<VkImage>)},
        {"vkCreateImageView", plain(makeView)},
        {"vkDestroyImageView", plain(destroyFaked<VkImageView>)},
        {"vkCreateBuffer", plain(makeBuffer)},
        {"vkDestroyBuffer", plain(destroyFaked<VkBuffer>)},
        {"vkCreateQueryPool", plain(makeFaked<VkQueryPoolCreateInfo, VkQueryPool>)},
        {"vkDestroyQueryPool", plain(destroyFaked<VkQueryPool>)},
        {"vkCreateDescriptorPool", plain(makeFaked<VkDescriptorPoolCreateInfo, VkDescriptorPool>)},
        {"vkDestroyDescriptorPool", plain(destroyFaked<VkDescriptorPool>)},
        {"vkResetDescriptorPool", plain(succeed)},
        {"vkAllocateDescriptorSets", plain(makeSets)},
        {"vkFreeDescriptorSets", plain(succeed)},
        {"vkGetImageMemoryRequirements", plain(imageNeeds)},
        {"vkGetBufferMemoryRequirements", plain(bufferNeeds)},
        {"vkAllocateMemory", plain(allocate)},
        {"vkFreeMemory", plain(freeMemory)},
        {"vkBindImageMemory", plain(succeed)},
        {"vkBindBufferMemory", plain(succeed)},
        {"vkMapMemory", plain(map)},
        {"vkUnmapMemory", plain(noteNothing)},
        {"vkSetDebugUtilsObjectNameEXT", plain(succeed)},
        {"vkUpdateDescriptorSets", plain(updateSets)},
        {"vkGetQueryPoolResults", plain(noQueryResults)},
        {"vkCmdBindPipeline", plain(notePipeline)},
        {"vkCmdBindDescriptorSets", plain(noteSet)},
        {"vkCmdBeginDebugUtilsLabelEXT", plain(noteLabel)},
        {"vkCmdDispatch", plain(noteDispatch)},
        {"vkCmdDispatchIndirect", plain(noteIndirect)},
        {"vkCmdPipelineBarrier2", plain(noteBarrier)},
        {"vkCmdClearColorImage", plain(noteClear)},
    };
    const auto found = ours.find(name);
    if (found != ours.end()) {
        return found->second;
    }
    return std::string_view(name).starts_with("vkCmd") ? plain(noteNothing) : vkGetDeviceProcAddr(device, name);
}

}  // namespace

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL lookUpRecorded(VkInstance instance, const char* name) {
    if (std::string_view(name) == "vkGetDeviceProcAddr") {
        return plain(lookUpOnDevice);
    }
    if (std::string_view(name) == "vkGetPhysicalDeviceMemoryProperties") {
        return plain(memoryTypes);
    }
    if (std::string_view(name) == "vkSetDebugUtilsObjectNameEXT") {
        return plain(succeed);
    }
    // Some loaders give the commands of extensions for the instance, too.
    return std::string_view(name).starts_with("vkCmd") ? lookUpOnDevice(VK_NULL_HANDLE, name)
                                                       : vkGetInstanceProcAddr(instance, name);
}

RefletImage makeHostImage(VkFormat format, uvec2 size) {
    RefletImage image{};
    image.image = nextHandle<VkImage>();
    image.view = nextHandle<VkImageView>();
    image.format = format;
    image.width = size.x;
    image.height = size.y;
    image.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    image.stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    image.access = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    noteImage(image.image, format, glm::uvec3(size, 1));
    record().views[image.view] = image.image;
    return image;
}

const std::map<std::string, Kernel>& recordedKernels() {
    return record().kernels;
}

RecordedFrame takeRecordedFrame() {
    return std::exchange(record().frame, {});
}

}  // namespace reflet::gpu_compilers
