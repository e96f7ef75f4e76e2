// Images that go into and out of the library.
#include "api/calls.h"
#include "api/frame.h"

#include <array>

namespace reflet::api {

namespace {

bool isDepth(VkFormat format) {
    return format >= VK_FORMAT_D16_UNORM && format <= VK_FORMAT_D32_SFLOAT_S8_UINT && format != VK_FORMAT_S8_UINT;
}

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

// Formats that shaders sample as floats, of up to 32 bits a channel.
bool isSampledAsFloat(VkFormat format) {
    constexpr std::array known{VK_FORMAT_R8_UNORM,
                               VK_FORMAT_R8_SNORM,
                               VK_FORMAT_R8G8_UNORM,
                               VK_FORMAT_R8G8_SNORM,
                               VK_FORMAT_R8G8B8_UNORM,
                               VK_FORMAT_R8G8B8A8_UNORM,
                               VK_FORMAT_R8G8B8A8_SNORM,
                               VK_FORMAT_R8G8B8A8_SRGB,
                               VK_FORMAT_B8G8R8A8_UNORM,
                               VK_FORMAT_B8G8R8A8_SRGB,
                               VK_FORMAT_A8B8G8R8_UNORM_PACK32,
                               VK_FORMAT_A8B8G8R8_SNORM_PACK32,
                               VK_FORMAT_A8B8G8R8_SRGB_PACK32,
                               VK_FORMAT_A2R10G10B10_UNORM_PACK32,
                               VK_FORMAT_A2B10G10R10_UNORM_PACK32,
                               VK_FORMAT_R16_UNORM,
                               VK_FORMAT_R16_SNORM,
                               VK_FORMAT_R16_SFLOAT,
                               VK_FORMAT_R16G16_UNORM,
                               VK_FORMAT_R16G16_SNORM,
                               VK_FORMAT_R16G16_SFLOAT,
                               VK_FORMAT_R16G16B16_SFLOAT,
                               VK_FORMAT_R16G16B16A16_UNORM,
                               VK_FORMAT_R16G16B16A16_SNORM,
                               VK_FORMAT_R16G16B16A16_SFLOAT,
                               VK_FORMAT_R32_SFLOAT,
                               VK_FORMAT_R32G32_SFLOAT,
                               VK_FORMAT_R32G32B32_SFLOAT,
                               VK_FORMAT_R32G32B32A32_SFLOAT,
                               VK_FORMAT_B10G11R11_UFLOAT_PACK32,
                               VK_FORMAT_E5B9G9R9_UFLOAT_PACK32};
    return isDepth(format) || std::ranges::find(known, format) != known.end();
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

VkImageMemoryBarrier2 barrierOf(const RefletImage& image) {
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.image;
    barrier.subresourceRange = {aspectsOf(image.format), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
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

}  // namespace

void checkImage(const RefletImage& image, const char* name, uvec2 size) {
    if (image.view == VK_NULL_HANDLE) {
        failArgument("{}.view: is VK_NULL_HANDLE", name);
    }
    if (!isSampledAsFloat(image.format)) {
        failArgument("{}.format: VkFormat {} is not sampled as float; use a float, unorm, snorm or depth format", name,
                     static_cast<int>(image.format));
    }
    if (image.width < 1 || image.height < 1) {
        failArgument("{}.width, height: are {}x{}", name, image.width, image.height);
    }
    if (size.x > 0 && (image.width != size.x || image.height != size.y)) {
        failArgument(
            "{}.width, height: are {}x{}, and the view is {}x{}; call refletResizeView, or give images of its size",
            name, image.width, image.height, size.x, size.y);
    }
    if (image.layout == VK_IMAGE_LAYOUT_UNDEFINED || image.layout == VK_IMAGE_LAYOUT_PREINITIALIZED) {
        failArgument("{}.layout: VkImageLayout {} has no content to read", name, static_cast<int>(image.layout));
    }
}

gpu::Image HostImages::add(const RefletImage& image) {
    if (image.image == VK_NULL_HANDLE) {
        return {};
    }
    gpu::ImageState& state = view_.hostImages.emplace_back();
    state.image = image.image;
    state.view = image.view;
    state.layout = sampledLayout(image);
    state.external = true;
    // One image may be given for several fields: it gets one barrier.
    const bool known = std::ranges::any_of(images_, [&](const RefletImage& i) { return i.image == image.image; });
    if (!known) {
        images_.push_back(image);
    }
    return {&state, -1, image.format, {image.width, image.height}, 1, 1};
}

void HostImages::acquire() {
    std::vector<VkImageMemoryBarrier2> barriers;
    for (const RefletImage& image : images_) {
        const bool moves = !isSampledIn(image.layout);
        if (image.stages == 0 && !moves) {
            continue;
        }
        VkImageMemoryBarrier2 barrier = barrierOf(image);
        barrier.srcStageMask = image.stages != 0 ? image.stages : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.srcAccessMask = image.access;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
        barrier.oldLayout = image.layout;
        barrier.newLayout = sampledLayout(image);
        barriers.push_back(barrier);
    }
    back_.reserve(images_.size());
    record(view_, barriers);
    // Later writes of the host wait for the reads, and find the layout that they left.
    for (const RefletImage& image : images_) {
        VkImageMemoryBarrier2 barrier = barrierOf(image);
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.dstAccessMask = accessIn(image.layout);
        barrier.oldLayout = sampledLayout(image);
        barrier.newLayout = image.layout;
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
