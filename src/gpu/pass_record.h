// A pass as a value in a list: everything that is needed to order, synchronize and record it. Records are reused by
// passes of the same name in later frames, so that a steady frame allocates no memory.
#pragma once

#include "gpu/pipeline.h"
#include "gpu/plan.h"
#include "gpu/resource.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace reflet::gpu {

class Context;

/// Passed to the callback that records the draws of a raster pass.
struct DrawCommands {
    Context& context;
    VkCommandBuffer commands;
    VkPipelineLayout layout;
};

/// A callback of a raster pass. Small ones are stored inline: std::function would allocate memory in every frame.
class DrawCallback {
public:
    DrawCallback() = default;
    ~DrawCallback() { reset(); }
    DrawCallback(const DrawCallback&) = delete;
    DrawCallback& operator=(const DrawCallback&) = delete;

    template <class F>
    void emplace(F callback) {
        // For one F, clang-tidy reports half of it as redundant. NOLINTNEXTLINE(misc-redundant-expression)
        if constexpr (sizeof(F) > capacity || alignof(F) > alignof(std::max_align_t)) {
            emplace([held = std::make_unique<F>(std::move(callback))](const DrawCommands& to) { (*held)(to); });
        } else {
            reset();
            ::new (static_cast<void*>(bytes_)) F(std::move(callback));
            call_ = [](void* f, const DrawCommands& to) { (*static_cast<F*>(f))(to); };
            destroy_ = [](void* f) { static_cast<F*>(f)->~F(); };
        }
    }
    void operator()(const DrawCommands& to) { call_(bytes_, to); }
    void reset() {
        if (destroy_ != nullptr) {
            destroy_(bytes_);
            destroy_ = nullptr;
        }
    }

private:
    static constexpr size_t capacity = 512;
    alignas(std::max_align_t) std::byte bytes_[capacity];
    void (*call_)(void*, const DrawCommands&) = nullptr;
    void (*destroy_)(void*) = nullptr;
};

/// The resource bound to one name.
struct Bound {
    Image image;
    BufferView buffer;
    AccelerationView structure;
    VkSampler sampler = VK_NULL_HANDLE;
    bool write = false;
};

struct Attachment {
    std::string_view output;  ///< name in the fragment shader
    Image image;
    std::optional<VkClearColorValue> clear;
};

enum class PassKind : uint8_t { compute, raster, clear, update, upload, copy, readback };

/// A descriptor set and the resources written to it.
struct CachedSet {
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    std::vector<uint64_t> key;  ///< ids of all bound resources; empty: never matches
    uint64_t pipelines = 0;     ///< PipelineCache::version
    uint64_t lastUse = 0;       ///< frame number
};

struct PassRecord {
    std::string_view name;  ///< with the prefix of its scope; lives as long as the list
    uint32_t nameIndex = 0;
    PassKind kind = PassKind::compute;

    // Compute and raster.
    const ShaderInterface* interface = nullptr;
    PipelineInfo info;
    std::vector<Bound> bound;         ///< in the order of the calls
    std::vector<uint32_t> slots;      ///< for each of `bound`: index of the interface's binding
    std::vector<uint32_t> lastSlots;  ///< `slots` of the previous use, tried first: saves searching by name
    std::vector<uint32_t> boundOf;    ///< for each binding of the interface: index into `bound`
    struct Uniform {
        uint32_t slot = 0;
        uint32_t offset = 0;  ///< in `bytes`
        uint32_t size = 0;
    };
    std::vector<Uniform> uniforms;
    std::vector<std::byte> bytes;  ///< contents of uniform blocks, or of an update
    glm::uvec3 groups{0};
    BufferView arguments;  ///< arguments of an indirect dispatch, at argumentsOffset; none: `groups`
    VkDeviceSize argumentsOffset = 0;
    std::vector<Attachment> colors;
    Image depth;
    std::optional<float> clearDepth;
    DrawCallback draw;

    // Copies and clears.
    Image from;
    Image to;
    BufferView buffer;
    VkClearColorValue clear{};
    std::unique_ptr<Buffer> staging;
    size_t readback = 0;

    // All images and buffers, each once.
    std::vector<std::pair<Image, Access>> imageUses;
    std::vector<std::pair<BufferView, Access>> bufferUses;
    uint64_t boundBytes = 0;
    bool root = false;  ///< never culled, even if no pass reads its output

    // Kept from frame to frame.
    const Pipeline* pipeline = nullptr;  ///< created from madeInfo
    PipelineInfo madeInfo;
    uint64_t pipelinesVersion = UINT64_MAX;  ///< PipelineCache::version of `pipeline` and `interface`
    std::vector<CachedSet> sets;

    /// Clears the last frame's declarations.
    void clearDeclarations();
};

}  // namespace reflet::gpu
