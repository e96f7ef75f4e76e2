// Creates pipelines from reflected shaders.
#include "gpu/pipeline.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>
#include <optional>

namespace reflet::gpu {

namespace {

// The bindings of all stages. The compiler numbers those of each stage from a base of its own, so that a name which two
// stages share has two bindings.
std::vector<ShaderBinding> mergeBindings(const std::vector<Shader>& shaders, uint32_t set) {
    std::vector<ShaderBinding> merged;
    for (const Shader& shader : shaders) {
        for (const ShaderBinding& b : shader.bindings) {
            if (b.set != set) {
                continue;
            }
            const auto same = std::ranges::find(merged, b.binding, &ShaderBinding::binding);
            if (same == merged.end()) {
                merged.push_back(b);
                continue;
            }
            REFLET_CHECK(same->name == b.name && same->type == b.type && same->blockSize == b.blockSize,
                         "{}: binding {} is '{}' here and '{}' in another stage", shader.name, b.binding, b.name,
                         same->name);
        }
    }
    return merged;
}

VkDescriptorSetLayout makeSetLayout(Context& context, const std::vector<ShaderBinding>& bindings) {
    std::vector<VkDescriptorSetLayoutBinding> list;
    list.reserve(bindings.size());
    for (const ShaderBinding& b : bindings) {
        list.push_back({b.binding, b.type, b.count, VK_SHADER_STAGE_ALL, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<uint32_t>(list.size());
    info.pBindings = list.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateDescriptorSetLayout(context.handle(), &info, nullptr, &layout), "creating a set layout");
    return layout;
}

VkPipelineLayout makeLayout(Context& context, const Pipeline& pipeline, VkDescriptorSetLayout drawSet) {
    const VkDescriptorSetLayout sets[] = {pipeline.set, drawSet};
    const VkPushConstantRange push{VK_SHADER_STAGE_ALL, 0, pipeline.pushConstantSize};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = drawSet != VK_NULL_HANDLE ? 2 : 1;
    info.pSetLayouts = sets;
    info.pushConstantRangeCount = pipeline.pushConstantSize > 0 ? 1 : 0;
    info.pPushConstantRanges = &push;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreatePipelineLayout(context.handle(), &info, nullptr, &layout), "creating a pipeline layout");
    return layout;
}

// Specialization of one stage: those constants of the pipeline that its shader declares.
struct Specialization {
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<uint32_t> data;
    VkSpecializationInfo info{};

    Specialization(const Shader& shader, const PipelineInfo& pipeline) {
        for (const auto& [name, value] : pipeline.constants) {
            const auto known = std::ranges::find(shader.constants, name, &SpecializationConstant::name);
            if (known != shader.constants.end()) {
                entries.push_back({known->id, static_cast<uint32_t>(data.size() * sizeof(uint32_t)), sizeof(uint32_t)});
                data.push_back(value);
            }
        }
        info = {static_cast<uint32_t>(entries.size()), entries.data(), data.size() * sizeof(uint32_t), data.data()};
    }
};

void checkConstants(const std::vector<Shader>& shaders, const PipelineInfo& info) {
    for (const auto& constant : info.constants) {
        const bool known = std::ranges::any_of(shaders, [&](const Shader& s) {
            return std::ranges::find(s.constants, constant.first, &SpecializationConstant::name) != s.constants.end();
        });
        REFLET_CHECK(known, "{} has no specialization constant '{}' (set to {})", info.shaders.front(), constant.first,
                     constant.second);
    }
}

/// The shader modules of a pipeline while it is made.
struct Modules {
    Context& context;
    std::vector<VkShaderModule> handles;

    explicit Modules(Context& of) : context(of) {}
    ~Modules() {
        for (VkShaderModule handle : handles) {
            context.vk.vkDestroyShaderModule(context.handle(), handle, nullptr);
        }
    }
    Modules(const Modules&) = delete;
    Modules& operator=(const Modules&) = delete;
};

VkShaderModule makeModule(Context& context, const Shader& shader) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = shader.words.size_bytes();
    info.pCode = shader.words.data();
    VkShaderModule shaderModule = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateShaderModule(context.handle(), &info, nullptr, &shaderModule), "creating a shader");
    return shaderModule;
}

struct VertexInput {
    std::vector<VkVertexInputBindingDescription> buffers;
    std::vector<VkVertexInputAttributeDescription> attributes;
};

VertexInput vertexInput(const Shader& shader, const VertexLayout* layout) {
    VertexInput input;
    for (const ShaderLocation& wanted : shader.inputs) {
        REFLET_CHECK(layout != nullptr, "{} reads '{}', but the pass has no vertices", shader.name, wanted.name);
        const auto found = std::ranges::find(layout->attributes, wanted.name, &VertexAttribute::name);
        REFLET_CHECK(found != layout->attributes.end(), "{}: no vertex attribute '{}'", shader.name, wanted.name);
        input.attributes.push_back({wanted.location, found->buffer, found->format, found->offset});
    }
    for (uint32_t i = 0; layout != nullptr && i < layout->strides.size(); ++i) {
        if (std::ranges::any_of(input.attributes, [&](const auto& a) { return a.binding == i; })) {
            input.buffers.push_back({i, layout->strides[i], VK_VERTEX_INPUT_RATE_VERTEX});
        }
    }
    return input;
}

// Fixed: triangle lists, reversed depth (greater or equal passes). Dynamic: viewport, scissor, culling.
VkPipeline makeGraphics(Context& context, const PipelineInfo& info, const VertexInput& vertices,
                        VkPipelineLayout layout, const std::vector<VkPipelineShaderStageCreateInfo>& stages) {
    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = static_cast<uint32_t>(vertices.buffers.size());
    input.pVertexBindingDescriptions = vertices.buffers.data();
    input.vertexAttributeDescriptionCount = static_cast<uint32_t>(vertices.attributes.size());
    input.pVertexAttributeDescriptions = vertices.attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.lineWidth = 1.0F;
    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = info.depthFormat != VK_FORMAT_UNDEFINED ? VK_TRUE : VK_FALSE;
    depth.depthWriteEnable = depth.depthTestEnable;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
    VkPipelineColorBlendAttachmentState opaque{};
    opaque.colorWriteMask = 0xF;
    VkPipelineColorBlendAttachmentState over = opaque;
    over.blendEnable = VK_TRUE;
    over.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    over.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    over.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    over.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    const std::vector<VkPipelineColorBlendAttachmentState> targets(info.colorFormats.size(),
                                                                   info.blends ? over : opaque);
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = static_cast<uint32_t>(targets.size());
    blend.pAttachments = targets.data();
    const VkDynamicState dynamics[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_CULL_MODE,
                                       VK_DYNAMIC_STATE_FRONT_FACE};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = static_cast<uint32_t>(std::size(dynamics));
    dynamic.pDynamicStates = dynamics;
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = static_cast<uint32_t>(info.colorFormats.size());
    rendering.pColorAttachmentFormats = info.colorFormats.data();
    rendering.depthAttachmentFormat = info.depthFormat;

    VkGraphicsPipelineCreateInfo create{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    create.stageCount = static_cast<uint32_t>(stages.size());
    create.pStages = stages.data();
    create.pVertexInputState = &input;
    create.pInputAssemblyState = &assembly;
    create.pViewportState = &viewport;
    create.pRasterizationState = &raster;
    create.pMultisampleState = &samples;
    create.pDepthStencilState = &depth;
    create.pColorBlendState = &blend;
    create.pDynamicState = &dynamic;
    create.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateGraphicsPipelines(context.handle(), VK_NULL_HANDLE, 1, &create, nullptr, &pipeline),
            "creating a graphics pipeline");
    return pipeline;
}

VkPipeline makeCompute(Context& context, const VkPipelineShaderStageCreateInfo& stage, VkPipelineLayout layout) {
    VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    create.stage = stage;
    create.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateComputePipelines(context.handle(), VK_NULL_HANDLE, 1, &create, nullptr, &pipeline),
            "creating a compute pipeline");
    return pipeline;
}

void makePipeline(Context& context, const PipelineInfo& info, const std::vector<Shader>& shaders, Pipeline& pipeline) {
    std::vector<Specialization> specializations;
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    Modules modules(context);
    specializations.reserve(shaders.size());
    modules.handles.reserve(shaders.size());
    for (const Shader& shader : shaders) {
        const Specialization& specialization = specializations.emplace_back(shader, info);
        VkPipelineShaderStageCreateInfo stage{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
        stage.stage = shader.stage;
        stage.module = modules.handles.emplace_back(makeModule(context, shader));
        stage.pName = "main";
        stage.pSpecializationInfo = &specialization.info;
        stages.push_back(stage);
    }
    pipeline.handle =
        shaders.front().stage == VK_SHADER_STAGE_COMPUTE_BIT
            ? makeCompute(context, stages.front(), pipeline.layout)
            : makeGraphics(context, info, vertexInput(shaders.front(), info.vertices), pipeline.layout, stages);
}

// Of a pipeline, without what describes it: copying that would take memory.
struct Handles {
    VkPipeline pipeline;
    VkPipelineLayout layout;
    VkDescriptorSetLayout set;
};

Handles handlesOf(const Pipeline& pipeline) {
    return {pipeline.handle, pipeline.layout, pipeline.set};
}

void destroy(Context& context, const Handles& handles) {
    context.vk.vkDestroyPipeline(context.handle(), handles.pipeline, nullptr);
    context.vk.vkDestroyPipelineLayout(context.handle(), handles.layout, nullptr);
    context.vk.vkDestroyDescriptorSetLayout(context.handle(), handles.set, nullptr);
}

}  // namespace

PipelineCache::~PipelineCache() {
    clear();
}

// Commands that are still recorded or in flight may use them.
void PipelineCache::clear() {
    for (const auto& [info, pipeline] : pipelines_) {
        context_.retire([&context = context_, retired = handlesOf(*pipeline)] { destroy(context, retired); });
    }
    pipelines_.clear();
}

const Pipeline& PipelineCache::get(const PipelineInfo& info) {
    if (const auto known = pipelines_.find(info); known != pipelines_.end()) {
        return *known->second;
    }
    std::vector<Shader> shaders;
    std::ranges::transform(info.shaders, std::back_inserter(shaders),
                           [&](const std::string& name) { return context_.shaders().find(name); });
    checkConstants(shaders, info);
    auto pipeline = std::make_unique<Pipeline>();
    pipeline->bindings = mergeBindings(shaders, 0);
    pipeline->localSize = shaders.front().localSize;
    for (const Shader& shader : shaders) {
        pipeline->stages |= shader.stage;
        pipeline->pushConstantSize = std::max(pipeline->pushConstantSize, shader.pushConstantSize);
        if (shader.stage == VK_SHADER_STAGE_FRAGMENT_BIT) {
            pipeline->colorOutputs.assign(shader.outputs.begin(), shader.outputs.end());
        }
    }
    Pipeline& made = *pipeline;
    try {
        made.set = makeSetLayout(context_, made.bindings);
        made.layout = makeLayout(context_, made, info.drawSet);
        makePipeline(context_, info, shaders, made);
        pipelines_.emplace(info, nullptr).first->second = std::move(pipeline);
    } catch (...) {
        destroy(context_, handlesOf(made));
        throw;
    }
    ++context_.counts().pipelines;
    return made;
}

}  // namespace reflet::gpu
