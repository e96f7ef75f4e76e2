// Records the passes of a frame into a command buffer that it is given: binds resources by name and checks them against
// the shader, derives barriers from the declared reads and writes, times every pass on the device, and owns the images
// that persist between passes. It never submits or waits.
#pragma once

#include "gpu/pass.h"
#include "gpu/resource.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace reflet::gpu {

class Context;

/// Device time of one pass in milliseconds; passes of the same name are summed.
struct PassTime {
    std::string name;
    double ms = 0.0;
    /// Size of the bound images and buffers, each counted once: the least memory traffic if the pass reads or writes
    /// all of them. Excludes what draws bind themselves (vertices, textures of materials).
    uint64_t bytes = 0;
    bool raster = false;  ///< draws triangles
};

/// A double-buffered image: this frame's and the last frame's.
struct History {
    Image previous;
    Image next;
    bool valid = false;  ///< false: `previous` has no content (first frame, or a new size)
};

/// Handle of an image copy to the host.
struct Readback {
    size_t index = 0;
};

class Recorder {
public:
    static constexpr uint32_t maxFramesInFlight = 4;

    /// framesInFlight: 1 to maxFramesInFlight.
    explicit Recorder(Context& context, uint32_t framesInFlight = 1);
    /// The device must have finished all frames.
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Starts a frame: everything up to end() is recorded into `commands`, outside of render passes. The device must
    /// have finished the frame that was begun `framesInFlight` frames before; its times and read-backs are available
    /// from now on. Frames must be submitted in the order in which they begin.
    void begin(VkCommandBuffer commands);
    /// Ends the frame. The command buffer may record on: none of the bound pipelines and descriptor sets is kept.
    void end();
    /// The device has finished all frames begun so far: frees what only they used; times and read-backs of the last one
    /// are available.
    void finish();

    Pass compute(std::string_view name, std::string_view shader);
    Pass raster(std::string_view name, std::vector<std::string> shaders);
    /// Overwrites the start of a buffer (a multiple of 4 bytes).
    void update(BufferView buffer, std::span<const std::byte> bytes);

    /// Makes writes to the buffer visible to later draws that bind it as a vertex buffer.
    void readByDraws(BufferView buffer);

    /// Fills a colour image with zeros.
    void clear(Image image);

    /// A storage image, also sampled. The same name returns the same image in every frame; its contents are undefined
    /// unless `holds` says otherwise. With several layers, or `array`: an array view.
    Image image(std::string_view name, VkFormat format, uvec2 size, uint32_t layers = 1, bool array = false);
    /// A render target (colour or depth), also sampled.
    Image target(std::string_view name, VkFormat format, uvec2 size);
    /// A storage buffer, also usable for indirect arguments.
    BufferView buffer(std::string_view name, VkDeviceSize size);
    /// Two images that swap every frame.
    History history(std::string_view name, VkFormat format, uvec2 size);
    /// Whether the image (of `image` or `target`) still holds what an earlier frame wrote under the same key, and does
    /// not have to be written again. If not, the caller must write all of it, which makes it valid for this key. Keys
    /// hold everything that the contents depend on; their types have no padding.
    template <class T>
    bool holds(Image image, const T& key) {
        static_assert(std::is_trivially_copyable_v<T>);
        return holds(image, std::as_bytes(std::span(&key, 1)));
    }
    bool holds(Image image, std::span<const std::byte> key);
    /// Invalidates all histories, as before the first frame, and the contents of all images.
    void invalidateHistories();

    /// Copies a single-layer image for the host to read once the frame is finished.
    Readback readback(Image image);
    /// Of the last frame that the device has finished: rows from the top, tightly packed.
    [[nodiscard]] std::span<const std::byte> bytes(Readback readback) const;

    /// While it lives, names of recorded passes get a prefix: "diffuse." + "trace_screen".
    class Scope {
    public:
        Scope(Recorder& recorder, std::string_view prefix, bool images);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        Recorder& recorder_;
        size_t passes_;
        size_t images_;
    };
    [[nodiscard]] Scope scope(std::string_view prefix) { return {*this, prefix, false}; }
    /// The same, and prefixes the names of images, buffers and histories, too: for another view, whose images must not
    /// alias those of the first.
    [[nodiscard]] Scope viewScope(std::string_view prefix) { return {*this, prefix, true}; }

    /// Pass times of the last frame that the device has finished, in recording order. The first entry, "frame", is from
    /// start to end.
    [[nodiscard]] const std::vector<PassTime>& passTimes() const { return times_; }

    [[nodiscard]] Context& context() { return context_; }

private:
    friend class Pass;

    struct UniformSlice {
        VkBuffer buffer;
        VkDeviceSize offset;
    };
    // What one frame in flight needs for itself.
    struct Slot {
        uint64_t serial = 0;  ///< of its work; 0: none that is unfinished
        Buffer uniforms;
        VkDeviceSize uniformsUsed = 0;
        std::vector<VkDescriptorPool> descriptorPools;
        size_t descriptorPool = 0;  ///< that sets are allocated from now
        VkQueryPool queries = VK_NULL_HANDLE;
        std::vector<Buffer> readbacks;
        size_t readbacksUsed = 0;
        std::vector<PassTime> timed;  ///< times not yet read
    };

    /// `pass`: everything but the time.
    void beginTimer(const PassTime& pass);
    void endTimer();
    void readTimers(Slot& slot);
    void finish(Slot& slot);
    UniformSlice uploadUniform(std::span<const std::byte> bytes);
    VkDescriptorSet allocateSet(VkDescriptorSetLayout layout);
    Image transient(std::string_view name, const ImageInfo& info);
    [[nodiscard]] Slot& slot() { return slots_[number_ % slots_.size()]; }

    Context& context_;
    std::vector<Slot> slots_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;  ///< null between frames
    uint64_t number_ = 0;                        ///< of the frame, counts from 1
    size_t finished_ = 0;                        ///< slot of the last frame that the device has finished
    std::string passPrefix_;
    std::string imagePrefix_;

    std::map<std::string, Texture, std::less<>> images_;
    std::map<std::string, Buffer, std::less<>> buffers_;
    struct HistoryPair {
        Texture textures[2];
        uint64_t lastUse = 0;
        uint32_t current = 0;
        bool valid = false;  ///< in the frame of the last use, however often it is requested
    };
    std::map<std::string, HistoryPair, std::less<>> histories_;
    std::vector<PassTime> times_;
};

}  // namespace reflet::gpu
