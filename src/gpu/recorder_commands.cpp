// Records the commands of planned passes.
#include "gpu/recorder.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>
#include <cstring>

namespace reflet::gpu {

namespace {

// Of a block; a frame of many passes takes several.
constexpr VkDeviceSize uniformBytes = VkDeviceSize(1) << 20U;
constexpr VkDeviceSize maxUpdateBytes = 65536;

VkRenderingAttachmentInfo attachmentInfo(const Image& image, bool clear, VkClearValue value) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = image.view();
    info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
    info.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    info.clearValue = value;
    return info;
}

VkImageSubresourceLayers firstLevel(const Image& image) {
    return {aspectOf(image.format), 0, 0, 1};
}

}  // namespace

Recorder::UniformBlock Recorder::makeUniforms() {
    return {Buffer(context(), uniformBytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryUse::upload, "uniforms"),
            nextResourceId()};
}

void Recorder::record(const CachedPlan& cached) {
    const Plan& plan = cached.plan;
    counting_.passes += static_cast<uint32_t>(plan.order.size());
    counting_.barriers += static_cast<uint32_t>(plan.barriers.size());
    bool readsBack = false;
    size_t barrier = 0;
    for (uint32_t i = 0; i < plan.order.size(); ++i) {
        if (poisons_) {
            poison(cached, i, true);
        }
        if (barrier < plan.barriers.size() && plan.barriers[barrier].before == i) {
            recordBarrier(plan.barriers[barrier++]);
        }
        PassRecord& pass = *passes()[plan.order[i]];
        readsBack = readsBack || pass.kind == PassKind::readback;
        recordPass(pass);
        if (poisons_) {
            poison(cached, i, false);
        }
    }
    if (readsBack) {
        VkMemoryBarrier2 toHost{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
        toHost.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        toHost.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        toHost.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
        toHost.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
        VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.memoryBarrierCount = 1;
        info.pMemoryBarriers = &toHost;
        context().vk.vkCmdPipelineBarrier2(commands_, &info);
    }
}

void Recorder::recordBarrier(const PlannedBarrier& barrier) {
    VkMemoryBarrier2 memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    memory.srcStageMask = barrier.from.stages;
    memory.srcAccessMask = barrier.from.access;
    memory.dstStageMask = barrier.to.stages;
    memory.dstAccessMask = barrier.to.access;
    imageBarriers_.clear();
    for (const Transition& transition : barrier.transitions) {
        VkImageMemoryBarrier2 first{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        first.srcStageMask = transition.from.stages;
        first.srcAccessMask = transition.from.access;
        first.dstStageMask = transition.to.stages;
        first.dstAccessMask = transition.to.access;
        first.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        first.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        first.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        first.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        first.image = resources_[transition.resource].image.state->image;
        // Colour and depth alike: all that there is.
        first.subresourceRange = {resources_[transition.resource].image.state->aspect, 0, VK_REMAINING_MIP_LEVELS, 0,
                                  VK_REMAINING_ARRAY_LAYERS};
        imageBarriers_.push_back(first);
    }
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = memory.srcStageMask != 0 ? 1 : 0;
    info.pMemoryBarriers = &memory;
    info.imageMemoryBarrierCount = static_cast<uint32_t>(imageBarriers_.size());
    info.pImageMemoryBarriers = imageBarriers_.data();
    context().vk.vkCmdPipelineBarrier2(commands_, &info);
}

Recorder::UniformSlice Recorder::uploadUniforms(const PassRecord& pass) {
    Slot& now = slot();
    const VkDeviceSize alignment = std::max<VkDeviceSize>(context().limits().minUniformBufferOffsetAlignment, 1);
    VkDeviceSize size = 0;
    for (const ShaderBinding& binding : pass.interface->bindings) {  // two stages may have one block each of a name
        const bool block = binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        size = block ? alignUp(size, alignment) + binding.blockSize : size;
    }
    REFLET_CHECK(size <= uniformBytes, "{}: uniform blocks of {} bytes", pass.name, size);
    VkDeviceSize offset = alignUp(now.uniformsUsed, alignment);
    if (offset + size > uniformBytes) {
        offset = 0;
        if (now.uniformBlock + 1 == now.uniforms.size()) {
            now.uniforms.push_back(makeUniforms());
        }
        ++now.uniformBlock;  // only now: a host may go on with the frame after a failure
    }
    const UniformBlock& block = now.uniforms[now.uniformBlock];
    now.uniformsUsed = offset;
    dynamicOffsets_.clear();
    const std::vector<ShaderBinding>& bindings = pass.interface->bindings;
    for (size_t i = 0; i < bindings.size(); ++i) {
        if (bindings[i].type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER) {
            now.uniformsUsed = alignUp(now.uniformsUsed, alignment);
            std::memcpy(block.buffer.bytes().data() + now.uniformsUsed, pass.bytes.data() + pass.boundOf[i],
                        bindings[i].blockSize);
            dynamicOffsets_.push_back(static_cast<uint32_t>(now.uniformsUsed));
            now.uniformsUsed += bindings[i].blockSize;
        }
    }
    return {&block, offset};
}

void Recorder::bindPass(PassRecord& pass, VkPipelineBindPoint point) {
    const UniformSlice uniforms = uploadUniforms(pass);
    const uint64_t finished = number_ > slots_.size() ? number_ - slots_.size() : 0;
    const VkDescriptorSet set =
        sets_.setOf(pass, {uniforms.block->buffer.handle(), uniforms.block->id}, number_, finished);
    const DeviceFunctions& vk = context().vk;
    vk.vkCmdBindPipeline(commands_, point, pass.pipeline->handle);
    vk.vkCmdBindDescriptorSets(commands_, point, pass.pipeline->layout, 0, 1, &set,
                               static_cast<uint32_t>(dynamicOffsets_.size()), dynamicOffsets_.data());
}

void Recorder::recordPass(PassRecord& pass) {
    if (pass.kind != PassKind::compute && pass.kind != PassKind::raster) {
        recordTransfer(pass);
        return;
    }
    const bool raster = pass.kind == PassKind::raster;
    bindPass(pass, raster ? VK_PIPELINE_BIND_POINT_GRAPHICS : VK_PIPELINE_BIND_POINT_COMPUTE);
    Slot& now = slot();
    timers_.begin(now.timed, commands_, {pass.name, pass.nameIndex, pass.boundBytes, raster});
    const DeviceFunctions& vk = context().vk;
    if (raster) {
        recordDraw(pass);
    } else if (pass.arguments) {
        vk.vkCmdDispatchIndirect(commands_, pass.arguments.state->buffer, pass.argumentsOffset);
    } else {
        vk.vkCmdDispatch(commands_, pass.groups.x, pass.groups.y, pass.groups.z);
    }
    timers_.end(now.timed, commands_);
    if (betweenPasses_) {
        betweenPasses_();
    }
}

void Recorder::recordDraw(PassRecord& pass) {
    const uvec2 size = pass.depth ? pass.depth.size : pass.colors.front().image.size;
    attachments_.clear();
    for (const Attachment& color : pass.colors) {
        VkClearValue value{};
        value.color = color.clear.value_or(VkClearColorValue{});
        attachments_.push_back(attachmentInfo(color.image, color.clear.has_value(), value));
    }
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    if (pass.depth) {
        VkClearValue value{};
        value.depthStencil = {pass.clearDepth.value_or(0.0F), 0};
        depth = attachmentInfo(pass.depth, pass.clearDepth.has_value(), value);
    }
    VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
    rendering.renderArea = {{0, 0}, {size.x, size.y}};
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = static_cast<uint32_t>(attachments_.size());
    rendering.pColorAttachments = attachments_.data();
    rendering.pDepthAttachment = pass.depth ? &depth : nullptr;
    const DeviceFunctions& vk = context().vk;
    vk.vkCmdBeginRendering(commands_, &rendering);
    const VkViewport viewport{0, 0, static_cast<float>(size.x), static_cast<float>(size.y), 0, 1};
    vk.vkCmdSetViewport(commands_, 0, 1, &viewport);
    vk.vkCmdSetScissor(commands_, 0, 1, &rendering.renderArea);
    vk.vkCmdSetCullMode(commands_, VK_CULL_MODE_NONE);
    vk.vkCmdSetFrontFace(commands_, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    pass.draw({context(), commands_, pass.pipeline->layout});
    vk.vkCmdEndRendering(commands_);
}

void Recorder::recordTransfer(const PassRecord& pass) {
    const DeviceFunctions& vk = context().vk;
    constexpr VkImageLayout general = VK_IMAGE_LAYOUT_GENERAL;
    switch (pass.kind) {
        case PassKind::clear: {
            const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                              VK_REMAINING_ARRAY_LAYERS};
            vk.vkCmdClearColorImage(commands_, pass.to.state->image, general, &pass.clear, 1, &all);
            break;
        }
        case PassKind::update:
            for (size_t start = 0; start < pass.bytes.size(); start += maxUpdateBytes) {
                const size_t size = std::min<size_t>(pass.bytes.size() - start, maxUpdateBytes);
                vk.vkCmdUpdateBuffer(commands_, pass.buffer.state->buffer, start, size, pass.bytes.data() + start);
            }
            break;
        case PassKind::upload: {
            VkBufferImageCopy copy{};
            copy.imageSubresource = firstLevel(pass.to);
            copy.imageExtent = {pass.to.size.x, pass.to.size.y, 1};
            vk.vkCmdCopyBufferToImage(commands_, pass.staging->handle(), pass.to.state->image, general, 1, &copy);
            break;
        }
        case PassKind::copy: {
            VkImageCopy copy{};
            copy.srcSubresource = firstLevel(pass.from);
            copy.dstSubresource = copy.srcSubresource;
            copy.extent = {pass.from.size.x, pass.from.size.y, 1};
            vk.vkCmdCopyImage(commands_, pass.from.state->image, general, pass.to.state->image, general, 1, &copy);
            break;
        }
        default:
            recordReadback(pass);
            break;
    }
}

void Recorder::recordReadback(const PassRecord& pass) {
    const Image& image = pass.from;
    const VkDeviceSize size = VkDeviceSize(image.size.x) * image.size.y * bytesPerTexel(image.format);
    std::vector<Buffer>& readbacks = slot().readbacks;
    if (pass.readback >= readbacks.size() || readbacks[pass.readback].view().size != size) {
        readbacks.resize(std::max(readbacks.size(), pass.readback + 1));
        readbacks[pass.readback] =
            Buffer(context(), size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback, "readback");
    }
    VkBufferImageCopy copy{};
    copy.imageSubresource = firstLevel(image);
    copy.imageExtent = {image.size.x, image.size.y, 1};
    context().vk.vkCmdCopyImageToBuffer(commands_, image.state->image, VK_IMAGE_LAYOUT_GENERAL,
                                        readbacks[pass.readback].handle(), 1, &copy);
}

void Recorder::poison(const CachedPlan& cached, uint32_t position, bool before) {
    const Plan& plan = cached.plan;
    const DeviceFunctions& vk = context().vk;
    VkMemoryBarrier2 all{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    all.srcStageMask = all.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    all.srcAccessMask = all.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &all;
    vk.vkCmdPipelineBarrier2(commands_, &info);
    for (uint32_t r = 0; r < plan.offsets.size(); ++r) {
        if (plan.offsets[r] != Plan::unplaced &&
            (before ? plan.lifetimes[r].first : plan.lifetimes[r].last) == position) {
            const GraphResource& resource = cached.graph.resources[r];
            const auto [buffer, offset] = memory().blockAt(resource.heap, plan.offsets[r]);
            vk.vkCmdFillBuffer(commands_, buffer, offset, resource.size / 4 * 4, ~0U);
        }
    }
    vk.vkCmdPipelineBarrier2(commands_, &info);
}

}  // namespace reflet::gpu
