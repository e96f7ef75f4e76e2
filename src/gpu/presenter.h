// Shows images in a window: owns its surface and swapchain.
#pragma once

#include "gpu/resource.h"

#include <vector>

namespace reflet::gpu {

class Device;

class Presenter {
public:
    /// Takes the surface over. Throws Error where the device cannot fill it.
    Presenter(Device& device, VkSurfaceKHR surface);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    /// Shows an image that the device has finished, stretched over the window of this size in pixels (not 0). Returns
    /// false where the window has just changed and the picture was not shown: draw again. Throws Error: the surface or
    /// the device is gone.
    bool present(const Image& image, uvec2 window);

    /// Presentation waits for the display's next refresh, or not (where the device can).
    void setVerticalSync(bool on);

private:
    void makeSwapchain(uvec2 window);
    void dropSwapchain();
    void copy(VkCommandBuffer commands, const Image& from, VkImage to) const;

    Device& device_;
    VkSurfaceKHR surface_;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkFence acquired_ = VK_NULL_HANDLE;
    std::vector<VkImage> images_;
    uvec2 asked_{0};  ///< size of the window that the swapchain was made for
    uvec2 size_{0};   ///< of its images
    bool verticalSync_ = true;
};

}  // namespace reflet::gpu
