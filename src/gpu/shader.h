// Shaders: SPIR-V embedded at build time and found by file name, and the reflection of their bindings.
#pragma once

#include "gpu/vulkan.h"

#include "base/math.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::gpu {

struct EmbeddedShader {
    std::string_view name;  ///< "trace_screen.comp"
    std::span<const uint32_t> words;
};

struct ShaderBinding {
    std::string name;
    uint32_t set = 0;
    uint32_t binding = 0;
    uint32_t count = 1;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;
    bool readOnly = true;                   ///< storage images and buffers: declared readonly
    uint32_t blockSize = 0;                 ///< uniform buffers: bytes
    VkFormat format = VK_FORMAT_UNDEFINED;  ///< storage images: as declared

    bool operator==(const ShaderBinding&) const = default;
};

/// An input or output of a stage.
struct ShaderLocation {
    std::string name;
    uint32_t location = 0;
};

struct SpecializationConstant {
    std::string name;
    uint32_t id = 0;
};

/// A shader and its interface, reflected from SPIR-V with spirv-cross.
struct Shader {
    std::string name;
    std::span<const uint32_t> words;
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
    std::vector<ShaderBinding> bindings;  ///< those that the code uses
    std::vector<SpecializationConstant> constants;
    std::vector<ShaderLocation> inputs;
    std::vector<ShaderLocation> outputs;
    uint32_t pushConstantSize = 0;
    glm::uvec3 localSize{1};
};

/// The shaders of a context, by name.
class ShaderLibrary {
public:
    /// Adds shaders that are embedded in a program or library. A name that is there already keeps its shader.
    void add(std::span<const EmbeddedShader> shaders);

    /// Replaces the SPIR-V of a shader. Throws Error, and keeps the old one, if the interface (bindings, constants,
    /// inputs, outputs) differs, because the host code knows only that. Existing pipelines are unchanged (see
    /// PipelineCache::clear). Throws std::logic_error if there is no shader of that name.
    void replace(std::string_view name, std::vector<uint32_t> words);

    /// Throws std::logic_error if there is no shader of that name.
    [[nodiscard]] Shader reflect(std::string_view name) const;

private:
    [[nodiscard]] const EmbeddedShader& find(std::string_view name) const;

    std::map<std::string_view, EmbeddedShader> shaders_;  ///< names are those of the embedded tables
    std::map<std::string_view, std::vector<uint32_t>> replaced_;
};

}  // namespace reflet::gpu
