// Creates Vulkan pipelines from reflected shaders.
#include "gpu/pipeline_compilation.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <iterator>
#include <thread>

namespace reflet::gpu {

namespace {

VkDescriptorSetLayout makeSetLayout(Context& context, const std::vector<ShaderBinding>& bindings) {
    std::vector<VkDescriptorSetLayoutBinding> list;
    list.reserve(bindings.size());
    for (const ShaderBinding& b : bindings) {
        // The bytes of a block move from frame to frame; the sets stay.
        const bool block = b.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        list.push_back({b.binding, block ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC : b.type, b.count,
                        VK_SHADER_STAGE_ALL, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<uint32_t>(list.size());
    info.pBindings = list.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateDescriptorSetLayout(context.handle(), &info, context.allocator(), &layout),
            "creating a set layout");
    return layout;
}

VkPipelineLayout makeLayout(Context& context, VkDescriptorSetLayout set, VkDescriptorSetLayout drawSet,
                            uint32_t pushConstantSize) {
    const VkDescriptorSetLayout sets[] = {set, drawSet};
    const VkPushConstantRange push{VK_SHADER_STAGE_ALL, 0, pushConstantSize};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = drawSet != VK_NULL_HANDLE ? 2 : 1;
    info.pSetLayouts = sets;
    info.pushConstantRangeCount = pushConstantSize > 0 ? 1 : 0;
    info.pPushConstantRanges = &push;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreatePipelineLayout(context.handle(), &info, context.allocator(), &layout),
            "creating a pipeline layout");
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

/// The shader modules of a pipeline while it is made.
struct Modules {
    Context& context;
    std::vector<VkShaderModule> handles;

    explicit Modules(Context& of) : context(of) {}
    ~Modules() {
        for (VkShaderModule handle : handles) {
            context.vk.vkDestroyShaderModule(context.handle(), handle, context.allocator());
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
    vkCheck(context.vk.vkCreateShaderModule(context.handle(), &info, context.allocator(), &shaderModule),
            "creating a shader");
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
VkPipeline makeGraphics(Context& context, VkPipelineCache cache, const PipelineInfo& info, const VertexInput& vertices,
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
    vkCheck(context.vk.vkCreateGraphicsPipelines(context.handle(), cache, 1, &create, context.allocator(), &pipeline),
            "creating a graphics pipeline");
    return pipeline;
}

VkPipeline makeCompute(Context& context, VkPipelineCache cache, const VkPipelineShaderStageCreateInfo& stage,
                       VkPipelineLayout layout) {
    VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    create.stage = stage;
    create.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateComputePipelines(context.handle(), cache, 1, &create, context.allocator(), &pipeline),
            "creating a compute pipeline");
    return pipeline;
}

VkPipeline makePipeline(Context& context, VkPipelineCache cache, const PipelineInfo& info,
                        const std::vector<Shader>& shaders, VkPipelineLayout layout) {
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
    return shaders.front().stage == VK_SHADER_STAGE_COMPUTE_BIT
               ? makeCompute(context, cache, stages.front(), layout)
               : makeGraphics(context, cache, info, vertexInput(shaders.front(), info.vertices), layout, stages);
}

}  // namespace

void destroyPipeline(Context& context, const Pipeline& pipeline) {
    context.vk.vkDestroyPipeline(context.handle(), pipeline.handle, context.allocator());
    context.vk.vkDestroyPipelineLayout(context.handle(), pipeline.layout, context.allocator());
    context.vk.vkDestroyDescriptorSetLayout(context.handle(), pipeline.set, context.allocator());
}

PipelineCompilation::PipelineCompilation(Context& context, const PipelineInfo& info, const ShaderInterface& interface)
    : context_(context), info_(info), pipeline_(std::make_unique<Pipeline>()) {
    std::ranges::transform(info.shaders, std::back_inserter(shaders_),
                           [&](std::string_view name) { return context.shaders().find(name); });
    try {
        pipeline_->set = makeSetLayout(context, interface.bindings);
        pipeline_->layout = makeLayout(context, pipeline_->set, info.drawSet, interface.pushConstantSize);
    } catch (...) {
        destroyPipeline(context, *pipeline_);
        throw;
    }
}

PipelineCompilation::~PipelineCompilation() {
    if (pipeline_) {
        destroyPipeline(context_, *pipeline_);
    }
}

void PipelineCompilation::compile(VkPipelineCache cache) noexcept {
    try {
        pipeline_->handle = makePipeline(context_, cache, info_, shaders_, pipeline_->layout);
    } catch (...) {
        failure_ = std::current_exception();
    }
}

size_t PipelineCompilation::words() const {
    size_t sum = 0;
    for (const Shader& shader : shaders_) {
        sum += shader.words.size();
    }
    return sum;
}

// Largest first, so that no thread still has a large one when the others have finished.
void compileAll(std::vector<std::unique_ptr<PipelineCompilation>>& all, VkPipelineCache cache, uint32_t threads) {
    std::ranges::sort(all, std::greater(), [](const auto& one) { return one->words(); });
    std::atomic<size_t> next = 0;
    const auto work = [&]() noexcept {
        for (size_t i = next++; i < all.size(); i = next++) {
            all[i]->compile(cache);
        }
    };
    std::vector<std::jthread> helpers;  // they end before what they refer to
    try {
        for (size_t i = 1; i < std::min<size_t>(threads, all.size()); ++i) {
            helpers.emplace_back(work);
        }
    } catch (const std::exception&) {
        return work();  // with the threads that there are
    }
    work();
}

}  // namespace reflet::gpu
