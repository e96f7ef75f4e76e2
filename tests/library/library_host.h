// A host of the C API: a device, images with content, and frames of a room that nobody drew.
#pragma once

#include "base/math.h"
#include "pass/host.h"

#include "reflet/reflet.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace reflet::test {

/// An image of the host.
struct HostImage {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    RefletImage told{};  ///< as the library is told
};

/// A buffer in memory that the host reads and writes.
class HostBuffer {
public:
    HostBuffer(const gpu::OpenDevice& open, size_t bytes, VkBufferUsageFlags usage);
    ~HostBuffer();
    HostBuffer(const HostBuffer&) = delete;
    HostBuffer& operator=(const HostBuffer&) = delete;

    VkBuffer buffer = VK_NULL_HANDLE;
    void* mapped = nullptr;

private:
    VkDevice device_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
};

/// A barrier from what wrote the buffer.
void waitFor(VkCommandBuffer commands, const RefletBuffer& buffer, VkPipelineStageFlags2 stages, VkAccessFlags2 access);

/// Opens a device with the features that the library needs, and counts what is made on it through `lookUp`.
class LibraryHost {
public:
    LibraryHost();
    ~LibraryHost();
    LibraryHost(const LibraryHost&) = delete;
    LibraryHost& operator=(const LibraryHost&) = delete;

    /// Complete and right; tests spoil it.
    [[nodiscard]] RefletContextInfo contextInfo() const;
    /// Fails the test on an error.
    [[nodiscard]] RefletContext makeContext() const;

    /// texels: rows from the top, tightly packed; layers one after the other. Layout GENERAL.
    RefletImage makeImage(VkFormat format, uint32_t width, uint32_t height, const void* texels, size_t bytes,
                          uint32_t layers = 1, VkImageUsageFlags more = 0);
    template <class T>
    RefletImage makeImage(VkFormat format, uint32_t width, uint32_t height, const std::vector<T>& texels) {
        return makeImage(format, width, height, texels.data(), texels.size() * sizeof(T));
    }
    /// faces: in Vulkan's order, each as texels of makeImage. The view is that of a cube.
    RefletImage makeCube(VkFormat format, uint32_t side, const void* faces, size_t bytes);
    template <class T>
    RefletImage makeCube(VkFormat format, uint32_t side, const std::vector<T>& faces) {
        return makeCube(format, side, faces.data(), faces.size() * sizeof(T));
    }
    /// Of one layer of an image of makeImage.
    VkImageView layerView(const RefletImage& image, uint32_t layer);
    void setLayout(const RefletImage& image, uint32_t layer, VkImageLayout from, VkImageLayout to);
    /// Of an image of makeImage with four floats a texel.
    [[nodiscard]] std::vector<vec4> texelsOfInput(const RefletImage& image);
    /// Of a result, after all frames are done.
    std::vector<std::byte> read(const RefletImage& image, size_t bytesPerTexel);

    /// What the library has made so far on this device.
    struct Made {
        uint64_t pipelines = 0;
        uint64_t allocations = 0;
        uint64_t images = 0;
        uint64_t pools = 0;

        bool operator==(const Made&) const = default;
    };
    static Made& made();

    Host host;

private:
    VkPhysicalDeviceFeatures2 features_{};
    VkPhysicalDeviceVulkan12Features v12_{};
    VkPhysicalDeviceVulkan13Features v13_{};
    std::vector<HostImage> images_;
    std::vector<VkImageView> layerViews_;
};

/// How a host means its G-buffer.
struct RoomConventions {
    bool spoiled = false;  ///< infinity, NaN, 65504 and negative values in every image
    bool unusual = false;  ///< standard depth, y up, view-space unorm normals, sRGB, alpha, pixels before minus now
    uvec2 drawn{0};        ///< RefletFrameInfo::renderSize; images are as large as ever, and NaN around that. 0: all
    vec2 jitter{0.0F};     ///< pixels
    bool still = false;    ///< nothing moves; otherwise motion vectors say that all does
    uvec2 border{0};       ///< images of the frame have NaN around it, so many pixels wide on each side
};

/// A floor, a wall and sky, from analytic rays.
class HostRoom {
public:
    static constexpr uint32_t width = 64;
    static constexpr uint32_t height = 40;

    HostRoom(LibraryHost& host, RoomConventions conventions);

    /// Both refer to the room.
    [[nodiscard]] RefletFrameInfo frame(VkCommandBuffer commands, uint32_t index) const;
    [[nodiscard]] RefletIndirectLight light() const;
    [[nodiscard]] RefletSunShadow sun() const;

private:
    RefletFrameInfo info_{};
    RefletGBuffer gbuffer_{};
    RefletEnvironment environment_{};
    RefletImage lit_{};
    RefletImage shadowMap_{};
};

/// For the library to fill.
inline RefletLobe emptyLobe() {
    RefletLobe lobe{};
    lobe.structSize = sizeof lobe;
    return lobe;
}

/// Results of all effects in one frame.
struct RoomResults {
    RefletImage visibility{};
    RefletImage occlusion{};  ///< none with ao.method=none
    RefletLobe diffuse = emptyLobe();
    RefletLobe specular = emptyLobe();
    RefletComposite sum{};
    RefletImage antialiased{};
    RefletImage defocused{};  ///< focused 3 m away
    RefletImage display{};
};

/// Records all effects. Fails the test on an error.
RoomResults recordRoom(const HostRoom& room, RefletView view, RefletSettings settings, VkCommandBuffer commands,
                       uint32_t index);
/// frame: of the room, as tests have changed it.
RoomResults recordRoom(const HostRoom& room, const RefletFrameInfo& frame, RefletView view, RefletSettings settings);

/// Asserts success, and prints the library's text otherwise.
#define EXPECT_REFLET(call) EXPECT_EQ(call, REFLET_SUCCESS) << refletLastError()

}  // namespace reflet::test
