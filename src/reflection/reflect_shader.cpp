// Reflects SPIR-V with spirv-cross.
#include "reflection/reflect_shader.h"

#include "base/error.h"

#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

namespace reflet::reflection {

using namespace gpu;

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
        case SpvImageFormatUnknown:
            return VK_FORMAT_UNDEFINED;
        case SpvImageFormatR8:
            return VK_FORMAT_R8_UNORM;
        case SpvImageFormatRgba8:
            return VK_FORMAT_R8G8B8A8_UNORM;
        case SpvImageFormatRgb10A2:
            return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
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

/// What the views of a reflected shader point into.
struct Storage {
    std::vector<uint32_t> words;
    std::deque<std::string> names;  ///< elements stay where they are
    std::vector<ShaderBinding> bindings;
    std::vector<SpecializationConstant> constants;
    std::vector<ShaderLocation> inputs;
    std::vector<ShaderLocation> outputs;
};

class Reflector {
public:
    Reflector(std::string_view name, Storage& storage) : name_(name), storage_(storage) {
        spvc_context context = nullptr;
        spvcCheck(spvc_context_create(&context), name_);
        context_.reset(context);
        spvc_parsed_ir ir = nullptr;
        spvcCheck(spvc_context_parse_spirv(context, storage.words.data(), storage.words.size(), &ir), name_);
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
                storage_.bindings.push_back(binding(resource, kind.descriptor));
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
            storage_.inputs.push_back(location(input));
        }
        for (const spvc_reflected_resource& output : list(SPVC_RESOURCE_TYPE_STAGE_OUTPUT)) {
            storage_.outputs.push_back(location(output));
        }
        const spvc_specialization_constant* constants = nullptr;
        size_t count = 0;
        spvcCheck(spvc_compiler_get_specialization_constants(compiler_, &constants, &count), name_);
        for (const spvc_specialization_constant& constant : std::span(constants, count)) {
            storage_.constants.push_back({keep(spvc_compiler_get_name(compiler_, constant.id)), constant.constant_id});
        }
        shader.bindings = storage_.bindings;
        shader.inputs = storage_.inputs;
        shader.outputs = storage_.outputs;
        shader.constants = storage_.constants;
    }

private:
    std::string_view keep(std::string name) { return storage_.names.emplace_back(std::move(name)); }

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
        return {keep(spvc_compiler_get_name(compiler_, variable.id)),
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
        result.name =
            keep(variable.empty() ? spvc_compiler_get_member_name(compiler_, resource.base_type_id, 0) : variable);
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
    Storage& storage_;
    std::unique_ptr<spvc_context_s, ContextDeleter> context_;
    spvc_compiler compiler_ = nullptr;
    spvc_resources resources_ = nullptr;
};

}  // namespace

ReflectedShader reflectShader(std::string_view name, std::vector<uint32_t> words) {
    const auto storage = std::make_shared<Storage>();
    storage->words = std::move(words);
    ReflectedShader result;
    result.shader.name = storage->names.emplace_back(name);
    result.shader.words = storage->words;
    Reflector(name, *storage).fill(result.shader);
    result.owner = storage;
    return result;
}

}  // namespace reflet::reflection
