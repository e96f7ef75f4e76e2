// A Vulkan driver of the tests' own, which executes and records nothing: for fuzzing, races and long runs of the C API.
// It counts its objects, and ends the program with a message when one is used after it was destroyed, destroyed while
// commands that use it have not finished, bound outside of its memory, or given back twice. For any thread.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include "reflet/reflet.h"

#include <array>
#include <cstdint>
#include <string>

namespace reflet::stub {

enum class Kind : uint32_t {
    image,
    imageView,
    buffer,
    memory,
    shader,
    setLayout,
    layout,
    pipeline,
    pipelineCache,
    sampler,
    pool,
    set,
    queryPool,
    commands,
};
constexpr size_t kinds = 14;

/// By kind.
struct Counts {
    std::array<uint64_t, kinds> made{};  ///< since the program began
    std::array<uint64_t, kinds> live{};

    bool operator==(const Counts&) const = default;
};
Counts counts();
const char* nameOf(size_t kind);
/// "image 3 buffer 1" of what is alive; command buffers, which belong to the tests, are left out.
std::string leaks();

/// What the device is, for contexts that are made from now on.
struct Device {
    bool cpu = false;                       ///< its type
    bool writesWithoutFormat = true;        ///< enabled
    bool anisotropy = false;                ///< enabled
    bool debugUtils = false;                ///< enabled
    bool storesImages = true;               ///< of all formats
    uint64_t memory = uint64_t(64) << 30U;  ///< bytes; more is VK_ERROR_OUT_OF_DEVICE_MEMORY
    uint32_t maxImageSide = 16384;          ///< limits::maxImageDimension2D
    uint32_t maxStorageBuffer = 1U << 30U;  ///< limits::maxStorageBufferRange
};
void setDevice(const Device& device);

/// Complete and right. Its pointers are valid for ever.
RefletContextInfo contextInfo();

/// The call that makes or allocates something fails that is the `which`th from now on, once; 0: none does.
void failCall(uint64_t which, VkResult result);
/// Calls that can tell VK_ERROR_DEVICE_LOST do so while this is true.
void lose(bool lost);

/// A command buffer for one frame. What is recorded into it is in use until the device has finished it.
VkCommandBuffer beginCommands();
/// The device has executed it, or it is never submitted. It must not be recorded into any more.
void finishCommands(VkCommandBuffer commands);

/// A handle of the host's, which the driver does not follow.
template <class T>
T hostHandle(uint64_t number) {
    return reinterpret_cast<T>(2 * number + 1);  // objects of the driver are at even addresses
}

}  // namespace reflet::stub
