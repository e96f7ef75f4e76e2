// Acceleration structures for hardware ray tracing: one bottom level with the triangles, one top level with a single
// instance. Only on devices with Device::hasRayQuery. (VK_KHR_ray_tracing_pipeline without VK_KHR_ray_query is not
// supported: drivers with the former also have the latter.)
#pragma once

#include "gpu/resource.h"

#include <cstdint>

namespace reflet::gpu {

class Device;

/// Usage flags that buffers need, besides others, as input of an AccelerationStructure.
constexpr VkBufferUsageFlags accelerationInput =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

/// Triangles in a buffer: one vertex after the other, three floats every `stride` bytes, without indices.
struct TriangleInput {
    const Buffer& corners;
    uint32_t stride = 0;
    uint32_t count = 0;  ///< triangles, at least 1
    bool opaque = true;  ///< false: shaders decide about each hit
};

class AccelerationStructure {
public:
    AccelerationStructure() = default;
    /// Builds the structure and waits for the device. In shaders `primitiveIndex` is the index of the triangle in the
    /// buffer. Throws Error if memory does not suffice; std::logic_error on a device without ray query.
    AccelerationStructure(Device& device, const TriangleInput& triangles);
    ~AccelerationStructure();
    AccelerationStructure(AccelerationStructure&& other) noexcept;
    AccelerationStructure& operator=(AccelerationStructure&& other) noexcept;
    AccelerationStructure(const AccelerationStructure&) = delete;
    AccelerationStructure& operator=(const AccelerationStructure&) = delete;

    [[nodiscard]] AccelerationView view() const { return {top_.structure}; }

private:
    struct Level {
        Buffer memory;
        VkAccelerationStructureKHR structure = VK_NULL_HANDLE;
    };
    void build(Level& level, VkAccelerationStructureTypeKHR type, const VkAccelerationStructureGeometryKHR& geometry,
               uint32_t primitives);
    void retire(Level& level);

    Device* device_ = nullptr;
    Level bottom_;
    Level top_;
};

}  // namespace reflet::gpu
