// Builds acceleration structures.
#include "device/acceleration.h"

#include "base/error.h"
#include "device/device.h"
#include "device/upload.h"

namespace reflet::gpu {

namespace {

VkDeviceAddress addressOf(Device& device, const Buffer& buffer) {
    const VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, buffer.handle()};
    return device.vk.vkGetBufferDeviceAddress(device.handle(), &info);
}

VkAccelerationStructureGeometryKHR triangleGeometry(Device& device, const TriangleInput& input) {
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags = input.opaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
    VkAccelerationStructureGeometryTrianglesDataKHR& triangles = geometry.geometry.triangles;
    triangles = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR};
    triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    triangles.vertexData.deviceAddress = addressOf(device, input.corners);
    triangles.vertexStride = input.stride;
    triangles.maxVertex = 3 * input.count - 1;
    triangles.indexType = VK_INDEX_TYPE_NONE_KHR;
    return geometry;
}

// A single instance with the identity transform.
Buffer uploadInstance(Device& device, VkAccelerationStructureKHR bottom) {
    const VkAccelerationStructureDeviceAddressInfoKHR info{
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR, nullptr, bottom};
    VkAccelerationStructureInstanceKHR instance{};
    for (int i = 0; i < 3; ++i) {
        instance.transform.matrix[i][i] = 1.0F;
    }
    instance.mask = 0xFF;
    instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
    instance.accelerationStructureReference =
        device.vk.vkGetAccelerationStructureDeviceAddressKHR(device.handle(), &info);
    return uploadBuffer(device, std::as_bytes(std::span(&instance, 1)), accelerationInput, "scene instance");
}

VkAccelerationStructureGeometryKHR instanceGeometry(Device& device, const Buffer& instance) {
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    VkAccelerationStructureGeometryInstancesDataKHR& instances = geometry.geometry.instances;
    instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
    instances.data.deviceAddress = addressOf(device, instance);
    return geometry;
}

// Records the build, and a barrier that makes the result visible to all later commands.
void recordBuild(Device& device, VkCommandBuffer commands, const VkAccelerationStructureBuildGeometryInfoKHR& info,
                 uint32_t primitives) {
    VkAccelerationStructureBuildRangeInfoKHR range{};
    range.primitiveCount = primitives;
    const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
    device.vk.vkCmdBuildAccelerationStructuresKHR(commands, 1, &info, &ranges);
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
    barrier.srcAccessMask = VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &barrier;
    device.vk.vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

AccelerationStructure::AccelerationStructure(Device& device, const TriangleInput& triangles)
    : AccelerationStructure() {  // so that the destructor runs if something fails below
    device_ = &device;
    REFLET_CHECK(device.hasRayQuery(), "'{}' has no ray query", device.description().name);
    build(bottom_, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, triangleGeometry(device, triangles),
          triangles.count);
    const Buffer instance = uploadInstance(device, bottom_.structure);
    build(top_, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, instanceGeometry(device, instance), 1);
}

void AccelerationStructure::build(Level& level, VkAccelerationStructureTypeKHR type,
                                  const VkAccelerationStructureGeometryKHR& geometry, uint32_t primitives) {
    VkAccelerationStructureBuildGeometryInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
    info.type = type;
    info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    info.geometryCount = 1;
    info.pGeometries = &geometry;
    VkAccelerationStructureBuildSizesInfoKHR sizes{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
    const DeviceFunctions& vk = device_->vk;
    vk.vkGetAccelerationStructureBuildSizesKHR(device_->handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR,
                                               &info, &primitives, &sizes);

    level.memory =
        Buffer(*device_, sizes.accelerationStructureSize,
               VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
               MemoryUse::device, "scene hierarchy");
    VkAccelerationStructureCreateInfoKHR create{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
    create.buffer = level.memory.handle();
    create.size = sizes.accelerationStructureSize;
    create.type = type;
    VkAccelerationStructureKHR made = VK_NULL_HANDLE;
    vkCheck(vk.vkCreateAccelerationStructureKHR(device_->handle(), &create, nullptr, &made),
            "creating an acceleration structure");
    level.structure = made;

    const VkDeviceSize alignment = device_->scratchAlignment();
    const Buffer scratch(*device_, sizes.buildScratchSize + alignment,
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                         MemoryUse::device, "scene hierarchy's scratch");
    info.dstAccelerationStructure = level.structure;
    info.scratchData.deviceAddress = (addressOf(*device_, scratch) + alignment - 1) / alignment * alignment;
    device_->runNow([&](VkCommandBuffer commands) { recordBuild(*device_, commands, info, primitives); });
}

void AccelerationStructure::retire(Level& level) {
    if (level.structure != VK_NULL_HANDLE) {
        device_->retire([device = device_, structure = level.structure] {
            device->vk.vkDestroyAccelerationStructureKHR(device->handle(), structure, nullptr);
        });
        level = {};  // frees the memory after the structure
    }
}

AccelerationStructure::~AccelerationStructure() {
    retire(top_);
    retire(bottom_);
}

AccelerationStructure::AccelerationStructure(AccelerationStructure&& other) noexcept {
    *this = std::move(other);
}

AccelerationStructure& AccelerationStructure::operator=(AccelerationStructure&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(bottom_, other.bottom_);
    std::swap(top_, other.top_);
    return *this;
}

}  // namespace reflet::gpu
