// Shows images in a window by copies to the images of a swapchain.
#include "device/presenter.h"

#include "base/error.h"
#include "device/device.h"
#include "gpu/barrier.h"

#include <algorithm>

namespace reflet::gpu {

namespace {

// Chooses a format that displays stored values without an sRGB conversion.
VkSurfaceFormatKHR chooseFormat(VkPhysicalDevice device, VkSurfaceKHR surface) {
    uint32_t count = 0;
    vkCheck(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr), "querying the window's formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkCheck(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, formats.data()),
            "querying the window's formats");
    for (const VkFormat wanted :
         {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_A8B8G8R8_UNORM_PACK32}) {
        const auto found = std::ranges::find(formats, wanted, &VkSurfaceFormatKHR::format);
        if (found != formats.end()) {
            return *found;
        }
    }
    fail("the window supports no 8-bit UNORM format (among {} formats); select another device with --device", count);
}

}  // namespace

Presenter::Presenter(Device& device, VkSurfaceKHR surface) : device_(device), surface_(surface) {
    try {
        open();
    } catch (...) {
        vkDestroySurfaceKHR(device.instance(), surface, nullptr);
        throw;
    }
}

void Presenter::open() {
    VkBool32 supported = VK_FALSE;
    vkCheck(vkGetPhysicalDeviceSurfaceSupportKHR(device_.physical(), device_.queueFamily(), surface_, &supported),
            "asking whether the device can present to the window");
    if (supported == VK_FALSE) {
        fail("the device '{}' cannot present to this window; select another with --device", device_.description().name);
    }
    format_ = chooseFormat(device_.physical(), surface_);
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
    vkCheck(device_.functions().vkCreateFence(device_.handle(), &fence, nullptr, &acquired_), "creating a fence");
}

Presenter::~Presenter() {
    dropSwapchain();
    device_.functions().vkDestroyFence(device_.handle(), acquired_, nullptr);
    vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
}

void Presenter::dropSwapchain() {
    device_.functions().vkDeviceWaitIdle(device_.handle());
    device_.functions().vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    swapchain_ = VK_NULL_HANDLE;
}

void Presenter::makeSwapchain(uvec2 window) {
    dropSwapchain();
    VkSurfaceCapabilitiesKHR can{};
    vkCheck(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &can),
            "asking for the window's size");
    const bool free = can.currentExtent.width == UINT32_MAX;  // the window takes its size from the swapchain
    windowSize_ = window;
    imageSize_ = free ? glm::clamp(window, uvec2(can.minImageExtent.width, can.minImageExtent.height),
                                   uvec2(can.maxImageExtent.width, can.maxImageExtent.height))
                      : uvec2(can.currentExtent.width, can.currentExtent.height);
    if (imageSize_.x == 0 || imageSize_.y == 0) {
        return;
    }
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = surface_;
    info.minImageCount = std::max(can.minImageCount, std::min(can.minImageCount + 1, std::max(can.maxImageCount, 1U)));
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = {imageSize_.x, imageSize_.y};
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = (can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                              ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;  // always supported
    info.clipped = VK_TRUE;
    VkSwapchainKHR made = VK_NULL_HANDLE;
    vkCheck(device_.functions().vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &made),
            "creating the window's images");
    swapchain_ = made;
    try {
        takeImages();
    } catch (...) {
        dropSwapchain();
        throw;
    }
}

void Presenter::takeImages() {
    uint32_t count = 0;
    vkCheck(device_.functions().vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr),
            "counting the window's images");
    images_.resize(count);
    vkCheck(device_.functions().vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, images_.data()),
            "getting the window's images");
}

void Presenter::copy(VkCommandBuffer commands, const Image& from, VkImage to) const {
    layoutBarrier(device_.vk, commands, from.state->image, {}, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL);
    layoutBarrier(device_.vk, commands, to, {}, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    // A copy, because a blit between formats costs a CPU several times as much.
    VkImageCopy copy{};
    copy.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.dstSubresource = copy.srcSubresource;
    const uvec2 size = glm::min(from.size, imageSize_);
    copy.extent = {size.x, size.y, 1};
    device_.functions().vkCmdCopyImage(commands, from.state->image, VK_IMAGE_LAYOUT_GENERAL, to,
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    layoutBarrier(device_.vk, commands, to, {}, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
}

// All waits are on the host: a frame is finished before it is shown, and the next one starts after that.
bool Presenter::present(const Image& image, uvec2 window) {
    if (swapchain_ == VK_NULL_HANDLE || windowSize_ != window) {
        makeSwapchain(window);
    }
    if (imageSize_.x == 0 || imageSize_.y == 0) {
        return false;
    }
    uint32_t index = 0;
    const VkResult acquired = device_.functions().vkAcquireNextImageKHR(device_.handle(), swapchain_, UINT64_MAX,
                                                                        VK_NULL_HANDLE, acquired_, &index);
    if (acquired == VK_ERROR_OUT_OF_DATE_KHR) {
        dropSwapchain();
        return false;
    }
    if (acquired != VK_SUBOPTIMAL_KHR) {
        vkCheck(acquired, "acquiring a swapchain image");
    }
    vkCheck(device_.functions().vkWaitForFences(device_.handle(), 1, &acquired_, VK_TRUE, UINT64_MAX),
            "waiting for the window");
    vkCheck(device_.functions().vkResetFences(device_.handle(), 1, &acquired_), "resetting a fence");
    device_.runNow([&](VkCommandBuffer commands) { copy(commands, image, images_[index]); });
    VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &index;
    const VkResult presented = device_.functions().vkQueuePresentKHR(device_.queue(), &info);
    if (presented == VK_ERROR_OUT_OF_DATE_KHR) {
        dropSwapchain();
        return false;
    }
    if (presented != VK_SUBOPTIMAL_KHR) {
        vkCheck(presented, "presenting the image");
    }
    return true;
}

}  // namespace reflet::gpu
