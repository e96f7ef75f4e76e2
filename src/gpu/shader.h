// Shaders: SPIR-V and its interface, embedded at build time (reflection/) and found by file name.
#pragma once

#include "gpu/vulkan.h"

#include "base/math.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace reflet::gpu {

struct ShaderBinding {
    std::string_view name;
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
    std::string_view name;
    uint32_t location = 0;
};

struct SpecializationConstant {
    std::string_view name;
    uint32_t id = 0;
};

/// A shader and its interface. Views point to data that is embedded in the program or library, or kept by an owner.
struct Shader {
    std::string_view name;  ///< "trace_screen.comp"
    std::span<const uint32_t> words;
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
    std::span<const ShaderBinding> bindings;  ///< only statically used ones
    std::span<const SpecializationConstant> constants;
    std::span<const ShaderLocation> inputs;
    std::span<const ShaderLocation> outputs;
    uint32_t pushConstantSize = 0;
    glm::uvec3 localSize{1};
};

/// A shader that is not embedded, and the owner of the data that its views point to.
struct ReflectedShader {
    Shader shader;
    std::shared_ptr<const void> owner;
};

/// The shaders of a context, by name.
class ShaderLibrary {
public:
    /// Adds shaders that are embedded in a program or library. Names that already exist keep their shader.
    void add(std::span<const Shader> shaders);

    /// Replaces a shader by one of the same name. Throws Error, and keeps the old one, if the interface (bindings,
    /// constants, inputs, outputs) differs, because the host code knows only that. Existing pipelines are unchanged
    /// (see PipelineCache::clear). Throws std::logic_error if there is no shader of that name.
    void replace(const ReflectedShader& replacement);

    /// Throws std::logic_error if there is no shader of that name.
    [[nodiscard]] const Shader& find(std::string_view name) const;

private:
    std::map<std::string_view, Shader, std::less<>> shaders_;  ///< names are those of the embedded tables
    std::vector<std::shared_ptr<const void>> owners_;          ///< of all replacements: pipelines refer to their names
};

}  // namespace reflet::gpu
