// Destructors without any memory: they must not end the process, which may be a host's.
#include "device/device.h"
#include "fault/allocations.h"
#include "gpu/resource.h"

#include <gtest/gtest.h>

#include <optional>

namespace reflet::fault {
namespace {

TEST(WithoutMemory, ObjectsInUseAreDestroyedOrKeptUntilTheDeviceIs) {
    gpu::Device device;
    const uint64_t work = device.beginWork();
    std::optional<gpu::Texture> texture;
    texture.emplace(device, gpu::ImageInfo{VK_FORMAT_R32_SFLOAT, uvec2(4), 3, 1, VK_IMAGE_USAGE_STORAGE_BIT},
                    "texture");
    std::optional<gpu::Buffer> buffer = gpu::storageBuffer(device, 64, "buffer");
    {
        const FailingAllocation failing(Allocator::operatorNew, 1, true);
        texture.reset();
        buffer.reset();
        device.finishWork(work);
    }
    EXPECT_GT(device.memory().reserved(), 0U);  // kept
    buffer = gpu::storageBuffer(device, 64, "buffer");
    buffer.reset();  // and all goes on
}

TEST(WithoutMemory, ObjectsThatAreNotInUseAreDestroyed) {
    gpu::Device device;
    const uint64_t work = device.beginWork();
    std::optional<gpu::Buffer> used = gpu::storageBuffer(device, 64, "used");
    used.reset();
    std::optional<gpu::Texture> texture;
    {
        const FailingAllocation failing(Allocator::operatorNew, 1, true);
        device.finishWork(work);
    }
    texture.emplace(device, gpu::ImageInfo{VK_FORMAT_R32_SFLOAT, uvec2(4), 3, 1, VK_IMAGE_USAGE_STORAGE_BIT},
                    "texture");
    {
        const FailingAllocation failing(Allocator::operatorNew, 1, true);
        texture.reset();
    }
    EXPECT_EQ(device.memory().used(gpu::MemoryUse::device), 0U);
}

}  // namespace
}  // namespace reflet::fault
