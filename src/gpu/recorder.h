// Records the passes of a frame into a command buffer that it is given: binds resources by name and checks them against
// the shader, derives barriers from the declared reads and writes, and times every pass on the device. It never submits
// or waits.
#pragma once

#include "gpu/images.h"
#include "gpu/pass.h"
#include "gpu/resource.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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
    /// from now on. Frames must be submitted in the order in which they begin. A frame that has begun and not ended,
    /// after an exception, is abandoned: its commands must not be submitted.
    void begin(VkCommandBuffer commands);
    /// Ends the frame. The command buffer may record on: none of the bound pipelines and descriptor sets is kept.
    void end();
    /// The device has finished all frames begun so far: frees what only they used; times and read-backs of the last one
    /// are available.
    void finish();

    /// Until end(), instead of begin(): nothing is recorded, and the pipelines that the passes need and the context
    /// does not have yet are added to `missing`. Images and buffers are made as in a frame; histories stay as they are.
    void collect(std::vector<PipelineInfo>& missing);
    [[nodiscard]] bool isCollecting() const { return missing_ != nullptr; }

    Pass compute(std::string_view name, std::string_view shader);
    Pass raster(std::string_view name, std::vector<std::string> shaders);
    /// Overwrites the start of a buffer (a multiple of 4 bytes).
    void update(BufferView buffer, std::span<const std::byte> bytes);

    /// Makes writes to the buffer visible to later draws that bind it as a vertex buffer.
    void readByDraws(BufferView buffer);

    /// Fills a colour image with a value, zeros by default.
    void clear(Image image, const VkClearColorValue& value = {});

    /// Overwrites all of a single-layer image's first level. texels: rows from the top, tightly packed.
    void upload(Image image, std::span<const std::byte> texels);

    /// Copies the first level of a single-layer image to one of the same format and size.
    void copy(Image from, Image to);

    /// Images and buffers for the rest of this frame, and until the next one begins. Their contents are undefined at
    /// first. image: a storage image, also sampled; with several layers, or `array`: an array view. target: a render
    /// target (colour or depth), also sampled. buffer: a storage buffer, also for indirect arguments.
    Image image(std::string_view name, VkFormat format, uvec2 size, uint32_t layers = 1, bool array = false);
    Image target(std::string_view name, VkFormat format, uvec2 size);
    BufferView buffer(std::string_view name, VkDeviceSize size);

    /// An image of one texel, to bind where a shader does not use what it declares; `array`: an array view.
    Image placeholder(VkFormat format, ViewKind view = ViewKind::byLayers);

    /// Counts frames from 1.
    [[nodiscard]] uint64_t number() const { return number_; }
    /// Counts calls of forget().
    [[nodiscard]] uint64_t generation() const { return generation_; }
    /// Invalidates all histories, as before the first frame, and the contents of all kept images.
    void forget() { ++generation_; }

    /// Copies a single-layer image for the host to read once the frame is finished.
    Readback readback(Image image);
    /// Of the last frame that the device has finished: rows from the top, tightly packed.
    [[nodiscard]] std::span<const std::byte> bytes(Readback readback) const;

    /// While it lives, names of recorded passes get a prefix: "diffuse." + "trace_screen".
    class Scope {
    public:
        Scope(Recorder& recorder, std::string_view prefix);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        Recorder& recorder_;
        size_t before_;
    };
    [[nodiscard]] Scope scope(std::string_view prefix) { return {*this, prefix}; }
    /// The name with the prefix of the scope.
    [[nodiscard]] std::string nameOf(std::string_view name) const { return prefix_ + std::string(name); }

    /// Pass times of the last frame that the device has finished, in recording order. The first entry, "frame", is from
    /// start to end.
    [[nodiscard]] const std::vector<PassTime>& passTimes() const { return times_; }

    [[nodiscard]] Context& context() { return context_; }

protected:
    /// Called after each recorded pass; the command buffer must be in the recording state when it returns. If it
    /// throws, the frame is abandoned as after any exception. Empty: nothing is called.
    void betweenPasses(std::function<void()> call) { betweenPasses_ = std::move(call); }

private:
    friend class Pass;
    friend class Scratch;

    struct WithoutSlots {};
    Recorder(Context& context, WithoutSlots /*tag*/) : context_(context) {}

    struct UniformSlice {
        VkBuffer buffer;
        VkDeviceSize offset;
    };
    // What one frame in flight needs for itself.
    struct Slot {
        uint64_t serial = 0;            ///< of its work; 0: none that is unfinished
        std::vector<Buffer> uniforms;   ///< blocks, filled in turn
        size_t uniformBlock = 0;        ///< that is filled now
        VkDeviceSize uniformsUsed = 0;  ///< of that block
        std::vector<VkDescriptorPool> descriptorPools;
        size_t descriptorPool = 0;         ///< that sets are allocated from now
        std::vector<VkQueryPool> queries;  ///< blocks, filled in turn
        std::vector<Buffer> readbacks;
        size_t readbacksUsed = 0;
        std::vector<PassTime> timed;  ///< times not yet read
    };

    /// Whether no passes are recorded now; notes the pipeline if it is missing.
    bool collects(const PipelineInfo& info);
    /// `pass`: everything but the time.
    void beginTimer(const PassTime& pass);
    void endTimer();
    void readTimers(Slot& slot);
    void finish(Slot& slot);
    UniformSlice uploadUniform(std::span<const std::byte> bytes);
    VkDescriptorSet allocateSet(VkDescriptorSetLayout layout);
    // The pool that scratch images and buffers come from and return to. Unused ones are destroyed after two frames.
    struct PooledImage {
        Texture texture;  ///< none: the place is free
        bool taken = false;
        uint64_t lastUse = 0;
    };
    struct PooledBuffer {
        Buffer buffer;
        bool taken = false;
        uint64_t lastUse = 0;
    };
    size_t takeImage(const ImageInfo& info);
    size_t takeBuffer(VkDeviceSize size);
    [[nodiscard]] Image pooledImage(size_t index) const { return pooledImages_[index].texture.image(); }
    [[nodiscard]] BufferView pooledBuffer(size_t index) const { return pooledBuffers_[index].buffer.view(); }
    void giveBack(std::span<const size_t> images, std::span<const size_t> buffers);
    void dropUnused();
    /// The block and index of a timestamp of the last pass; makes the block.
    std::pair<VkQueryPool, uint32_t> timestamp(uint32_t which);
    [[nodiscard]] Slot& slot() { return slots_[number_ % slots_.size()]; }

    Context& context_;
    std::function<void()> betweenPasses_;
    std::vector<Slot> slots_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;  ///< null between frames
    std::vector<PipelineInfo>* missing_ = nullptr;
    uint64_t number_ = 0;  ///< of the frame, counts from 1
    size_t finished_ = 0;  ///< slot of the last frame that the device has finished
    uint64_t generation_ = 0;
    std::string prefix_;
    std::vector<PooledImage> pooledImages_;
    std::vector<PooledBuffer> pooledBuffers_;
    std::vector<size_t> frameImages_;   ///< taken for this frame
    std::vector<size_t> frameBuffers_;  ///< taken for this frame
    std::map<std::pair<VkFormat, ViewKind>, Texture> placeholders_;
    std::vector<PassTime> times_;
};

}  // namespace reflet::gpu
