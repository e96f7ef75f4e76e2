// Plans and records the passes of a frame.
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
// Frames for which a plan stays that is not used.
constexpr uint64_t planFrames = 8;
// Frames in a row that need less than half of the memory before it is given back.
constexpr uint32_t mostRoomyFrames = 16;

Buffer makeUniforms(Context& context) {
    return {context, uniformBytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryUse::upload, "uniforms"};
}

}  // namespace

// The other constructor first, so that the destructor runs if something fails here.
Recorder::Recorder(Context& context, uint32_t framesInFlight) : Recorder(context, WithoutSlots{}) {
    REFLET_CHECK(framesInFlight >= 1 && framesInFlight <= maxFramesInFlight, "{} frames in flight", framesInFlight);
    slots_.resize(framesInFlight);
    for (Slot& slot : slots_) {
        slot.uniforms.push_back({makeUniforms(context), nextResourceId()});
        timers_.makePool(slot.timed);
    }
}

Recorder::~Recorder() {
    for (Slot& slot : slots_) {
        if (slot.serial != 0) {
            context().finishWork(slot.serial);
        }
        timers_.destroy(slot.timed);
    }
}

void Recorder::start() {
    clearFrame();
    open_ = true;
    listsOfFrame_ = 0;
    counting_ = {};
    listing_ = {};
    began_ = std::chrono::steady_clock::now();
    for (GraphHeap& heap : memory_.heaps()) {
        heap.taken.clear();
    }
    if (tidies_) {
        plans_.clear();
        memory_.release();
        tidies_ = false;
    }
}

void Recorder::begin(VkCommandBuffer commands) {
    ++number_;
    finish(slot());
    Slot& now = slot();
    if (now.uniforms.size() > now.uniformBlock + 1) {
        now.uniforms.resize(now.uniformBlock + 1);  // what the last frame needed
    }
    now.uniformBlock = 0;
    now.uniformsUsed = 0;
    now.serial = context().beginWork();
    start();
    commands_ = commands;
    timers_.reset(now.timed, commands);
}

void Recorder::prepare(std::vector<PipelineInfo>& missing) {
    preparation_ = context().beginWork();
    start();
    missing_ = &missing;
}

void Recorder::end() {
    if (open_) {
        flush();
        dropUnused();
        counting_.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began_).count();
        counted_ = counting_;
    }
    open_ = false;
    commands_ = VK_NULL_HANDLE;
    missing_ = nullptr;
    if (preparation_ != 0) {
        context().finishWork(preparation_);
        preparation_ = 0;
    }
}

void Recorder::finish() {
    for (uint64_t i = 1; i <= slots_.size(); ++i) {  // from the oldest
        finish(slots_[(number_ + i) % slots_.size()]);
    }
}

void Recorder::finish(Slot& slot) {
    if (slot.serial == 0) {
        return;
    }
    context().finishWork(slot.serial);
    slot.serial = 0;
    timers_.read(slot.timed, times_);
    finished_ = static_cast<size_t>(&slot - slots_.data());
}

std::span<const std::byte> Recorder::bytes(Readback readback) const {
    return slots_[finished_].readbacks.at(readback.index).bytes();
}

uint32_t Recorder::listed(const Image& view) {
    ImageState& state = *view.state;
    if (state.mark.list == listNumber() && state.mark.owner == this) {
        return state.mark.index;
    }
    state.mark = {this, listNumber(), static_cast<uint32_t>(resources_.size())};
    resources_.push_back({view, {}});
    GraphResource& resource = graph_.resources.emplace_back();
    ImageInfo& info = infos_.emplace_back();
    resource.image = true;
    TransientImage* transient = state.transient >= 0 ? &transientOf(state) : nullptr;
    if (transient == nullptr || transient->list != listNumber()) {
        resource.undefined = state.layout == VK_IMAGE_LAYOUT_UNDEFINED;
        resource.before = state.access;
        return state.mark.index;
    }
    if (transient->needs.size == 0) {
        transient->needs = memory_.needsOf(transient->info);
    }
    info = transient->info;
    resource.transient = true;
    resource.output = transient->kept;
    resource.heap = transient->needs.heap;
    resource.size = transient->needs.size;
    resource.alignment = transient->needs.alignment;
    return state.mark.index;
}

uint32_t Recorder::listed(const BufferView& view) {
    BufferState& state = *view.state;
    if (state.mark.list == listNumber() && state.mark.owner == this) {
        return state.mark.index;
    }
    state.mark = {this, listNumber(), static_cast<uint32_t>(resources_.size())};
    resources_.push_back({{}, view});
    GraphResource& resource = graph_.resources.emplace_back();
    infos_.emplace_back();
    TransientBuffer* transient = state.transient >= 0 ? &transientOf(state) : nullptr;
    if (transient == nullptr || transient->list != listNumber()) {
        resource.before = state.access;
        return state.mark.index;
    }
    if (transient->needs.size == 0) {
        transient->needs = memory_.needsOf(transient->size);
    }
    resource.transient = true;
    resource.output = transient->kept;
    resource.heap = transient->needs.heap;
    resource.size = transient->needs.size;
    resource.alignment = transient->needs.alignment;
    infos_.back().size = uvec2(transient->size & 0xFFFFFFFFU, transient->size >> 32U);
    return state.mark.index;
}

void Recorder::makeGraph() {
    graph_.passes.clear();
    graph_.uses.clear();
    graph_.resources.clear();
    infos_.clear();
    resources_.clear();
    for (PassRecord* pass : passes()) {
        const auto first = static_cast<uint32_t>(graph_.uses.size());
        for (const auto& [image, access] : pass->imageUses) {
            graph_.uses.push_back({listed(image), access});
        }
        for (const auto& [buffer, access] : pass->bufferUses) {
            graph_.uses.push_back({listed(buffer), access});
        }
        graph_.passes.push_back(
            {first, static_cast<uint32_t>(graph_.uses.size()) - first, pass->kind == PassKind::readback});
    }
    graph_.heaps = memory_.heaps();
}

Recorder::CachedPlan& Recorder::planned() {
    const auto known = std::ranges::find_if(
        plans_, [&](const auto& cached) { return cached->infos == infos_ && cached->graph == graph_; });
    if (known != plans_.end()) {
        (*known)->lastUse = number_;
        return **known;
    }
    ++counting_.plans;
    auto made = std::make_unique<CachedPlan>();
    made->graph = graph_;
    made->infos = infos_;
    made->plan = compile(graph_);
    made->lastUse = number_;
    place(*made);
    return *plans_.emplace_back(std::move(made));
}

void Recorder::place(CachedPlan& cached) {
    memory_.reserve(cached.plan.ends);
    cached.graph.heaps = memory_.heaps();  // with the new blocks, as the next frame has them
    cached.images.resize(resources_.size());
    cached.buffers.resize(resources_.size());
    for (size_t r = 0; r < resources_.size(); ++r) {
        const VkDeviceSize offset = cached.plan.offsets[r];
        if (offset == Plan::unplaced) {
            continue;
        }
        if (resources_[r].image) {
            const TransientImage& image = transientOf(*resources_[r].image.state);
            cached.images[r] = memory_.image(image.info, offset, std::string(image.name));
        } else {
            cached.buffers[r] = memory_.buffer(transientOf(*resources_[r].buffer.state).size, offset);
        }
    }
}

void Recorder::applyPlaces(const CachedPlan& cached) {
    for (size_t r = 0; r < resources_.size(); ++r) {
        if (cached.images[r]) {
            ImageState& state = *resources_[r].image.state;
            const ImageState& placed = cached.images[r]->state;
            state.image = placed.image;
            state.view = placed.view;
            state.id = placed.id;
        } else if (cached.buffers[r]) {
            BufferState& state = *resources_[r].buffer.state;
            state.buffer = cached.buffers[r]->state.buffer;
            state.id = cached.buffers[r]->state.id;
        }
        if (resources_[r].image && cached.plan.lifetimes[r].first != UINT32_MAX) {
            resources_[r].image.state->layout = VK_IMAGE_LAYOUT_GENERAL;
        }
    }
}

// Some of the passes were recorded, and a host may submit them: what comes next waits for everything.
void Recorder::noteFailure(const CachedPlan& cached) {
    const AccessState unknown{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT, 0, 0, 0};
    for (size_t r = 0; r < resources_.size(); ++r) {
        const Listed& of = resources_[r];
        (of.image ? of.image.state->access : of.buffer.state->access) = unknown;
        if (cached.graph.resources[r].undefined) {
            of.image.state->layout = VK_IMAGE_LAYOUT_UNDEFINED;
        }
    }
    for (GraphHeap& heap : memory_.heaps()) {
        heap.before = {unknown.writeStages, unknown.writeAccess, true};
    }
}

// What is only prepared stays without a layout.
void Recorder::noteLayouts(const CachedPlan& cached) {
    for (size_t r = 0; r < resources_.size() && missing_ != nullptr; ++r) {
        if (cached.graph.resources[r].undefined) {
            resources_[r].image.state->layout = VK_IMAGE_LAYOUT_UNDEFINED;
        }
    }
}

void Recorder::makePipelines(const Plan& plan) {
    PipelineCache& pipelines = context().pipelines();
    for (const uint32_t i : plan.order) {
        PassRecord& pass = *passes()[i];
        if (pass.kind != PassKind::compute && pass.kind != PassKind::raster) {
            continue;
        }
        if (missing_ != nullptr) {
            if (!pipelines.has(pass.info) && std::ranges::find(*missing_, pass.info) == missing_->end()) {
                missing_->push_back(pass.info);
            }
        } else if (pass.pipeline == nullptr || !(pass.madeInfo == pass.info)) {
            pass.pipeline = &pipelines.get(pass.info);
            pass.madeInfo = pass.info;
        }
    }
}

void Recorder::flush() {
    if (passes().empty()) {
        return;
    }
    makeGraph();
    const CachedPlan& cached = planned();
    makePipelines(cached.plan);
    applyPlaces(cached);
    if (missing_ == nullptr) {
        try {
            record(cached);
        } catch (...) {
            noteFailure(cached);
            throw;
        }
        noteAfter(cached);
        if (lists_) {
            addToListing(cached);
        }
    }
    noteLayouts(cached);
    for (size_t r = 0; r < resources_.size(); ++r) {
        const GraphResource& resource = cached.graph.resources[r];
        if (resource.output && cached.plan.offsets[r] != Plan::unplaced) {
            memory_.heaps()[resource.heap].taken.push_back({cached.plan.offsets[r], resource.size});
        }
    }
    ++listsOfFrame_;
    nextList(missing_ == nullptr);
}

void Recorder::noteAfter(const CachedPlan& cached) {
    for (size_t r = 0; r < resources_.size(); ++r) {
        if (cached.plan.lifetimes[r].first == UINT32_MAX) {
            continue;
        }
        const AccessState& after = cached.plan.after[r];
        const Listed& of = resources_[r];
        (of.image ? of.image.state->access : of.buffer.state->access) = after;
        const int32_t transient = of.image ? of.image.state->transient : of.buffer.state->transient;
        if (transient >= 0) {  // whoever gets its memory waits for this
            const uint32_t heap =
                of.image ? transientOf(*of.image.state).needs.heap : transientOf(*of.buffer.state).needs.heap;
            Access& before = memory_.heaps()[heap].before;
            before = merged(before, {after.writeStages | after.readStages, after.writeAccess, after.writeAccess != 0});
        }
    }
}

void Recorder::record(const CachedPlan& cached) {
    const Plan& plan = cached.plan;
    counting_.passes += static_cast<uint32_t>(plan.order.size());
    counting_.dropped += static_cast<uint32_t>(passes().size() - plan.order.size());
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
            now.uniforms.push_back({makeUniforms(context()), nextResourceId()});
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

namespace {

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
            const auto [buffer, offset] = memory_.blockAt(resource.heap, plan.offsets[r]);
            vk.vkCmdFillBuffer(commands_, buffer, offset, resource.size / 4 * 4, ~0U);
        }
    }
    vk.vkCmdPipelineBarrier2(commands_, &info);
}

void Recorder::addToListing(const CachedPlan& cached) {
    const Plan& plan = cached.plan;
    const auto firstPass = static_cast<int>(listing_.passes.size());
    std::vector<std::string> names;
    for (size_t r = 0; r < resources_.size(); ++r) {
        PassListing::Resource& shown = listing_.resources.emplace_back();
        const Listed& of = resources_[r];
        const GraphResource& resource = cached.graph.resources[r];
        shown.bytes = resource.transient ? resource.size : of.image ? of.image.state->bytes : of.buffer.state->bytes;
        if (of.image) {
            shown.name =
                of.image.state->transient >= 0 ? std::string(transientOf(*of.image.state).name) : of.image.state->name;
            shown.format = formatName(of.image.format);
            shown.size = of.image.size;
        } else {
            shown.name = of.buffer.state->transient >= 0 ? std::string(transientOf(*of.buffer.state).name)
                                                         : of.buffer.state->name;
        }
        names.push_back(shown.name);
        if (resource.transient && plan.offsets[r] != Plan::unplaced) {
            shown.first = firstPass + static_cast<int>(plan.lifetimes[r].first);
            shown.last = firstPass + static_cast<int>(std::min<size_t>(plan.lifetimes[r].last, plan.order.size() - 1));
            shown.offset = plan.offsets[r];
        }
    }
    for (size_t i = 0; i < plan.order.size(); ++i) {
        const PassRecord& pass = *passes()[plan.order[i]];
        PassListing::Pass& shown = listing_.passes.emplace_back();
        shown.name = pass.name;
        shown.raster = pass.kind == PassKind::raster;
        shown.bytes = pass.boundBytes;
        shown.level = plan.levels[i];
        const GraphPass& uses = cached.graph.passes[plan.order[i]];
        for (uint32_t u = uses.firstUse; u < uses.firstUse + uses.useCount; ++u) {
            const ResourceUse& use = cached.graph.uses[u];
            (use.access.write ? shown.writes : shown.reads).push_back(names[use.resource]);
        }
    }
}

// Plans that have not been used for a while, and memory that is scattered or much too large. Where one list makes a
// frame, its memory is one block of the right size from the third frame on.
void Recorder::dropUnused() {
    std::erase_if(plans_, [&](const auto& cached) { return cached->lastUse + planFrames < number_; });
    if (listsOfFrame_ != 1 || missing_ != nullptr) {
        roomyFrames_ = 0;
        return;
    }
    VkDeviceSize used = 0;
    for (const auto& cached : plans_) {
        VkDeviceSize sum = 0;
        for (const VkDeviceSize end : cached->plan.ends) {
            sum += end;
        }
        used = std::max(used, sum);
    }
    roomyFrames_ = 2 * used < memory_.bytes() ? roomyFrames_ + 1 : 0;
    tidies_ = roomyFrames_ > mostRoomyFrames || (memory_.blockCount() > 1 && counting_.plans > 0);
}

}  // namespace reflet::gpu
