// Images that go into and out of the library.
#include "api/calls.h"
#include "api/frame.h"
#include "gpu/listing.h"

#include <algorithm>
#include <array>

namespace reflet::api {

namespace {

// Barriers name both aspects of formats that have them.
VkImageAspectFlags aspectsOf(VkFormat format) {
    switch (format) {
        case VK_FORMAT_D16_UNORM:
        case VK_FORMAT_X8_D24_UNORM_PACK32:
        case VK_FORMAT_D32_SFLOAT:
            return VK_IMAGE_ASPECT_DEPTH_BIT;
        case VK_FORMAT_D16_UNORM_S8_UINT:
        case VK_FORMAT_D24_UNORM_S8_UINT:
        case VK_FORMAT_D32_SFLOAT_S8_UINT:
            return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
        default:
            return VK_IMAGE_ASPECT_COLOR_BIT;
    }
}

struct KnownFormat {
    VkFormat format;
    uint32_t channels;
};

// Formats that shaders sample as floats, of up to 32 bits a channel.
constexpr std::array knownFormats{KnownFormat{VK_FORMAT_R8_UNORM, 1},
                                  KnownFormat{VK_FORMAT_R8_SNORM, 1},
                                  KnownFormat{VK_FORMAT_R8G8_UNORM, 2},
                                  KnownFormat{VK_FORMAT_R8G8_SNORM, 2},
                                  KnownFormat{VK_FORMAT_R8G8B8_UNORM, 3},
                                  KnownFormat{VK_FORMAT_R8G8B8A8_UNORM, 4},
                                  KnownFormat{VK_FORMAT_R8G8B8A8_SNORM, 4},
                                  KnownFormat{VK_FORMAT_R8G8B8A8_SRGB, 4},
                                  KnownFormat{VK_FORMAT_B8G8R8A8_UNORM, 4},
                                  KnownFormat{VK_FORMAT_B8G8R8A8_SRGB, 4},
                                  KnownFormat{VK_FORMAT_A8B8G8R8_UNORM_PACK32, 4},
                                  KnownFormat{VK_FORMAT_A8B8G8R8_SNORM_PACK32, 4},
                                  KnownFormat{VK_FORMAT_A8B8G8R8_SRGB_PACK32, 4},
                                  KnownFormat{VK_FORMAT_A2R10G10B10_UNORM_PACK32, 4},
                                  KnownFormat{VK_FORMAT_A2B10G10R10_UNORM_PACK32, 4},
                                  KnownFormat{VK_FORMAT_R16_UNORM, 1},
                                  KnownFormat{VK_FORMAT_R16_SNORM, 1},
                                  KnownFormat{VK_FORMAT_R16_SFLOAT, 1},
                                  KnownFormat{VK_FORMAT_R16G16_UNORM, 2},
                                  KnownFormat{VK_FORMAT_R16G16_SNORM, 2},
                                  KnownFormat{VK_FORMAT_R16G16_SFLOAT, 2},
                                  KnownFormat{VK_FORMAT_R16G16B16_SFLOAT, 3},
                                  KnownFormat{VK_FORMAT_R16G16B16A16_UNORM, 4},
                                  KnownFormat{VK_FORMAT_R16G16B16A16_SNORM, 4},
                                  KnownFormat{VK_FORMAT_R16G16B16A16_SFLOAT, 4},
                                  KnownFormat{VK_FORMAT_R32_SFLOAT, 1},
                                  KnownFormat{VK_FORMAT_R32G32_SFLOAT, 2},
                                  KnownFormat{VK_FORMAT_R32G32B32_SFLOAT, 3},
                                  KnownFormat{VK_FORMAT_R32G32B32A32_SFLOAT, 4},
                                  KnownFormat{VK_FORMAT_B10G11R11_UFLOAT_PACK32, 3},
                                  KnownFormat{VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, 3}};

// 0: not sampled as float.
uint32_t channelsOf(VkFormat format) {
    const auto found = std::ranges::find(knownFormats, format, &KnownFormat::format);
    return found != knownFormats.end() ? found->channels : 0;
}

void checkFormat(VkFormat format, const char* name, uint32_t channels) {
    const std::string given = gpu::formatName(format);
    if (channels == depthChannel) {
        if (!isDepthFormat(format) && format != VK_FORMAT_R32_SFLOAT) {
            failArgument("{}.format: is {}; depth is of a depth format or of R32_SFLOAT", name, given);
        }
        return;
    }
    if (channelsOf(format) == 0) {
        failArgument("{}.format: is {}; must be a float, unorm or snorm format of colour", name, given);
    }
    if (channelsOf(format) < channels) {
        failArgument("{}.format: is {}, which has {} of the {} channels that are read", name, given, channelsOf(format),
                     channels);
    }
}

bool isSampledIn(VkImageLayout layout) {
    switch (layout) {
        case VK_IMAGE_LAYOUT_GENERAL:
        case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL:
        case VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL:
            return true;
        default:
            return false;
    }
}

// Whether an image may be in it. Others have no content, or none that shaders can sample.
bool isKnown(VkImageLayout layout) {
    switch (layout) {
        case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_STENCIL_READ_ONLY_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
        case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
        case VK_IMAGE_LAYOUT_PRESENT_SRC_KHR:
        case VK_IMAGE_LAYOUT_ATTACHMENT_FEEDBACK_LOOP_OPTIMAL_EXT:
            return true;
        default:
            return isSampledIn(layout);
    }
}

VkImageMemoryBarrier2 barrierOf(const RefletImage& image, uint32_t layers, uint32_t levels) {
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.image;
    barrier.subresourceRange = {aspectsOf(image.format), image.baseLevel, levels, image.baseLayer, layers};
    return barrier;
}

void record(RefletView_T& view, const std::vector<VkImageMemoryBarrier2>& barriers) {
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = static_cast<uint32_t>(barriers.size());
    info.pImageMemoryBarriers = barriers.data();
    if (!barriers.empty()) {
        view.owner.gpu->vk.vkCmdPipelineBarrier2(view.commands, &info);
    }
}

VkImageLayout sampledLayout(const RefletImage& image) {
    return isSampledIn(image.layout) ? image.layout : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
}

// What a host may do with an image in a layout.
VkAccessFlags2 accessIn(VkImageLayout layout) {
    switch (layout) {
        case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
            return VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
        case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
        case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL:
            return VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
        default:
            return VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    }
}

// Where it is, and which rectangle of it is used.
void checkPlace(const RefletImage& image, const char* name, const Rectangle& used) {
    if (image.view == VK_NULL_HANDLE) {
        failArgument("{}.view: is VK_NULL_HANDLE", name);
    }
    if (image.width < 1 || image.height < 1) {
        failArgument("{}.width, height: are {}x{}", name, image.width, image.height);
    }
    const uvec2 size = used.size;
    const uvec2 offset(image.offset[0], image.offset[1]);
    const bool moved = offset != uvec2(0);
    if (moved && size == uvec2(0)) {
        failArgument("{}.offset: is ({}, {}); must be 0, as all of the image is read", name, offset.x, offset.y);
    }
    if (moved && (image.width < size.x || image.height < size.y || offset.x > image.width - size.x ||
                  offset.y > image.height - size.y || offset.x > UINT16_MAX || offset.y > UINT16_MAX)) {
        failArgument("{}.offset: is ({}, {}); from there a rectangle of {}x{} does not fit into {}x{}", name, offset.x,
                     offset.y, size.x, size.y, image.width, image.height);
    }
    if (used.inLarger && (image.width < size.x || image.height < size.y)) {
        failArgument(
            "{}.width, height: are {}x{}, smaller than the rectangle of {}x{} that is used "
            "(RefletFrameInfo.renderSize)",
            name, image.width, image.height, size.x, size.y);
    }
    if (!moved && !used.inLarger && size.x > 0 && (image.width != size.x || image.height != size.y)) {
        failArgument(
            "{}.width, height: are {}x{}, and the view is {}x{}; call refletResizeView, give images of its size, or "
            "say in RefletFrameInfo.renderSize or RefletImage.offset which rectangle is drawn",
            name, image.width, image.height, size.x, size.y);
    }
    if (image.baseLevel > 15) {
        failArgument("{}.baseLevel: is {}; images have at most 16", name, image.baseLevel);
    }
    if (std::ranges::any_of(image.reserved, [](uint32_t value) { return value != 0; })) {
        failArgument("{}.reserved: must be 0; clear the struct before you fill it", name);
    }
}

VkImageLayout layoutLeft(const RefletImage& output) {
    return output.layout == VK_IMAGE_LAYOUT_UNDEFINED ? VK_IMAGE_LAYOUT_GENERAL : output.layout;
}

}  // namespace

bool isDepthFormat(VkFormat format) {
    return format >= VK_FORMAT_D16_UNORM && format <= VK_FORMAT_D32_SFLOAT_S8_UINT && format != VK_FORMAT_S8_UINT;
}

void checkImage(const RefletImage& image, const char* name, const Rectangle& read, uint32_t channels) {
    checkFormat(image.format, name, channels);
    checkPlace(image, name, read);
    if (!isKnown(image.layout)) {
        failArgument("{}.layout: is VkImageLayout {}, which has nothing that shaders can sample", name,
                     static_cast<int>(image.layout));
    }
}

void checkOutput(const RefletImage& image, const char* name, uvec2 size) {
    if (image.image == VK_NULL_HANDLE) {
        failArgument("{}.image: is VK_NULL_HANDLE; pass NULL for an image of the library's", name);
    }
    checkPlace(image, name, {size, true});
    if (image.layout != VK_IMAGE_LAYOUT_UNDEFINED && !isKnown(image.layout)) {
        failArgument("{}.layout: is VkImageLayout {}; give the layout it is in, or VK_IMAGE_LAYOUT_UNDEFINED", name,
                     static_cast<int>(image.layout));
    }
}

gpu::Image HostImages::adopt(const RefletImage& image, uvec2 size, VkImageLayout layout) {
    gpu::ImageState& state = view_.hostImages.emplace_back();
    state.image = image.image;
    state.view = image.view;
    state.layout = layout;
    state.origin = {image.offset[0], image.offset[1]};
    state.external = true;
    return {&state, -1, image.format, size.x > 0 ? size : uvec2(image.width, image.height), 1, 1};
}

gpu::Image HostImages::add(const RefletImage& image, uvec2 size, uint32_t layers, uint32_t levels) {
    if (image.image == VK_NULL_HANDLE) {
        return {};
    }
    // One image may be given for several fields: it gets one barrier.
    const auto known = std::ranges::find_if(images_, [&](const Given& i) {
        return i.image.image == image.image && i.image.baseLayer == image.baseLayer &&
               i.image.baseLevel == image.baseLevel;
    });
    if (known == images_.end()) {
        images_.push_back({image, layers, levels});
    } else {
        known->image.stages |= image.stages;
        known->image.access |= image.access;
        known->layers = std::max(known->layers, layers);
        known->levels = std::max(known->levels, levels);
    }
    return adopt(image, size, sampledLayout(image));
}

gpu::Image HostImages::addOutput(const RefletImage& image, uvec2 size) {
    images_.push_back({.image = image, .layers = 1, .levels = 1, .written = true});
    return adopt(image, size, VK_IMAGE_LAYOUT_GENERAL);
}

RefletImage HostImages::left(const RefletImage& output) {
    RefletImage now = output;
    now.layout = layoutLeft(output);
    now.stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    now.access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    return now;
}

void HostImages::acquire() {
    std::vector<VkImageMemoryBarrier2> barriers;
    for (const auto& [image, layers, levels, written] : images_) {
        const bool moves = written ? image.layout != VK_IMAGE_LAYOUT_GENERAL : !isSampledIn(image.layout);
        if (image.stages == 0 && !moves) {
            continue;
        }
        VkImageMemoryBarrier2 barrier = barrierOf(image, layers, levels);
        barrier.srcStageMask = image.stages != 0 ? image.stages : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.srcAccessMask = image.access;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.dstAccessMask = written ? VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT : VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
        barrier.oldLayout = image.layout;
        barrier.newLayout = written ? VK_IMAGE_LAYOUT_GENERAL : sampledLayout(image);
        barriers.push_back(barrier);
    }
    back_.reserve(images_.size());
    record(view_, barriers);
    // Later commands of the host wait for the reads and writes, and find the layout that they left.
    for (const auto& [image, layers, levels, written] : images_) {
        const VkImageLayout layout = written ? layoutLeft(image) : image.layout;
        VkImageMemoryBarrier2 barrier = barrierOf(image, layers, levels);
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.srcAccessMask = written ? VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT : VK_ACCESS_2_NONE;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.dstAccessMask = accessIn(layout);
        barrier.oldLayout = written ? VK_IMAGE_LAYOUT_GENERAL : sampledLayout(image);
        barrier.newLayout = layout;
        back_.push_back(barrier);
    }
}

HostImages::~HostImages() {
    record(view_, back_);
}

RefletImage resultOf(const gpu::Image& image) {
    RefletImage result{};
    if (!image) {
        return result;
    }
    result.image = image.state->image;
    result.view = image.view();
    result.format = image.format;
    result.width = image.size.x;
    result.height = image.size.y;
    result.layout = image.state->layout;
    result.stages = image.state->access.writeStages;
    result.access = image.state->access.writeAccess;
    return result;
}

}  // namespace reflet::api
