// Finds embedded shaders and reflects them with spirv-cross.
#include "gpu/shader.h"

#include "base/error.h"

#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

namespace reflet::gpu {

namespace {

struct ContextDeleter {
    void operator()(spvc_context context) const { spvc_context_destroy(context); }
};

void spvcCheck(spvc_result result, std::string_view shader) {
    REFLET_CHECK(result == SPVC_SUCCESS, "reflecting {}: spirv-cross returned {}", shader, static_cast<int>(result));
}

struct ResourceKind {
    spvc_resource_type resources;
    VkDescriptorType descriptor;
};

constexpr ResourceKind resourceKinds[] = {
    {SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
    {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
    {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
    {SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR},
    {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
};

VkFormat formatOf(SpvImageFormat format, std::string_view shader) {
    switch (format) {
        case SpvImageFormatR8:
            return VK_FORMAT_R8_UNORM;
        case SpvImageFormatRgba8:
            return VK_FORMAT_R8G8B8A8_UNORM;
        case SpvImageFormatRg16f:
            return VK_FORMAT_R16G16_SFLOAT;
        case SpvImageFormatRgba16f:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
        case SpvImageFormatR32f:
            return VK_FORMAT_R32_SFLOAT;
        case SpvImageFormatRg32f:
            return VK_FORMAT_R32G32_SFLOAT;
        case SpvImageFormatRgba32f:
            return VK_FORMAT_R32G32B32A32_SFLOAT;
        case SpvImageFormatR32ui:
            return VK_FORMAT_R32_UINT;
        case SpvImageFormatRg32ui:
            return VK_FORMAT_R32G32_UINT;
        case SpvImageFormatRgba32ui:
            return VK_FORMAT_R32G32B32A32_UINT;
        default:
            break;
    }
    REFLET_CHECK(false, "{}: no VkFormat is known for SPIR-V's image format {}", shader, static_cast<int>(format));
    return VK_FORMAT_UNDEFINED;
}

class Reflector {
public:
    explicit Reflector(const EmbeddedShader& source) : name_(source.name) {
        spvc_context context = nullptr;
        spvcCheck(spvc_context_create(&context), name_);
        context_.reset(context);
        spvc_parsed_ir ir = nullptr;
        spvcCheck(spvc_context_parse_spirv(context, source.words.data(), source.words.size(), &ir), name_);
        spvcCheck(
            spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_),
            name_);
        spvc_set active = nullptr;
        spvcCheck(spvc_compiler_get_active_interface_variables(compiler_, &active), name_);
        spvcCheck(spvc_compiler_create_shader_resources_for_active_variables(compiler_, &resources_, active), name_);
    }

    void fill(Shader& shader) {
        shader.stage = stage();
        for (const ResourceKind& kind : resourceKinds) {
            for (const spvc_reflected_resource& resource : list(kind.resources)) {
                shader.bindings.push_back(binding(resource, kind.descriptor));
            }
        }
        for (const spvc_reflected_resource& block : list(SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
            shader.pushConstantSize = blockSize(block);
        }
        for (int axis = 0; axis < 3 && shader.stage == VK_SHADER_STAGE_COMPUTE_BIT; ++axis) {
            shader.localSize[axis] = spvc_compiler_get_execution_mode_argument_by_index(
                compiler_, SpvExecutionModeLocalSize, static_cast<unsigned>(axis));
        }
        for (const spvc_reflected_resource& input : list(SPVC_RESOURCE_TYPE_STAGE_INPUT)) {
            shader.inputs.push_back(location(input));
        }
        for (const spvc_reflected_resource& output : list(SPVC_RESOURCE_TYPE_STAGE_OUTPUT)) {
            shader.outputs.push_back(location(output));
        }
        const spvc_specialization_constant* constants = nullptr;
        size_t count = 0;
        spvcCheck(spvc_compiler_get_specialization_constants(compiler_, &constants, &count), name_);
        for (const spvc_specialization_constant& constant : std::span(constants, count)) {
            shader.constants.push_back({spvc_compiler_get_name(compiler_, constant.id), constant.constant_id});
        }
    }

private:
    VkShaderStageFlagBits stage() {
        switch (spvc_compiler_get_execution_model(compiler_)) {
            case SpvExecutionModelVertex:
                return VK_SHADER_STAGE_VERTEX_BIT;
            case SpvExecutionModelFragment:
                return VK_SHADER_STAGE_FRAGMENT_BIT;
            default:
                return VK_SHADER_STAGE_COMPUTE_BIT;
        }
    }

    std::span<const spvc_reflected_resource> list(spvc_resource_type type) {
        const spvc_reflected_resource* data = nullptr;
        size_t count = 0;
        spvcCheck(spvc_resources_get_resource_list_for_type(resources_, type, &data, &count), name_);
        return {data, count};
    }

    ShaderLocation location(const spvc_reflected_resource& variable) {
        return {spvc_compiler_get_name(compiler_, variable.id),
                spvc_compiler_get_decoration(compiler_, variable.id, SpvDecorationLocation)};
    }

    uint32_t blockSize(const spvc_reflected_resource& resource) {
        size_t size = 0;
        spvcCheck(spvc_compiler_get_declared_struct_size(
                      compiler_, spvc_compiler_get_type_handle(compiler_, resource.base_type_id), &size),
                  name_);
        return static_cast<uint32_t>(size);
    }

    // A block is named after its variable, or after its first member if the variable has no name.
    ShaderBinding binding(const spvc_reflected_resource& resource, VkDescriptorType type) {
        ShaderBinding result;
        const std::string variable = spvc_compiler_get_name(compiler_, resource.id);
        result.name = variable.empty() ? spvc_compiler_get_member_name(compiler_, resource.base_type_id, 0) : variable;
        result.set = spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationDescriptorSet);
        result.binding = spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationBinding);
        result.type = type;
        if (type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) {
            result.blockSize = blockSize(resource);
        } else if (type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE) {
            result.readOnly = spvc_compiler_has_decoration(compiler_, resource.id, SpvDecorationNonWritable) != 0;
            const spvc_type image = spvc_compiler_get_type_handle(compiler_, resource.type_id);
            result.format = formatOf(spvc_type_get_image_storage_format(image), name_);
        } else if (type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
            result.readOnly = isReadOnlyBuffer(resource);
        }
        return result;
    }

    bool isReadOnlyBuffer(const spvc_reflected_resource& resource) {
        const SpvDecoration* decorations = nullptr;
        size_t count = 0;
        spvcCheck(spvc_compiler_get_buffer_block_decorations(compiler_, resource.id, &decorations, &count), name_);
        return std::find(decorations, decorations + count, SpvDecorationNonWritable) != decorations + count;
    }

    std::string_view name_;
    std::unique_ptr<spvc_context_s, ContextDeleter> context_;
    spvc_compiler compiler_ = nullptr;
    spvc_resources resources_ = nullptr;
};

Shader reflected(const EmbeddedShader& source) {
    Shader shader;
    shader.name = source.name;
    shader.words = source.words;
    Reflector(source).fill(shader);
    return shader;
}

bool haveSameInterface(Shader a, Shader b) {
    for (Shader* shader : {&a, &b}) {
        std::ranges::sort(shader->bindings, {}, &ShaderBinding::name);
        for (ShaderBinding& binding : shader->bindings) {
            binding.binding = 0;  // numbered by the compiler; the host binds by name
        }
    }
    const auto namesOf = [](const auto& list) {
        std::vector<std::string> names;
        std::ranges::transform(list, std::back_inserter(names), [](const auto& item) { return item.name; });
        std::ranges::sort(names);
        return names;
    };
    return a.bindings == b.bindings && namesOf(a.constants) == namesOf(b.constants) &&
           namesOf(a.inputs) == namesOf(b.inputs) && namesOf(a.outputs) == namesOf(b.outputs) &&
           a.pushConstantSize == b.pushConstantSize;
}

}  // namespace

void ShaderLibrary::add(std::span<const EmbeddedShader> shaders) {
    for (const EmbeddedShader& shader : shaders) {
        shaders_.emplace(shader.name, shader);
    }
}

const EmbeddedShader& ShaderLibrary::find(std::string_view name) const {
    const auto found = shaders_.find(name);
    REFLET_CHECK(found != shaders_.end(), "no shader is named '{}'", name);
    return found->second;
}

void ShaderLibrary::replace(std::string_view name, std::vector<uint32_t> words) {
    const EmbeddedShader& known = find(name);
    if (!haveSameInterface(reflected(known), reflected({known.name, words}))) {
        fail(
            "{}: bindings, constants, inputs or outputs differ from the shader that the program was built with; "
            "rebuild "
            "the program",
            name);
    }
    std::vector<uint32_t>& kept = replaced_[known.name];
    kept = std::move(words);
    shaders_[known.name].words = kept;
}

Shader ShaderLibrary::reflect(std::string_view name) const {
    return reflected(find(name));
}

}  // namespace reflet::gpu
