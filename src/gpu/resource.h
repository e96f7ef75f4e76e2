// Images and buffers on a device. Owners (Texture, Buffer) are move-only; their destruction is deferred until the
// device has finished using them. Passes take small copyable views (Image, BufferView).
#pragma once

#include "base/math.h"
#include "gpu/memory.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace reflet::gpu {

class Context;

/// Synchronization state of a resource on the queue: what its next use must wait for.
struct AccessState {
    VkPipelineStageFlags2 writeStages = 0;
    VkAccessFlags2 writeAccess = 0;
    VkPipelineStageFlags2 readStages = 0;     ///< since the last write
    VkPipelineStageFlags2 visibleStages = 0;  ///< stages to which the last write is visible
    VkAccessFlags2 visibleAccess = 0;

    bool operator==(const AccessState&) const = default;
};

/// Index of a resource in the list of passes that uses it; written by that list only.
struct ListMark {
    const void* owner = nullptr;  ///< the recorder
    uint64_t list = 0;            ///< number of the list; 0: none yet
    uint32_t index = 0;           ///< among the list's resources
};

struct HeldImage;

/// State shared by all views of an image. Handles of transient images are null until their passes are recorded.
struct ImageState {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;  ///< all of its mips and layers
    std::vector<VkImageView> mips;      ///< each as a 2D array of all layers; may be empty
    uint64_t id = 0;                    ///< unique in this process, never reused; 0: a host's image
    std::string name;                   ///< only of images with an owner; the recorder has names of transient images
    VkDeviceSize bytes = 0;             ///< size of its memory, if it has an owner
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    AccessState access;
    ListMark mark;
    HeldImage* held = nullptr;  ///< the held image that this state belongs to; none for other images
    int32_t transient = -1;     ///< index among the transient images of its recorder; negative: it has an owner
    bool unused = false;        ///< PassList::placeholder: no shader uses its contents
    uvec2 origin{0};            ///< external: the first pixel of the rectangle that passes use
    bool external = false;      ///< its owner records the barriers; passes sample it, in `layout`, or write it
};

struct BufferState {
    VkBuffer buffer = VK_NULL_HANDLE;
    uint64_t id = 0;  ///< this and the following as in ImageState
    std::string name;
    VkDeviceSize bytes = 0;
    AccessState access;
    ListMark mark;
    int32_t transient = -1;
};

/// Returns a new ImageState::id or BufferState::id.
uint64_t nextResourceId();

/// Type of the view that shaders get.
enum class ViewKind : uint8_t {
    byLayers,   ///< 2D for one layer, otherwise a 2D array
    array,      ///< a 2D array, even with one layer
    cube,       ///< six layers: +X, -X, +Y, -Y, +Z, -Z
    cubeArray,  ///< six layers per cube
};

struct ImageInfo {
    VkFormat format = VK_FORMAT_UNDEFINED;
    uvec2 size{0};
    uint32_t mips = 1;
    uint32_t layers = 1;
    VkImageUsageFlags usage = 0;
    ViewKind view = ViewKind::byLayers;

    bool operator==(const ImageInfo&) const = default;
};

/// A view of a texture: all of its mips and layers, or one mip. Valid as long as its owner. Empty: `!image`.
struct Image {
    ImageState* state = nullptr;
    int32_t level = -1;  ///< the mip level that is viewed; negative: all
    VkFormat format = VK_FORMAT_UNDEFINED;
    uvec2 size{0};
    uint32_t layers = 1;
    uint32_t mips = 1;

    explicit operator bool() const { return state != nullptr; }
    [[nodiscard]] VkImageView view() const { return level < 0 ? state->view : state->mips[static_cast<size_t>(level)]; }
};

/// A whole buffer. Valid as long as its owner.
struct BufferView {
    BufferState* state = nullptr;
    VkDeviceSize size = 0;

    explicit operator bool() const { return state != nullptr; }
};

/// An acceleration structure (device/acceleration.h) that passes read. Valid as long as its owner. Empty: `!view`.
struct AccelerationView {
    VkAccelerationStructureKHR structure = VK_NULL_HANDLE;

    explicit operator bool() const { return structure != VK_NULL_HANDLE; }
};

/// The depth aspect for depth formats, colour for all others.
VkImageAspectFlags aspectOf(VkFormat format);
/// Bytes per texel, for the formats that the renderer uses.
uint32_t bytesPerTexel(VkFormat format);
/// Bytes of all texels of a view.
uint64_t bytesOf(const Image& image);

/// Creates an image without memory, for its owner. Throws Error for a size that the device does not support.
VkImage makeImage(Context& context, const ImageInfo& info, const std::string& name);
/// Creates the views of an image that is bound to memory: state.view and, for storage images with several mips and for
/// cubes, state.mips.
void makeViews(Context& context, const ImageInfo& info, ImageState& state);
void destroyImage(Context& context, const ImageState& state);

class Texture {
public:
    Texture() = default;
    /// `name` appears in messages.
    Texture(Context& context, const ImageInfo& info, const std::string& name);
    ~Texture();
    Texture(Texture&& other) noexcept;
    Texture& operator=(Texture&& other) noexcept;
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    [[nodiscard]] const ImageInfo& info() const { return info_; }
    [[nodiscard]] Image image() const { return {state_.get(), -1, info_.format, info_.size, info_.layers, info_.mips}; }
    /// One mip level as a 2D array of all layers (cubes: their faces), for passes that write it. Only for textures with
    /// storage usage and more than one mip, or a cube view.
    [[nodiscard]] Image mip(uint32_t level) const;

private:
    void retire();

    Context* context_ = nullptr;
    ImageInfo info_;
    std::shared_ptr<ImageState> state_;  ///< also referenced by passes that are not recorded yet
    Allocation allocation_;
};

class Buffer {
public:
    Buffer() = default;
    Buffer(Context& context, VkDeviceSize size, VkBufferUsageFlags usage, MemoryUse use, const std::string& name);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    [[nodiscard]] BufferView view() const { return {state_.get(), size_}; }
    [[nodiscard]] VkBuffer handle() const { return state_->buffer; }
    /// Mapped memory; empty for MemoryUse::device.
    [[nodiscard]] std::span<std::byte> bytes() const {
        return {allocation_.mapped, allocation_.mapped != nullptr ? size_ : 0};
    }

private:
    void retire();

    Context* context_ = nullptr;
    VkDeviceSize size_ = 0;
    std::shared_ptr<BufferState> state_;  ///< also referenced by passes that are not recorded yet
    Allocation allocation_;
};

/// A device buffer that shaders read and write, also usable for indirect arguments and copies.
Buffer storageBuffer(Context& context, VkDeviceSize size, const std::string& name);

}  // namespace reflet::gpu
