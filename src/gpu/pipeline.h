// Pipelines, created on first use and cached by shaders, constants and render target formats. Drivers compile when a
// pipeline is created (some only on first use), so a frame's missing pipelines are created on several threads.
#pragma once

#include "gpu/shader.h"
#include "gpu/vulkan.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace reflet::gpu {

class Context;

/// One vertex attribute that a draw list provides; a pipeline uses those that its vertex shader declares.
struct VertexAttribute {
    std::string name;
    uint32_t buffer = 0;
    VkFormat format = VK_FORMAT_UNDEFINED;
    uint32_t offset = 0;
};

struct VertexLayout {
    std::vector<uint32_t> strides;  ///< one per buffer
    std::vector<VertexAttribute> attributes;
};

/// Combined interface of the shaders of a pipeline.
struct ShaderInterface {
    std::vector<std::string_view> shaders;     ///< names, as in the ShaderLibrary
    std::vector<ShaderBinding> bindings;       ///< bindings of set 0 in all stages, by number
    std::vector<uint32_t> sameName;            ///< for each binding, the first one of its name: stages may share names
    std::vector<std::string_view> constants;   ///< specialization constants of all stages
    std::vector<ShaderLocation> colorOutputs;  ///< outputs of the fragment shader
    VkShaderStageFlags stages = 0;
    uint32_t pushConstantSize = 0;
    glm::uvec3 localSize{1};
};

/// Description of a pipeline; equal descriptions share one. Names are those of the ShaderLibrary, which outlive it.
struct PipelineInfo {
    std::vector<std::string_view> shaders;                         ///< one .comp, or a .vert and optionally a .frag
    std::vector<std::pair<std::string_view, uint32_t>> constants;  ///< specialization constants by name, as bits
    std::vector<VkFormat> colorFormats;                            ///< by location
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;
    bool blends = false;                             ///< alpha-blends colours over the contents
    const VertexLayout* vertices = nullptr;          ///< static data; nullptr: no vertex buffers
    VkDescriptorSetLayout drawSet = VK_NULL_HANDLE;  ///< set 1, bound by the draws themselves

    auto operator<=>(const PipelineInfo&) const = default;  // NOLINT(modernize-use-nullptr): a literal 0 of its own
};

struct Pipeline {
    VkPipeline handle = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSetLayout set = VK_NULL_HANDLE;  ///< set 0; uniform blocks have dynamic offsets
};

/// How a context creates pipelines.
struct PipelineMaking {
    VkPipelineCache driverCache = VK_NULL_HANDLE;  ///< cache of the device's owner, or none
    /// Without driverCache: creates a cache from `data`, an earlier result of data().
    bool keepsData = false;
    std::span<const std::byte> data;  ///< read by the constructor
    uint32_t threads = 1;             ///< maximum number, including the calling one
    /// Called with the number of shaders before pipelines are created, and with 0 once a frame with them has run.
    std::function<void(uint32_t shaders)> onCompile;
};

/// Thread-safe; get() works while another thread creates pipelines. Only clear() needs exclusive access.
class PipelineCache {
public:
    PipelineCache(Context& context, PipelineMaking making);
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    /// The combined interface of these shaders; valid until clear(). Throws std::logic_error: an unknown shader, or
    /// stages with conflicting bindings.
    const ShaderInterface& interfaceOf(std::span<const std::string_view> shaders);

    /// Throws std::logic_error: an unknown shader, or stages with conflicting bindings. The shaders must have all of
    /// the info's constants.
    const Pipeline& get(const PipelineInfo& info);

    [[nodiscard]] bool has(const PipelineInfo& info) const {
        const std::scoped_lock lock(mutex_);
        return pipelines_.contains(info);
    }

    /// Creates pipelines, all different and not yet cached, on as many threads as the context allows. If some cannot be
    /// created, it caches the others, and throws as get() does.
    void make(std::span<const PipelineInfo> missing);
    /// Whether data() may be called: PipelineMaking::keepsData.
    [[nodiscard]] bool keepsData() const { return own_ != VK_NULL_HANDLE; }
    /// Data of the Vulkan pipeline cache, for the pipelines created so far.
    [[nodiscard]] std::vector<std::byte> data() const;

    /// A frame that uses the pipelines created so far has run.
    void noteUsed();

    /// Removes all pipelines, because shaders have changed.
    void clear();
    /// Counts calls of clear().
    [[nodiscard]] uint64_t version() const { return version_; }

private:
    Context& context_;
    PipelineMaking making_;
    VkPipelineCache own_ = VK_NULL_HANDLE;
    mutable std::mutex mutex_;            ///< guards the maps
    std::atomic<bool> compiles_ = false;  ///< whether pipelines were created since the last noteUsed()
    uint64_t version_ = 0;
    std::map<std::vector<std::string_view>, std::unique_ptr<ShaderInterface>> interfaces_;
    std::map<PipelineInfo, std::unique_ptr<Pipeline>> pipelines_;
};

}  // namespace reflet::gpu
