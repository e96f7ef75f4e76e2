// Checks a pass against its shaders, emits its barriers and records it.
#include "gpu/pass.h"

#include "base/error.h"
#include "gpu/barrier.h"
#include "gpu/context.h"
#include "gpu/recorder.h"

#include <algorithm>

namespace reflet::gpu {

namespace {

constexpr VkPipelineStageFlags2 shaderStages(VkShaderStageFlags stages) {
    return (stages & VK_SHADER_STAGE_COMPUTE_BIT) != 0
               ? VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT
               : VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
}

constexpr Access colorAccess{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                             VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, true};
constexpr Access depthAccess{
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, true};

VkRenderingAttachmentInfo attachmentInfo(const Image& image, bool clear, VkClearValue value) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = image.view;
    info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
    info.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    info.clearValue = value;
    return info;
}

}  // namespace

Pass::Pass(Recorder& recorder, std::string name, std::vector<std::string> shaders)
    : recorder_(recorder), name_(std::move(name)) {
    info_.shaders = std::move(shaders);
}

Pass& Pass::read(std::string_view binding, Image image, VkSampler sampler) {
    REFLET_CHECK(image, "{}: no image is bound to '{}'", name_, binding);
    bound_.push_back({std::string(binding), image, {}, {}, sampler, false});
    return *this;
}

Pass& Pass::read(std::string_view binding, BufferView buffer) {
    REFLET_CHECK(buffer, "{}: no buffer is bound to '{}'", name_, binding);
    bound_.push_back({std::string(binding), {}, buffer, {}, VK_NULL_HANDLE, false});
    return *this;
}

Pass& Pass::read(std::string_view binding, AccelerationView structure) {
    REFLET_CHECK(structure, "{}: no acceleration structure is bound to '{}'", name_, binding);
    bound_.push_back({std::string(binding), {}, {}, structure, VK_NULL_HANDLE, false});
    return *this;
}

Pass& Pass::read(Image image) {
    use(image, {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                VK_ACCESS_2_SHADER_READ_BIT, false});
    return *this;
}

Pass& Pass::write(std::string_view binding, Image image) {
    read(binding, image).bound_.back().write = true;
    return *this;
}

Pass& Pass::write(std::string_view binding, BufferView buffer) {
    read(binding, buffer).bound_.back().write = true;
    return *this;
}

Pass& Pass::uniform(std::string_view binding, std::span<const std::byte> bytes) {
    uniforms_.push_back({std::string(binding), {bytes.begin(), bytes.end()}});
    return *this;
}

Pass& Pass::constant(std::string_view name, uint32_t value) {
    info_.constants.emplace_back(name, value);
    return *this;
}

Pass& Pass::color(std::string_view output, Image image, std::optional<VkClearColorValue> clear) {
    colors_.push_back({std::string(output), image, clear});
    return *this;
}

Pass& Pass::depth(Image image, std::optional<float> clear) {
    depth_ = image;
    clearDepth_ = clear;
    info_.depthFormat = image.format;
    return *this;
}

Pass& Pass::blend() {
    info_.blends = true;
    return *this;
}

Pass& Pass::vertices(const VertexLayout& layout, VkDescriptorSetLayout drawSet) {
    info_.vertices = &layout;
    info_.drawSet = drawSet;
    return *this;
}

void Pass::checkAccess(const ShaderBinding& binding, const Bound& bound) const {
    const bool wantsBuffer = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const bool wantsStructure = binding.type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    const char* wanted = wantsStructure ? "an acceleration structure" : wantsBuffer ? "a buffer" : "an image";
    REFLET_CHECK(static_cast<bool>(bound.buffer) == wantsBuffer && static_cast<bool>(bound.structure) == wantsStructure,
                 "{}: '{}' is {} in the shader", name_, bound.name, wanted);
    const bool writable = !binding.readOnly;
    const bool canWrite = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE || wantsBuffer;
    REFLET_CHECK(bound.write == (canWrite && writable), "{}: '{}' is {} here, and {} in the shader", name_, bound.name,
                 bound.write ? "written" : "read", canWrite && writable ? "not readonly" : "readonly");
    // Elsewhere a mismatch reads garbage, and only newer validation layers report it.
    REFLET_CHECK(binding.type != VK_DESCRIPTOR_TYPE_STORAGE_IMAGE || bound.image.format == binding.format,
                 "{}: '{}' has VkFormat {} here and {} in the shader", name_, bound.name,
                 static_cast<int>(bound.image.format), static_cast<int>(binding.format));
}

void Pass::checkBindings(const Pipeline& pipeline) const {
    const auto known = [&](const std::string& name) {
        return std::ranges::find(pipeline.bindings, name, &ShaderBinding::name) != pipeline.bindings.end();
    };
    for (const Bound& bound : bound_) {
        REFLET_CHECK(known(bound.name), "{}: the shader has no binding '{}'", name_, bound.name);
    }
    for (const UniformBytes& uniform : uniforms_) {
        REFLET_CHECK(known(uniform.name), "{}: the shader has no uniform block '{}'", name_, uniform.name);
    }
    for (const ShaderBinding& binding : pipeline.bindings) {
        if (binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) {
            const auto uniform = std::ranges::find(uniforms_, binding.name, &UniformBytes::name);
            REFLET_CHECK(uniform != uniforms_.end(), "{}: the uniform block '{}' is not set", name_, binding.name);
            REFLET_CHECK(uniform->bytes.size() == binding.blockSize, "{}: '{}' has {} bytes here and {} in the shader",
                         name_, binding.name, uniform->bytes.size(), binding.blockSize);
        } else {
            const auto bound = std::ranges::find(bound_, binding.name, &Bound::name);
            REFLET_CHECK(bound != bound_.end(), "{}: nothing is bound to '{}'", name_, binding.name);
            checkAccess(binding, *bound);
        }
    }
}

void Pass::use(Image image, const Access& access) {
    const auto same = std::ranges::find_if(imageUses_, [&](const auto& u) { return u.first.state == image.state; });
    if (same == imageUses_.end()) {
        imageUses_.emplace_back(image, access);
    } else {
        same->second = merged(same->second, access);
    }
}

void Pass::use(BufferView buffer, const Access& access) {
    const auto same = std::ranges::find_if(bufferUses_, [&](const auto& u) { return u.first.state == buffer.state; });
    if (same == bufferUses_.end()) {
        bufferUses_.emplace_back(buffer, access);
    } else {
        same->second = merged(same->second, access);
    }
}

void Pass::collectUses(const Pipeline& pipeline) {
    const VkPipelineStageFlags2 stages = shaderStages(pipeline.stages);
    for (const Bound& bound : bound_) {
        const Access access = bound.write
                                  ? Access{stages, VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT, true}
                                  : Access{stages, VK_ACCESS_2_SHADER_READ_BIT, false};
        if (bound.image) {
            use(bound.image, access);
        } else if (bound.buffer) {
            use(bound.buffer, access);
        }
    }
    for (const Attachment& color : colors_) {
        use(color.image, colorAccess);
    }
    if (depth_) {
        use(depth_, depthAccess);
    }
}

void Pass::emitBarriers() {
    BarrierBatch batch;
    for (const auto& [image, access] : imageUses_) {
        batch.use(*image.state, aspectOf(image.format), access);
    }
    for (const auto& [buffer, access] : bufferUses_) {
        batch.use(buffer.state->access, access);
    }
    batch.record(recorder_.context_.vk, recorder_.commands_);
}

// Written resources count once: passes that also read them move more. Clears and images of a host are not counted.
uint64_t Pass::boundBytes() const {
    uint64_t bytes = 0;
    for (const Bound& bound : bound_) {
        if (bound.image && bound.image.state->external) {
            continue;  // of any format
        }
        bytes += bound.image ? bytesOf(bound.image) : bound.buffer.size;
    }
    for (const Attachment& color : colors_) {
        bytes += bytesOf(color.image);
    }
    return bytes + (depth_ ? bytesOf(depth_) : 0);
}

VkDescriptorSet Pass::writeSet(const Pipeline& pipeline) {
    const VkDescriptorSet set = recorder_.allocateSet(pipeline.set);
    const size_t count = pipeline.bindings.size();
    std::vector<VkDescriptorImageInfo> images(count);
    std::vector<VkDescriptorBufferInfo> buffers(count);
    std::vector<VkWriteDescriptorSetAccelerationStructureKHR> structures(count);
    std::vector<VkWriteDescriptorSet> writes;
    for (size_t i = 0; i < count; ++i) {
        const ShaderBinding& binding = pipeline.bindings[i];
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = set;
        write.dstBinding = binding.binding;
        write.descriptorCount = 1;
        write.descriptorType = binding.type;
        write.pImageInfo = &images[i];
        write.pBufferInfo = &buffers[i];
        if (binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) {
            const auto uniform = std::ranges::find(uniforms_, binding.name, &UniformBytes::name);
            const Recorder::UniformSlice slice = recorder_.uploadUniform(uniform->bytes);
            buffers[i] = {slice.buffer, slice.offset, uniform->bytes.size()};
        } else if (const auto bound = std::ranges::find(bound_, binding.name, &Bound::name); bound->image) {
            const VkSampler sampler =
                bound->sampler != VK_NULL_HANDLE ? bound->sampler : recorder_.context_.sampler({});
            images[i] = {sampler, bound->image.view, bound->image.state->layout};
        } else if (bound->structure) {
            structures[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR, nullptr, 1,
                             &bound->structure.structure};
            write.pNext = &structures[i];
        } else {
            buffers[i] = {bound->buffer.state->buffer, 0, VK_WHOLE_SIZE};
        }
        writes.push_back(write);
    }
    recorder_.context_.vk.vkUpdateDescriptorSets(recorder_.context_.handle(), static_cast<uint32_t>(writes.size()),
                                                 writes.data(), 0, nullptr);
    return set;
}

void Pass::prepare(const Pipeline& pipeline) {
    checkBindings(pipeline);
    collectUses(pipeline);
    emitBarriers();
    const VkPipelineBindPoint point = (pipeline.stages & VK_SHADER_STAGE_COMPUTE_BIT) != 0
                                          ? VK_PIPELINE_BIND_POINT_COMPUTE
                                          : VK_PIPELINE_BIND_POINT_GRAPHICS;
    const DeviceFunctions& vk = recorder_.context_.vk;
    vk.vkCmdBindPipeline(recorder_.commands_, point, pipeline.handle);
    const VkDescriptorSet set = writeSet(pipeline);
    vk.vkCmdBindDescriptorSets(recorder_.commands_, point, pipeline.layout, 0, 1, &set, 0, nullptr);
}

const Pipeline& Pass::startCompute() {
    const Pipeline& pipeline = recorder_.context_.pipelines().get(info_);
    prepare(pipeline);
    recorder_.beginTimer({name_, 0.0, boundBytes(), false});
    return pipeline;
}

void Pass::dispatch(uint32_t x, uint32_t y, uint32_t z) {
    if (recorder_.collects(info_)) {
        return;
    }
    const Pipeline& pipeline = startCompute();
    const glm::uvec3 groups = (glm::uvec3(x, y, z) + pipeline.localSize - 1U) / pipeline.localSize;
    recorder_.context_.vk.vkCmdDispatch(recorder_.commands_, groups.x, groups.y, groups.z);
    recorder_.endTimer();
}

void Pass::dispatchIndirect(BufferView arguments, VkDeviceSize offset) {
    if (recorder_.collects(info_)) {
        return;
    }
    use(arguments, {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, false});
    startCompute();
    recorder_.context_.vk.vkCmdDispatchIndirect(recorder_.commands_, arguments.state->buffer, offset);
    recorder_.endTimer();
}

// Attachments are declared by the name of the fragment shader's output; the pipeline needs them ordered by location.
void Pass::orderAttachments(const Pipeline& pipeline) {
    REFLET_CHECK(colors_.size() == pipeline.colorOutputs.size(), "{}: {} render targets for {} shader outputs", name_,
                 colors_.size(), pipeline.colorOutputs.size());
    for (const ShaderLocation& output : pipeline.colorOutputs) {
        const auto given = std::ranges::find(colors_, output.name, &Attachment::output);
        REFLET_CHECK(given != colors_.end(), "{}: no render target for the output '{}'", name_, output.name);
        REFLET_CHECK(static_cast<size_t>(given - colors_.begin()) == output.location,
                     "{}: the target '{}' is not in the order of its location {}", name_, output.name, output.location);
    }
}

void Pass::draw(const std::function<void(const DrawCommands&)>& record) {
    for (const Attachment& color : colors_) {
        info_.colorFormats.push_back(color.image.format);
    }
    if (recorder_.collects(info_)) {
        return;
    }
    const Pipeline& pipeline = recorder_.context_.pipelines().get(info_);
    orderAttachments(pipeline);
    prepare(pipeline);
    const uvec2 size = depth_ ? depth_.size : colors_.front().image.size;
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const Attachment& color : colors_) {
        VkClearValue value{};
        value.color = color.clear.value_or(VkClearColorValue{});
        colors.push_back(attachmentInfo(color.image, color.clear.has_value(), value));
    }
    VkClearValue clearDepth{};
    clearDepth.depthStencil = {clearDepth_.value_or(0.0F), 0};
    const VkRenderingAttachmentInfo depth = attachmentInfo(depth_, clearDepth_.has_value(), clearDepth);
    VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
    rendering.renderArea = {{0, 0}, {size.x, size.y}};
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = static_cast<uint32_t>(colors.size());
    rendering.pColorAttachments = colors.data();
    rendering.pDepthAttachment = depth_ ? &depth : nullptr;

    const DeviceFunctions& vk = recorder_.context_.vk;
    const VkCommandBuffer commands = recorder_.commands_;
    recorder_.beginTimer({name_, 0.0, boundBytes(), true});
    vk.vkCmdBeginRendering(commands, &rendering);
    const VkViewport viewport{0, 0, static_cast<float>(size.x), static_cast<float>(size.y), 0, 1};
    vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    vk.vkCmdSetScissor(commands, 0, 1, &rendering.renderArea);
    vk.vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    vk.vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    record({recorder_.context_, commands, pipeline.layout});
    vk.vkCmdEndRendering(commands);
    recorder_.endTimer();
}

}  // namespace reflet::gpu
