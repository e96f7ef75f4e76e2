// Records the passes of a frame: binds by name, checks against the shader, sets the barriers that the stated reads
// and writes ask for, times every pass on the device, and owns the images that live from pass to pass.
#pragma once

#include "gpu/pass.h"
#include "gpu/resource.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::gpu {

class Device;

/// Device time of one pass in milliseconds; passes of one name are summed.
struct PassTime {
    std::string name;
    double ms = 0.0;
    /// Of the images and buffers that it binds, each counted once: the least that it moves if it reads or writes all of
    /// them. What the draws of a raster pass bind themselves (vertices, textures of materials) is not in it.
    uint64_t bytes = 0;
    bool raster = false;  ///< draws triangles
};

/// An image of this frame and the same of the last one.
struct History {
    Image previous;
    Image next;
    bool valid = false;  ///< false: `previous` holds nothing yet (first frame, or a new size)
};

/// A copy of an image on its way to the host.
struct Readback {
    size_t index = 0;
};

class Frame {
public:
    explicit Frame(Device& device);
    ~Frame();
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    /// Starts recording. The frame before must have been waited for.
    void begin();
    /// Submits what was recorded.
    void submit();
    /// Returns when the device is done; times and read-backs are there then.
    void wait();

    Pass compute(std::string_view name, std::string_view shader);
    Pass raster(std::string_view name, std::vector<std::string> shaders);
    /// Overwrites the start of a buffer (at most 64 KiB, a multiple of 4 bytes).
    void update(BufferView buffer, std::span<const std::byte> bytes);

    /// What was written to the buffer is there for draws that follow, which bind it as vertices.
    void readByDraws(BufferView buffer);

    /// Fills a colour image with zeros.
    void clear(Image image);

    /// An image that passes write with imageStore and read. The same name gives the same image, from frame to frame;
    /// what it held before is lost. More than one layer, or `array`: an array view.
    Image image(std::string_view name, VkFormat format, uvec2 size, uint32_t layers = 1, bool array = false);
    /// An image that draws write to (colour or depth) and passes read.
    Image target(std::string_view name, VkFormat format, uvec2 size);
    /// A storage buffer, also good for indirect arguments.
    BufferView buffer(std::string_view name, VkDeviceSize size);
    /// Two images that change places each frame.
    History history(std::string_view name, VkFormat format, uvec2 size);
    /// No history is valid in the next frame, as if it were the first.
    void forgetHistories();

    /// Copies an image of one layer for the host to read after `wait`.
    Readback readback(Image image);
    /// Rows from the top, tightly packed.
    [[nodiscard]] std::span<const std::byte> bytes(Readback readback) const;

    /// Names of passes recorded while it lives get a prefix: "diffuse." + "trace_screen".
    class Scope {
    public:
        Scope(Frame& frame, std::string_view prefix, bool images);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        Frame& frame_;
        size_t passes_;
        size_t images_;
    };
    [[nodiscard]] Scope scope(std::string_view prefix) { return {*this, prefix, false}; }
    /// And so do names of images, buffers and histories: for another view, whose images leave the first one's alone.
    [[nodiscard]] Scope viewScope(std::string_view prefix) { return {*this, prefix, true}; }

    /// Of the last frame waited for, in the order of recording. The first is "frame": from start to end.
    [[nodiscard]] const std::vector<PassTime>& passTimes() const { return times_; }
    /// Of the last frame waited for, milliseconds by the host's clock from its submission until it was known to be
    /// done.
    [[nodiscard]] double submittedMs() const { return submittedMs_; }

    [[nodiscard]] Device& device() { return device_; }

private:
    friend class Pass;

    struct Uses;
    struct UniformSlice {
        VkBuffer buffer;
        VkDeviceSize offset;
    };

    /// `pass` says all but the time.
    void beginTimer(const PassTime& pass);
    void endTimer();
    void readTimers();
    UniformSlice uploadUniform(std::span<const std::byte> bytes);
    VkDescriptorSet allocateSet(VkDescriptorSetLayout layout);
    Image transient(std::string_view name, const ImageInfo& info);

    Device& device_;
    VkCommandPool commandPool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptorPool_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    uint64_t serial_ = 0;
    uint64_t number_ = 0;
    std::string passPrefix_;
    std::string imagePrefix_;

    std::map<std::string, Texture, std::less<>> images_;
    std::map<std::string, Buffer, std::less<>> buffers_;
    struct HistoryPair {
        Texture textures[2];
        uint64_t lastUse = 0;
        uint32_t current = 0;
        bool valid = false;  ///< in the frame of the last use, however often it is asked for in it
    };
    std::map<std::string, HistoryPair, std::less<>> histories_;

    Buffer uniforms_;
    VkDeviceSize uniformsUsed_ = 0;
    std::vector<Buffer> readbacks_;
    size_t readbacksUsed_ = 0;
    std::vector<PassTime> timed_;  ///< in this frame, still without their times
    std::vector<PassTime> times_;
    std::chrono::steady_clock::time_point submitted_;
    double submittedMs_ = 0.0;
};

}  // namespace reflet::gpu
