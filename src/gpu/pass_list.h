// The passes of a frame as a list of values (a frame graph). Effects append to it; nothing is recorded, and no
// transient image has memory, before the whole list is known (gpu/recorder.h).
#pragma once

#include "gpu/images.h"
#include "gpu/pass.h"
#include "gpu/transient_memory.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace reflet::gpu {

class Context;

/// Handle of an image copy to the host.
struct Readback {
    size_t index = 0;
};

class PassList {
public:
    explicit PassList(Context& context) : context_(context), memory_(context) {}
    ~PassList() = default;
    PassList(const PassList&) = delete;
    PassList& operator=(const PassList&) = delete;

    ComputePass compute(std::string_view name, std::string_view shader);
    RasterPass raster(std::string_view name, std::initializer_list<std::string_view> shaders);
    /// Overwrites the start of a buffer (a multiple of 4 bytes). The bytes are copied now.
    void update(BufferView buffer, std::span<const std::byte> bytes);

    /// Later draws of this frame bind the buffer as a vertex buffer, and see the writes of passes.
    void readByDraws(BufferView buffer) { drawnBuffers_.push_back(buffer); }

    /// Fills a colour image with a value, zeros by default.
    void clear(Image image, const VkClearColorValue& value = {});

    /// Overwrites all of a single-layer image's first level. texels: rows from the top, tightly packed, copied now.
    void upload(Image image, std::span<const std::byte> texels);

    /// Copies the first level of a single-layer image to one of the same format and size.
    void copy(Image from, Image to);

    /// Copies a single-layer image for the host to read once the frame is finished.
    Readback readback(Image image);

    /// Transient images and buffers: their contents are undefined at first, and lost after the last pass of the list
    /// that uses them, as their memory is aliased. image: a storage image, also sampled; with several layers, or
    /// `array`: an array view. target: a render target (colour or depth), also sampled. buffer: a storage buffer, also
    /// for indirect arguments.
    Image image(std::string_view name, VkFormat format, uvec2 size, uint32_t layers = 1, bool array = false);
    Image target(std::string_view name, VkFormat format, uvec2 size);
    BufferView buffer(std::string_view name, VkDeviceSize size);
    /// Keeps the contents until the next frame begins: for results of the frame. Passes that write a kept resource are
    /// never culled as unused. May be none.
    void keep(Image image);
    void keep(BufferView buffer);
    /// Whether an earlier list of the frame has written the image, and it was kept.
    [[nodiscard]] bool isKept(Image image) const;
    /// Undoes keep() for a resource that an earlier list has written. May be none.
    void release(Image image);
    void release(BufferView buffer);

    /// An image whose memory is aliased while its contents are not needed: for HistoryImage.
    std::shared_ptr<HeldImage> hold(const ImageInfo& info, const std::string& name) { return memory_.hold(info, name); }
    /// Uses its memory for an image of another size. Returns false if that does not fit.
    bool show(HeldImage& held, const ImageInfo& info) { return memory_.show(held, info, number_); }

    /// An image of one texel, for a binding that a shader declares but does not use.
    Image placeholder(VkFormat format, ViewKind view = ViewKind::byLayers);

    /// Counts frames from 1.
    [[nodiscard]] uint64_t number() const { return number_; }
    /// Counts calls of forget().
    [[nodiscard]] uint64_t generation() const { return generation_; }
    /// Invalidates all histories, as before the first frame, and the contents of all kept images.
    void forget() { ++generation_; }
    /// Sets the frame sizes from now on; histories are resampled when they change.
    void setSizes(const FrameSizes& sizes) { sizes_ = sizes; }
    [[nodiscard]] const FrameSizes& sizes() const { return sizes_; }
    /// Number of the list that passes are appended to now.
    [[nodiscard]] uint64_t listNumber() const { return list_; }
    /// Whether the passes of that list were never recorded, so that their results do not exist.
    [[nodiscard]] bool isDiscarded(uint64_t list) const;
    /// Notes that passes of this list will write contents that an owner already counts as written (KeptImage::holds).
    void promise() { promised_ = true; }

    /// Prefixes pass names during its lifetime: "diffuse." + "trace_screen".
    class Scope {
    public:
        Scope(PassList& list, std::string_view prefix);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        PassList& list_;
        size_t before_;
    };
    [[nodiscard]] Scope scope(std::string_view prefix) { return {*this, prefix}; }
    /// The name with the prefix of the scope.
    [[nodiscard]] std::string nameOf(std::string_view name) const { return prefix_ + std::string(name); }

    [[nodiscard]] Context& context() { return context_; }

protected:
    friend class Pass;
    friend class RasterPass;

    /// An image that lives in one frame.
    struct TransientImage {
        ImageState state;
        ImageInfo info;
        std::string_view name;
        uint64_t list = 0;  ///< number of the list that it was made for
        bool kept = false;
        TransientMemory::Needs needs;  ///< of `info`; size 0: not known yet
        VkDeviceSize offset = 0;       ///< in its heap, once its list is recorded
    };
    struct TransientBuffer {
        BufferState state;
        VkDeviceSize size = 0;
        std::string_view name;
        uint64_t list = 0;
        bool kept = false;
        TransientMemory::Needs needs;
        VkDeviceSize offset = 0;  ///< as in TransientImage
    };

    /// Starts a frame.
    void clearFrame();
    /// Starts a new list without passes. recorded: the passes of the old one have been recorded.
    void nextList(bool recorded);
    [[nodiscard]] const std::vector<PassRecord*>& passes() const { return passes_; }
    TransientImage& transientOf(const ImageState& state) { return images_[static_cast<size_t>(state.transient)]; }
    TransientBuffer& transientOf(const BufferState& state) { return buffers_[static_cast<size_t>(state.transient)]; }
    [[nodiscard]] TransientMemory& memory() { return memory_; }
    [[nodiscard]] const TransientMemory& memory() const { return memory_; }

    uint64_t number_ = 0;   ///< frame number, counts from 1
    bool open_ = false;     ///< passes may be appended
    size_t readbacks_ = 0;  ///< number of readbacks in this frame

private:
    // A name with its prefix, and the records of its passes.
    struct Named {
        std::string name;
        uint32_t index = 0;
        std::vector<std::unique_ptr<PassRecord>> records;
        size_t used = 0;  ///< records used in frame `frame`
        uint64_t frame = 0;
    };
    struct Hash {
        using is_transparent = void;
        size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
    };

    Named& named(std::string_view name);
    PassRecord& record(std::string_view name, PassKind kind);
    PassRecord& shaderRecord(std::string_view name, PassKind kind, std::span<const std::string_view> shaders);
    void append(PassRecord& record) { passes_.push_back(&record); }
    void appendTransfer(PassRecord& record);
    /// Throws for transient resources of an earlier list of this frame that were not kept.
    void checkUsable(const Image& image) const;
    void freePlace(const TransientMemory::Needs& needs, VkDeviceSize offset);
    void checkUsable(const BufferView& buffer) const;
    [[nodiscard]] const std::vector<BufferView>& drawnBuffers() const { return drawnBuffers_; }
    Image transientImage(std::string_view name, const ImageInfo& info);
    /// An image like this placeholder, for one pass to bind as an output.
    Image unusedTarget(const Image& placeholder);

    Context& context_;
    TransientMemory memory_;
    FrameSizes sizes_;
    uint64_t generation_ = 0;
    uint64_t frame_ = 0;  ///< counts calls of clearFrame
    uint64_t list_ = 1;
    std::vector<uint64_t> discarded_;  ///< numbers of lists never recorded, ascending
    bool promised_ = false;
    std::string prefix_;
    std::string fullName_;  ///< scratch of named()
    std::vector<std::unique_ptr<Named>> names_;
    std::unordered_map<std::string_view, Named*, Hash, std::equal_to<>> byName_;
    std::vector<PassRecord*> passes_;
    std::deque<TransientImage> images_;
    std::deque<TransientBuffer> buffers_;
    size_t imagesUsed_ = 0;
    size_t buffersUsed_ = 0;
    std::vector<BufferView> drawnBuffers_;
    std::map<std::pair<VkFormat, ViewKind>, Texture> placeholders_;
};

}  // namespace reflet::gpu
