// A device of Vulkan 1.2 with VK_KHR_synchronization2: the library needs no more. Here it is one of 1.3 that hides what
// came later.
#include "library/library_fixture.h"

#include <volk.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace reflet::test::vulkan12_test {
namespace {

VKAPI_ATTR void VKAPI_CALL properties12(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* properties) {
    vkGetPhysicalDeviceProperties2(physical, properties);
    properties->properties.apiVersion = VK_API_VERSION_1_2;
}

PFN_vkVoidFunction hiding(VkDevice device, std::string_view name, bool synchronizes) {
    constexpr std::array newer{"vkCmdPipelineBarrier2", "vkCmdWriteTimestamp2", "vkCmdBeginRendering",
                               "vkCmdEndRendering",     "vkCmdSetCullMode",     "vkCmdSetFrontFace"};
    if (std::ranges::find(newer, name) != newer.end()) {
        return nullptr;
    }
    if (synchronizes && (name == "vkCmdPipelineBarrier2KHR" || name == "vkCmdWriteTimestamp2KHR")) {
        return vkGetDeviceProcAddr(device, std::string(name.substr(0, name.size() - 3)).c_str());
    }
    return vkGetDeviceProcAddr(device, std::string(name).c_str());
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL ofDevice12(VkDevice device, const char* name) {
    return hiding(device, name, true);
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL ofPlainDevice12(VkDevice device, const char* name) {
    return hiding(device, name, false);
}

template <auto OfDevice>
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL ofInstance12(VkInstance instance, const char* name) {
    const std::string_view wanted(name);
    if (wanted == "vkGetPhysicalDeviceProperties2") {
        return reinterpret_cast<PFN_vkVoidFunction>(properties12);
    }
    if (wanted == "vkGetDeviceProcAddr") {
        return reinterpret_cast<PFN_vkVoidFunction>(+OfDevice);
    }
    return vkGetInstanceProcAddr(instance, name);
}

using Vulkan12 = Library;

TEST_F(Vulkan12, RendersTheSameAs13) {
    const HostRoom room(host_, {});
    RefletSettings settings = makeSettings("balanced");
    const auto render = [&](PFN_vkGetInstanceProcAddr lookUp) {
        RefletContextInfo info = host_.contextInfo();
        info.getInstanceProcAddr = lookUp;
        RefletContext context = nullptr;
        EXPECT_REFLET(refletCreateContext(&info, &context));
        RefletView view = makeView(context, 3);
        const RoomResults results = renderFrames(room, view, settings, 2);
        const std::vector<uint32_t> shown = texelsOf<uint32_t>(host_, results.display);
        refletDestroyView(view);
        refletDestroyContext(context);
        return shown;
    };
    EXPECT_EQ(render(ofInstance12<ofDevice12>), render(vkGetInstanceProcAddr));
    refletDestroySettings(settings);
}

TEST_F(Vulkan12, NeedsSynchronization2) {
    RefletContextInfo info = host_.contextInfo();
    info.getInstanceProcAddr = ofInstance12<ofPlainDevice12>;
    RefletContext context = nullptr;
    EXPECT_EQ(refletCreateContext(&info, &context), REFLET_ERROR_MISSING_FEATURE);
    EXPECT_NE(std::string(refletLastError()).find("VK_KHR_synchronization2"), std::string::npos) << refletLastError();
}

}  // namespace
}  // namespace reflet::test::vulkan12_test
