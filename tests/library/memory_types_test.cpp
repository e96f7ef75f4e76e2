// Device memory that runs out: what suits less well is used before an error is.
#include "library/library_host.h"
#include "stub/host.h"

#include <algorithm>
#include <string>
#include <vector>

namespace reflet::test::memory_types_test {
namespace {

class MemoryTypes : public ::testing::Test {
protected:
    MemoryTypes() {
        stub::setDevice({});
        RefletContextInfo info = stub::contextInfo();
        const auto deviceFunction =
            reinterpret_cast<PFN_vkGetDeviceProcAddr>(info.getInstanceProcAddr(info.instance, "vkGetDeviceProcAddr"));
        allocate_ = reinterpret_cast<PFN_vkAllocateMemory>(deviceFunction(info.device, "vkAllocateMemory"));
        free_ = reinterpret_cast<PFN_vkFreeMemory>(deviceFunction(info.device, "vkFreeMemory"));
        device_ = info.device;
        const RefletMemoryCallbacks calls{sizeof calls, this,
                                          [](void* self, const VkMemoryAllocateInfo* what, VkDeviceMemory* memory) {
                                              return static_cast<MemoryTypes*>(self)->give(*what, memory);
                                          },
                                          [](void* self, VkDeviceMemory memory) {
                                              auto& test = *static_cast<MemoryTypes*>(self);
                                              test.free_(test.device_, memory, nullptr);
                                          }};
        info.memory = &calls;
        EXPECT_REFLET(refletCreateContext(&info, &context_));
    }
    ~MemoryTypes() override {
        refletDestroyContext(context_);
        EXPECT_EQ(stub::leaks(), "");
    }

    /// The result of a view's first frame, with all of its images.
    RefletResult firstFrame() {
        RefletView view = nullptr;
        RefletSettings settings = nullptr;
        const RefletViewInfo size{sizeof size, 64, 40, 2, 0, 0};
        EXPECT_REFLET(refletCreateSettings("fast", &settings));
        const RefletResult made = refletCreateView(context_, &size, &view);
        if (made != REFLET_SUCCESS) {
            refletDestroySettings(settings);
            return made;
        }
        stub::HostFrame host{64, 40};
        host.frame.commandBuffer = stub::beginCommands();
        RefletImage image{};
        RefletResult result = refletBeginFrame(view, &host.frame);
        if (result == REFLET_SUCCESS) {
            result = refletSunShadow(view, settings, &host.sun, &image);
            const RefletResult end = refletEndFrame(view);
            result = result == REFLET_SUCCESS ? end : result;
        }
        stub::finishCommands(host.frame.commandBuffer);
        refletDestroyView(view);
        refletDestroySettings(settings);
        return result;
    }

    uint32_t full_ = VK_MAX_MEMORY_TYPES;      ///< the type of which there is none left
    VkDeviceSize largest_ = ~VkDeviceSize(0);  ///< bytes that can be had at once
    std::vector<VkMemoryAllocateInfo> given_;

private:
    VkResult give(const VkMemoryAllocateInfo& what, VkDeviceMemory* memory) {
        if (what.memoryTypeIndex == full_ || what.allocationSize > largest_) {
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        }
        given_.push_back(what);
        return allocate_(device_, &what, nullptr, memory);
    }

    RefletContext context_ = nullptr;
    VkDevice device_ = VK_NULL_HANDLE;
    PFN_vkAllocateMemory allocate_ = nullptr;
    PFN_vkFreeMemory free_ = nullptr;
};

TEST_F(MemoryTypes, ImagesAreInTheDevicesMemory) {
    given_.clear();
    ASSERT_EQ(firstFrame(), REFLET_SUCCESS);
    EXPECT_TRUE(std::ranges::any_of(given_, [](const auto& info) { return info.memoryTypeIndex == 0; }));
}

TEST_F(MemoryTypes, AFullHeapIsNotTheEnd) {
    given_.clear();
    full_ = 0;
    ASSERT_EQ(firstFrame(), REFLET_SUCCESS) << refletLastError();
    EXPECT_FALSE(given_.empty());
}

TEST_F(MemoryTypes, WhatIsTooLittleForABlockIsEnoughForAnImage) {
    largest_ = VkDeviceSize(8) << 20U;
    ASSERT_EQ(firstFrame(), REFLET_SUCCESS) << refletLastError();
}

TEST_F(MemoryTypes, WithoutAnyMemoryThereIsAnErrorThatSaysHowMuchIsMissing) {
    largest_ = 0;
    EXPECT_EQ(firstFrame(), REFLET_ERROR_OUT_OF_MEMORY);
    EXPECT_NE(std::string(refletLastError()).find("out of device memory"), std::string::npos) << refletLastError();
}

}  // namespace
}  // namespace reflet::test::memory_types_test
