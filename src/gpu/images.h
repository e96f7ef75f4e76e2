// Images and buffers that effects keep from frame to frame: members of a struct that the caller owns, one for each
// instance of the effect. Images of a single frame come from the list of passes (PassList::image).
//
// Each is created on first request, and recreated when requested with another format or size: from the second frame
// with the same settings and size on, nothing is created.
#pragma once

#include "gpu/resource.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace reflet::gpu {

class PassList;

/// A double-buffered image: this frame's and the last frame's.
struct History {
    Image previous;
    Image next;
    bool valid = false;  ///< false: `previous` has no content (first frame, or a new size)
};

/// How the content of a history is resampled when the frame size changes.
enum class Resample : uint8_t {
    never,         ///< not resampled: another size invalidates the history
    linear,        ///< for values that may be averaged: radiance, moments
    nearest,       ///< for packed values, and values that belong to one surface
    depthInRed,    ///< nearest, for packed values; but red is depth as bits of a float, which follows the surface
    depthInGreen,  ///< the same with green
};

/// Frame sizes for dynamic resolution: histories are kept when the size changes.
struct FrameSizes {
    uvec2 before{0};   ///< size of the last frame, in pixels
    uvec2 now{0};      ///< size of this frame
    uvec2 largest{0};  ///< largest size of all future frames: histories have memory for it
    /// Lists a pass that resamples an image into another one of the same format, with the same uv. None: another size
    /// invalidates histories.
    void (*rescale)(PassList& f, const Image& from, const Image& to, Resample resample) = nullptr;
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
    Image storage(PassList& f, VkFormat format, uvec2 size, uint32_t layers = 1, bool array = false);
    /// A render target (colour or depth), also sampled.
    Image target(PassList& f, VkFormat format, uvec2 size);

    /// Whether the image still holds what an earlier frame wrote under the same key, and does not have to be written
    /// again. If not, the caller must write all of it, which makes it valid for this key. Keys hold everything that the
    /// contents depend on; their types have no padding.
    template <class T>
    bool holds(PassList& f, const T& key) {
        static_assert(std::is_trivially_copyable_v<T>);
        return holds(f, std::as_bytes(std::span(&key, 1)));
    }
    bool holds(PassList& f, std::span<const std::byte> key);

    /// The image of the last call; none before the first.
    [[nodiscard]] Image last() const { return texture_.info().size.x > 0 ? texture_.image() : Image{}; }

private:
    Image get(PassList& f, const ImageInfo& info);

    std::string_view name_;
    Texture texture_;
    std::vector<std::byte> contents_;  ///< key of the contents; empty: none
    uint64_t generation_ = 0;          ///< PassList::generation() when the contents were written
    uint64_t list_ = 0;                ///< number of the list whose passes write them
};

/// A storage buffer, also usable for indirect arguments.
class KeptBuffer {
public:
    explicit KeptBuffer(std::string_view name) : name_(name) {}

    BufferView get(PassList& f, VkDeviceSize size);
    /// Whether the buffer has its contents: false once after creation, or if the list that should have written it was
    /// not recorded. Then the caller must write all of it.
    bool holds(PassList& f);

private:
    std::string_view name_;
    Buffer buffer_;
    bool written_ = false;
    uint64_t list_ = 0;  ///< number of the list that writes it
};

/// Two storage images that swap every frame. Their memory is aliased by other images of the frame after the last pass
/// that reads `previous`, and before the first that writes `next`: after a list that has used `next`, later lists of
/// the frame must not read `previous`.
///
/// When the frame size changes (PassList::setSizes), the last frame's contents are resampled into the image that would
/// be `next`, and the two change places: no memory is needed for a third image.
class HistoryImage {  // NOLINT(bugprone-reserved-identifier): of the assignment that the compiler makes
public:
    explicit HistoryImage(std::string_view name) : name_(name) {}

    /// Returns the same pair on every call within a frame. `previous` has no content after a frame without a call.
    /// resample: for histories of the frame's size, or of a fraction of it.
    History swap(PassList& f, VkFormat format, uvec2 size, Resample resample = Resample::never);

private:
    void make(PassList& f, const ImageInfo& info, Resample resample);
    bool show(PassList& f, const ImageInfo& info);
    void rescale(PassList& f, Resample resample);
    [[nodiscard]] Image shown(uint32_t i) const;

    std::string_view name_;
    std::shared_ptr<HeldImage> images_[2];
    Image from_;                ///< the image that was resampled last
    uint64_t rescaleList_ = 0;  ///< number of the list with the resampling pass; 0: none
    uint64_t lastUse_ = 0;
    uint64_t generation_ = 0;
    uint32_t current_ = 0;
    bool valid_ = false;  ///< History::valid in the frame of the last use
};

}  // namespace reflet::gpu
