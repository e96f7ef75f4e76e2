// Pipelines, created on first use and cached by shaders, constants and render target formats.
#pragma once

#include "gpu/shader.h"
#include "gpu/vulkan.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace reflet::gpu {

class Context;

/// One vertex attribute that a draw list provides; pipelines use those that their vertex shader names.
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

/// Description of a pipeline; equal descriptions share one.
struct PipelineInfo {
    std::vector<std::string> shaders;                         ///< one .comp, or a .vert and optionally a .frag
    std::vector<std::pair<std::string, uint32_t>> constants;  ///< specialization constants by name, as bits
    std::vector<VkFormat> colorFormats;                       ///< by location
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;
    bool blends = false;                             ///< alpha-blends colours over the contents
    const VertexLayout* vertices = nullptr;          ///< static data; nullptr: no vertex buffers
    VkDescriptorSetLayout drawSet = VK_NULL_HANDLE;  ///< set 1, bound by the draws themselves

    auto operator<=>(const PipelineInfo&) const = default;  // NOLINT(modernize-use-nullptr): a literal 0 of its own
};

struct Pipeline {
    VkPipeline handle = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSetLayout set = VK_NULL_HANDLE;  ///< set 0
    std::vector<ShaderBinding> bindings;         ///< of set 0, of all stages
    std::vector<ShaderLocation> colorOutputs;    ///< of the fragment shader
    VkShaderStageFlags stages = 0;
    uint32_t pushConstantSize = 0;
    glm::uvec3 localSize{1};
};

class PipelineCache {
public:
    explicit PipelineCache(Context& context) : context_(context) {}
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    /// Throws std::logic_error: an unknown shader or constant, or stages with conflicting bindings.
    const Pipeline& get(const PipelineInfo& info);

    [[nodiscard]] bool has(const PipelineInfo& info) const { return pipelines_.contains(info); }

    /// Forgets all pipelines, because shaders have changed.
    void clear();

private:
    Context& context_;
    std::map<PipelineInfo, std::unique_ptr<Pipeline>> pipelines_;
};

}  // namespace reflet::gpu
