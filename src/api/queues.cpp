// Queues and command buffers of a host.
#include "api/queues.h"

#include "api/calls.h"
#include "api/frame.h"

#include <algorithm>

namespace reflet::api {

std::vector<uint32_t> queueFamiliesOf(const RefletContextInfo& info) {
    if (info.queueFamilyCount > 0 && info.queueFamilies == nullptr) {
        failArgument("RefletContextInfo.queueFamilies: is NULL, and queueFamilyCount is {}", info.queueFamilyCount);
    }
    std::vector<uint32_t> families;
    for (uint32_t i = 0; i < info.queueFamilyCount; ++i) {
        const uint32_t family = info.queueFamilies[i];
        if (family >= VK_QUEUE_FAMILY_FOREIGN_EXT) {  // and those above it, which are no families of a device
            failArgument("RefletContextInfo.queueFamilies[{}]: is {:#x}; must be a family of the device's queues", i,
                         family);
        }
        if (std::ranges::find(families, family) == families.end()) {
            families.push_back(family);
        }
    }
    return families;
}

}  // namespace reflet::api

using namespace reflet::api;

RefletResult refletUseCommandBuffer(RefletView view, VkCommandBuffer commandBuffer) {
    return onView(view, [&] {
        if (!view->frame) {
            failArgument("view: no frame has begun; RefletFrameInfo.commandBuffer is the first command buffer");
        }
        if (commandBuffer == VK_NULL_HANDLE) {
            failArgument("commandBuffer: is VK_NULL_HANDLE");
        }
        view->commands = commandBuffer;
        view->recorder.recordInto(commandBuffer);
    });
}
