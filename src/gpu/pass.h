// One pass, declared where it is listed: its inputs, outputs and parameters, by their names in the shader.
//
//     f.compute("trace_screen", "trace_screen.comp")
//         .read("depth", g.depth).read("lit", lit).write("answer", rays.answer)
//         .params(TraceScreenParams{...})
//         .dispatchIndirect(rays.list, offset);
//
// The last call appends it to the list. Unknown names, missing bindings, parameter blocks of the wrong size and writes
// to readonly resources throw a std::logic_error that names the pass and the binding, in every build.
#pragma once

#include "base/strips.h"
#include "gpu/pass_record.h"

#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

namespace reflet::gpu {

class PassList;

/// Base of compute and raster passes.
class Pass {
public:
    Pass(PassList& list, PassRecord& record) : list_(&list), record_(&record) {}

protected:
    void bind(std::string_view binding, Bound bound);
    void setUniform(std::string_view binding, std::span<const std::byte> bytes);
    void setConstant(std::string_view name, uint32_t value);
    /// Checks that everything is bound, records all resource uses, and appends the pass.
    void append();
    void use(const Image& image, const Access& access);
    void use(const BufferView& buffer, const Access& access);

    PassList* list_;
    PassRecord* record_;

private:
    [[nodiscard]] uint32_t slotOf(std::string_view binding, bool uniform) const;
    void checkAccess(const ShaderBinding& binding, const Bound& bound) const;
    void checkBound() const;
};

/// The declarations of a pass. Self: the derived class that they return (CRTP).
template <class Self>
class DeclaredPass : public Pass {
public:
    using Pass::Pass;

    Self& read(std::string_view binding, Image image, VkSampler sampler = VK_NULL_HANDLE) {
        return bound(binding, {image, {}, {}, sampler, false});
    }
    Self& read(std::string_view binding, BufferView buffer) {
        return bound(binding, {{}, buffer, {}, VK_NULL_HANDLE, false});
    }
    /// The structure must have been built before this frame began.
    Self& read(std::string_view binding, AccelerationView structure) {
        return bound(binding, {{}, {}, structure, VK_NULL_HANDLE, false});
    }
    /// A pass may also read what it writes.
    Self& write(std::string_view binding, Image image) { return bound(binding, {image, {}, {}, VK_NULL_HANDLE, true}); }
    Self& write(std::string_view binding, BufferView buffer) {
        return bound(binding, {{}, buffer, {}, VK_NULL_HANDLE, true});
    }

    /// Contents of the uniform block of that name. T must have no padding beyond that of the shader's scalar layout.
    template <class T>
    Self& params(const T& value, std::string_view binding = "params") {
        static_assert(std::is_trivially_copyable_v<T>);
        return uniform(binding, std::as_bytes(std::span(&value, 1)));
    }
    Self& uniform(std::string_view binding, std::span<const std::byte> bytes) {
        setUniform(binding, bytes);
        return self();
    }

    /// Sets a specialization constant.
    Self& constant(std::string_view name, uint32_t value) {
        setConstant(name, value);
        return self();
    }

protected:
    Self& self() { return static_cast<Self&>(*this); }

private:
    Self& bound(std::string_view binding, const Bound& what) {
        bind(binding, what);
        return self();
    }
};

class ComputePass : public DeclaredPass<ComputePass> {
public:
    using DeclaredPass::DeclaredPass;

    /// Dispatches x · y · z threads, rounded up to whole groups.
    void dispatch(uint32_t x, uint32_t y = 1, uint32_t z = 1);
    void dispatch(uvec2 threads) { dispatch(threads.x, threads.y); }
    /// A thread per pixel, with groups in the order of base/strips.h, for shaders that call pixelInStrips().
    void dispatchStrips(uvec2 pixels) { dispatch(stripWidth, pixels.y, (pixels.x + stripWidth - 1) / stripWidth); }
    /// Group counts from a VkDispatchIndirectCommand at the start of the buffer plus `offset`.
    void dispatchIndirect(BufferView arguments, VkDeviceSize offset);
};

class RasterPass : public DeclaredPass<RasterPass> {
public:
    using DeclaredPass::DeclaredPass;
    using DeclaredPass::read;

    /// Declares a read of an image in the draws' own descriptor set.
    RasterPass& read(Image image);
    /// A colour attachment, cleared to `clear` if given; otherwise its contents are kept.
    RasterPass& color(std::string_view output, Image image, std::optional<VkClearColorValue> clear);
    RasterPass& depth(Image image, std::optional<float> clear);
    /// Alpha-blends colours over the contents.
    RasterPass& blend();
    /// Layout of the vertex buffers that the draws bind, and of the descriptor set (1) that they bind themselves.
    RasterPass& vertices(const VertexLayout& layout, VkDescriptorSetLayout drawSet = VK_NULL_HANDLE);
    /// Appends the pass. `record` records the draws, with a viewport over the whole target, when the list is recorded.
    /// Everything that it refers to must live until the frame has ended.
    template <class F>
    void draw(F record) {
        record_->draw.emplace(std::move(record));
        appendDraw();
    }

private:
    void appendDraw();
    void checkTargets() const;
};

}  // namespace reflet::gpu
