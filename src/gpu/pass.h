// One pass, declared where it is recorded: its inputs, outputs and parameters, by their names in the shader.
//
//     f.compute("trace_screen", "trace_screen.comp")
//         .read("depth", g.depth).read("lit", lit).write("answer", rays.answer)
//         .params(TraceScreenParams{...})
//         .dispatchIndirect(rays.list, offset);
//
// Unknown names, missing bindings, parameter blocks of the wrong size and writes to readonly resources throw a
// std::logic_error that names the pass and the binding, in every build.
#pragma once

#include "base/strips.h"
#include "gpu/pipeline.h"
#include "gpu/resource.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace reflet::gpu {

class Context;
class Recorder;

/// Passed to the callback that records the draws of a raster pass.
struct DrawCommands {
    Context& context;
    VkCommandBuffer commands;
    VkPipelineLayout layout;
};

/// How a pass accesses a resource.
struct Access {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
    bool write = false;
};

class Pass {
public:
    Pass(Recorder& recorder, std::string name, std::vector<std::string> shaders);

    Pass& read(std::string_view binding, Image image, VkSampler sampler = VK_NULL_HANDLE);
    Pass& read(std::string_view binding, BufferView buffer);
    /// The structure must have been built before this frame began.
    Pass& read(std::string_view binding, AccelerationView structure);
    /// An image that the draws' own descriptor set binds. Raster only.
    Pass& read(Image image);
    /// A pass may also read what it writes.
    Pass& write(std::string_view binding, Image image);
    Pass& write(std::string_view binding, BufferView buffer);

    /// Contents of the uniform block of that name. T must have no padding that the scalar layout of the shader would
    /// not have.
    template <class T>
    Pass& params(const T& value, std::string_view binding = "params") {
        static_assert(std::is_trivially_copyable_v<T>);
        return uniform(binding, std::as_bytes(std::span(&value, 1)));
    }
    Pass& uniform(std::string_view binding, std::span<const std::byte> bytes);

    /// Sets a specialization constant.
    Pass& constant(std::string_view name, uint32_t value);

    /// Dispatches x · y · z threads, rounded up to whole groups.
    void dispatch(uint32_t x, uint32_t y = 1, uint32_t z = 1);
    void dispatch(uvec2 threads) { dispatch(threads.x, threads.y); }
    /// A thread per pixel, with groups in the order of base/strips.h, for shaders that call pixelInStrips().
    void dispatchStrips(uvec2 pixels) { dispatch(stripWidth, pixels.y, (pixels.x + stripWidth - 1) / stripWidth); }
    /// Group counts from a VkDispatchIndirectCommand at the start of the buffer plus `offset`.
    void dispatchIndirect(BufferView arguments, VkDeviceSize offset);

    /// Raster only. Cleared to `clear` if given; otherwise the contents are kept.
    Pass& color(std::string_view output, Image image, std::optional<VkClearColorValue> clear);
    Pass& depth(Image image, std::optional<float> clear);
    /// Alpha-blends colours over the contents.
    Pass& blend();
    /// Layout of the vertex buffers that the draws bind, and of the descriptor set (1) that they bind themselves.
    Pass& vertices(const VertexLayout& layout, VkDescriptorSetLayout drawSet = VK_NULL_HANDLE);
    /// Records the draws with a viewport over the whole target.
    void draw(const std::function<void(const DrawCommands&)>& record);

private:
    struct Bound {
        std::string name;
        Image image;
        BufferView buffer;
        AccelerationView structure;
        VkSampler sampler = VK_NULL_HANDLE;
        bool write = false;
    };
    struct UniformBytes {
        std::string name;
        std::vector<std::byte> bytes;
    };
    struct Attachment {
        std::string output;
        Image image;
        std::optional<VkClearColorValue> clear;
    };

    void prepare(const Pipeline& pipeline);
    VkDescriptorSet writeSet(const Pipeline& pipeline);
    void checkBindings(const Pipeline& pipeline) const;
    void checkAccess(const ShaderBinding& binding, const Bound& bound) const;
    void collectUses(const Pipeline& pipeline);
    void emitBarriers();
    [[nodiscard]] uint64_t boundBytes() const;
    void use(Image image, const Access& access);
    void use(BufferView buffer, const Access& access);
    const Pipeline& startCompute();
    void orderAttachments(const Pipeline& pipeline);

    Recorder& recorder_;
    std::string name_;
    PipelineInfo info_;
    std::vector<Bound> bound_;
    std::vector<UniformBytes> uniforms_;
    std::vector<Attachment> colors_;
    Image depth_;
    std::optional<float> clearDepth_;
    std::vector<std::pair<Image, Access>> imageUses_;
    std::vector<std::pair<BufferView, Access>> bufferUses_;
};

}  // namespace reflet::gpu
