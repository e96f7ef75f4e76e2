// Who owns the images and buffers of effects. What an effect keeps from frame to frame, and what it returns, are
// members of a struct that its caller owns, one for each instance of the effect: KeptImage, KeptBuffer, HistoryImage.
// What it needs only while it records comes from a Scratch and goes back to the recorder, for the next effect, when
// that ends.
//
// All are made when they are first asked for, and again when they are asked for with another format or size: from the
// second frame of the same settings and size on, nothing is made.
#pragma once

#include "gpu/resource.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace reflet::gpu {

class Recorder;

/// A double-buffered image: this frame's and the last frame's.
struct History {
    Image previous;
    Image next;
    bool valid = false;  ///< false: `previous` has no content (first frame, or a new size)
};

/// A storage image, also sampled. With several layers, or `array`: an array view.
ImageInfo storageInfo(VkFormat format, uvec2 size, uint32_t layers = 1, bool array = false);
/// A render target (colour or depth), also sampled.
ImageInfo targetInfo(VkFormat format, uvec2 size);

class KeptImage {
public:
    /// name: for messages; must outlive the image.
    explicit KeptImage(std::string_view name) : name_(name) {}

    /// A storage image, also sampled. Its contents are undefined unless `holds` says otherwise. With several layers, or
    /// `array`: an array view.
    Image storage(Recorder& f, VkFormat format, uvec2 size, uint32_t layers = 1, bool array = false);
    /// A render target (colour or depth), also sampled.
    Image target(Recorder& f, VkFormat format, uvec2 size);

    /// Whether the image still holds what an earlier frame wrote under the same key, and does not have to be written
    /// again. If not, the caller must write all of it, which makes it valid for this key. Keys hold everything that the
    /// contents depend on; their types have no padding.
    template <class T>
    bool holds(const Recorder& f, const T& key) {
        static_assert(std::is_trivially_copyable_v<T>);
        return holds(f, std::as_bytes(std::span(&key, 1)));
    }
    bool holds(const Recorder& f, std::span<const std::byte> key);

    /// The image of the last call; none before the first.
    [[nodiscard]] Image last() const { return texture_.info().size.x > 0 ? texture_.image() : Image{}; }

private:
    Image get(Recorder& f, const ImageInfo& info);

    std::string_view name_;
    Texture texture_;
    std::vector<std::byte> contents_;  ///< key of the contents; empty: none
    uint64_t generation_ = 0;          ///< of the recorder, when the contents were written
};

/// A storage buffer, also usable for indirect arguments.
class KeptBuffer {
public:
    explicit KeptBuffer(std::string_view name) : name_(name) {}

    BufferView get(Recorder& f, VkDeviceSize size);

private:
    std::string_view name_;
    Buffer buffer_;
};

/// Two storage images that swap every frame.
class HistoryImage {
public:
    explicit HistoryImage(std::string_view name) : name_(name) {}

    /// The same pair however often it is asked for in a frame. `previous` has no content after a frame in which it was
    /// not asked for.
    History swap(Recorder& f, VkFormat format, uvec2 size);

private:
    std::string_view name_;
    Texture textures_[2];
    uint64_t lastUse_ = 0;
    uint64_t generation_ = 0;
    uint32_t current_ = 0;
    bool valid_ = false;  ///< in the frame of the last use
};

/// Images and buffers for as long as it lives. Their contents are undefined at first.
class Scratch {
public:
    explicit Scratch(Recorder& f) : f_(f) {}
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    /// As KeptImage::storage.
    Image storage(VkFormat format, uvec2 size, uint32_t layers = 1, bool array = false);
    /// As KeptImage::target.
    Image target(VkFormat format, uvec2 size);
    /// As KeptBuffer.
    BufferView buffer(VkDeviceSize size);

private:
    Recorder& f_;
    std::vector<size_t> images_;  ///< indices into the recorder's pool
    std::vector<size_t> buffers_;
};

}  // namespace reflet::gpu
