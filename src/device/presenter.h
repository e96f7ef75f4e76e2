// Shows images in a window: owns its surface and swapchain.
#pragma once

#include "gpu/resource.h"

#include <vector>

namespace reflet::gpu {

class Device;

class Presenter {
public:
    /// Takes ownership of the surface. Throws Error if the device cannot present to it.
    Presenter(Device& device, VkSurfaceKHR surface);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    /// Whether the window's pixels have blue where RGBA8 has red.
    [[nodiscard]] bool isSwapped() const { return format_.format == VK_FORMAT_B8G8R8A8_UNORM; }

    /// Shows a finished RGBA8 image (with red and blue exchanged, if isSwapped()) in the upper left of the window of
    /// this size in pixels (not 0). Returns false if the window has just changed and nothing was shown: draw again.
    /// Throws Error if the surface or the device is lost.
    bool present(const Image& image, uvec2 window);

private:
    void open();
    void makeSwapchain(uvec2 window);
    void takeImages();
    void dropSwapchain();
    void copy(VkCommandBuffer commands, const Image& from, VkImage to) const;

    Device& device_;
    VkSurfaceKHR surface_;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format_{};
    VkFence acquired_ = VK_NULL_HANDLE;
    std::vector<VkImage> images_;
    uvec2 windowSize_{0};  ///< size of the window for which the swapchain was created
    uvec2 imageSize_{0};   ///< size of the swapchain's images
};

}  // namespace reflet::gpu
