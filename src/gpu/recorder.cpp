// Records the passes of a frame.
#include "gpu/recorder.h"

#include "base/error.h"
#include "gpu/barrier.h"
#include "gpu/context.h"

#include <algorithm>
#include <cstring>

namespace reflet::gpu {

namespace {

// Of a block; a frame of many passes takes several.
constexpr VkDeviceSize uniformBytes = VkDeviceSize(1) << 20U;
constexpr uint32_t passesPerBlock = 256;
constexpr uint32_t queriesPerPass = 3;
constexpr VkDeviceSize maxUpdateBytes = 65536;

VkDescriptorPool makeDescriptorPool(Context& context) {
    std::vector<VkDescriptorPoolSize> sizes{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 2 * passesPerBlock},
                                            {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2 * passesPerBlock},
                                            {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 4 * passesPerBlock},
                                            {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8 * passesPerBlock}};
    if (context.hasRayQuery()) {
        sizes.push_back({VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, passesPerBlock});
    }
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = passesPerBlock;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    ++context.counts().descriptorPools;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateDescriptorPool(context.handle(), &info, nullptr, &pool), "creating a descriptor pool");
    return pool;
}

Buffer makeUniforms(Context& context) {
    return {context, uniformBytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryUse::upload, "uniforms"};
}

VkQueryPool makeQueryPool(Context& context) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = queriesPerPass * passesPerBlock;
    VkQueryPool pool = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateQueryPool(context.handle(), &info, nullptr, &pool), "creating a query pool");
    return pool;
}

}  // namespace

// The other constructor first, so that the destructor runs if something fails here.
Recorder::Recorder(Context& context, uint32_t framesInFlight) : Recorder(context, WithoutSlots{}) {
    REFLET_CHECK(framesInFlight >= 1 && framesInFlight <= maxFramesInFlight, "{} frames in flight", framesInFlight);
    slots_.resize(framesInFlight);
    for (Slot& slot : slots_) {
        slot.uniforms.push_back(makeUniforms(context));
        slot.descriptorPools.push_back(makeDescriptorPool(context));
        slot.queries.push_back(makeQueryPool(context));
    }
}

Recorder::~Recorder() {
    for (Slot& slot : slots_) {
        if (slot.serial != 0) {
            context_.finishWork(slot.serial);
        }
        for (const VkDescriptorPool pool : slot.descriptorPools) {
            context_.vk.vkDestroyDescriptorPool(context_.handle(), pool, nullptr);
        }
        for (const VkQueryPool pool : slot.queries) {
            context_.vk.vkDestroyQueryPool(context_.handle(), pool, nullptr);
        }
    }
}

void Recorder::begin(VkCommandBuffer commands) {
    ++number_;
    finish(slot());
    giveBack(frameImages_, frameBuffers_);
    frameImages_.clear();
    frameBuffers_.clear();
    Slot& now = slot();
    for (const VkDescriptorPool pool : now.descriptorPools) {
        vkCheck(context_.vk.vkResetDescriptorPool(context_.handle(), pool, 0), "resetting descriptors");
    }
    now.descriptorPool = 0;
    now.uniforms.resize(std::min(now.uniforms.size(), now.uniformBlock + 1));  // what the last frame needed
    now.uniformBlock = 0;
    now.uniformsUsed = 0;
    now.readbacksUsed = 0;
    now.timed.clear();
    now.serial = context_.beginWork();
    commands_ = commands;
    for (const VkQueryPool pool : now.queries) {
        context_.vk.vkCmdResetQueryPool(commands_, pool, 0, queriesPerPass * passesPerBlock);
    }
}

void Recorder::end() {
    if (!isCollecting()) {
        dropUnused();
    }
    commands_ = VK_NULL_HANDLE;
    missing_ = nullptr;
}

void Recorder::collect(std::vector<PipelineInfo>& missing) {
    missing_ = &missing;
}

bool Recorder::collects(const PipelineInfo& info) {
    if (!isCollecting()) {
        return false;
    }
    if (!context_.pipelines().has(info) && std::ranges::find(*missing_, info) == missing_->end()) {
        missing_->push_back(info);
    }
    return true;
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
    context_.finishWork(slot.serial);
    slot.serial = 0;
    readTimers(slot);
    finished_ = static_cast<size_t>(&slot - slots_.data());
}

std::pair<VkQueryPool, uint32_t> Recorder::timestamp(uint32_t which) {
    Slot& now = slot();
    const auto pass = static_cast<uint32_t>(now.timed.size() - 1);
    if (pass / passesPerBlock == now.queries.size()) {
        now.queries.push_back(makeQueryPool(context_));
        context_.vk.vkCmdResetQueryPool(commands_, now.queries.back(), 0, queriesPerPass * passesPerBlock);
    }
    return {now.queries[pass / passesPerBlock], queriesPerPass * (pass % passesPerBlock) + which};
}

void Recorder::beginTimer(const PassTime& pass) {
    context_.beginLabel(commands_, pass.name);
    slot().timed.push_back(pass);
    // The second timestamp is never read. llvmpipe takes a timestamp only when the next one flushes it, which otherwise
    // would be after the pass.
    for (const uint32_t which : {0U, 1U}) {
        const auto [pool, query] = timestamp(which);
        context_.vk.vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, query);
    }
}

void Recorder::endTimer() {
    const auto [pool, query] = timestamp(2);
    context_.vk.vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, query);
    context_.endLabel(commands_);
    if (betweenPasses_) {
        betweenPasses_();
    }
}

void Recorder::readTimers(Slot& slot) {
    const std::vector<PassTime>& timed = slot.timed;
    times_.clear();
    if (timed.empty()) {
        return;
    }
    std::vector<uint64_t> ticks(queriesPerPass * timed.size());
    constexpr size_t perBlock = size_t(queriesPerPass) * passesPerBlock;
    for (size_t first = 0; first < ticks.size(); first += perBlock) {
        const std::span<uint64_t> block = std::span(ticks).subspan(first, std::min(perBlock, ticks.size() - first));
        const VkResult result = context_.vk.vkGetQueryPoolResults(
            context_.handle(), slot.queries[first / perBlock], 0, static_cast<uint32_t>(block.size()),
            block.size_bytes(), block.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
        if (result == VK_NOT_READY) {  // the commands were never submitted
            return;
        }
        vkCheck(result, "reading timestamps");
    }
    const double tick = context_.limits().timestampPeriod * 1e-6;
    times_.push_back({"frame", static_cast<double>(ticks.back() - ticks.front()) * tick});
    for (size_t i = 0; i < timed.size(); ++i) {
        const double ms = static_cast<double>(ticks[queriesPerPass * i + 2] - ticks[queriesPerPass * i]) * tick;
        auto same = std::ranges::find(times_, timed[i].name, &PassTime::name);
        if (same == times_.end()) {
            same = times_.insert(times_.end(), {timed[i].name, 0.0, 0, timed[i].raster});
        }
        same->ms += ms;
        same->bytes += timed[i].bytes;
        times_.front().bytes += timed[i].bytes;
    }
}

Pass Recorder::compute(std::string_view name, std::string_view shader) {
    return {*this, nameOf(name), {std::string(shader)}};
}

Pass Recorder::raster(std::string_view name, std::vector<std::string> shaders) {
    return {*this, nameOf(name), std::move(shaders)};
}

void Recorder::update(BufferView buffer, std::span<const std::byte> bytes) {
    if (isCollecting()) {
        return;
    }
    REFLET_CHECK(bytes.size() <= buffer.size && bytes.size() % 4 == 0, "{} bytes", bytes.size());
    BarrierBatch batch;
    batch.use(buffer.state->access, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true});
    batch.record(context_.vk, commands_);
    for (size_t start = 0; start < bytes.size(); start += maxUpdateBytes) {
        const auto part = bytes.subspan(start, std::min<size_t>(bytes.size() - start, maxUpdateBytes));
        context_.vk.vkCmdUpdateBuffer(commands_, buffer.state->buffer, start, part.size(), part.data());
    }
}

void Recorder::readByDraws(BufferView buffer) {
    if (isCollecting()) {
        return;
    }
    BarrierBatch batch;
    batch.use(buffer.state->access,
              {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, false});
    batch.record(context_.vk, commands_);
}

void Recorder::clear(Image image, const VkClearColorValue& value) {
    if (isCollecting()) {
        return;
    }
    BarrierBatch batch;
    batch.use(*image.state, aspectOf(image.format),
              {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true});
    batch.record(context_.vk, commands_);
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                      VK_REMAINING_ARRAY_LAYERS};
    context_.vk.vkCmdClearColorImage(commands_, image.state->image, VK_IMAGE_LAYOUT_GENERAL, &value, 1, &all);
}

void Recorder::upload(Image image, std::span<const std::byte> texels) {
    if (isCollecting()) {
        return;
    }
    REFLET_CHECK(texels.size() == size_t(image.size.x) * image.size.y * bytesPerTexel(image.format),
                 "{} bytes for {}x{}", texels.size(), image.size.x, image.size.y);
    const Buffer staging(context_, texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::upload, "staging");
    std::memcpy(staging.bytes().data(), texels.data(), texels.size());
    BarrierBatch batch;
    batch.use(*image.state, aspectOf(image.format),
              {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true});
    batch.record(context_.vk, commands_);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {aspectOf(image.format), 0, 0, 1};
    copy.imageExtent = {image.size.x, image.size.y, 1};
    context_.vk.vkCmdCopyBufferToImage(commands_, staging.handle(), image.state->image, VK_IMAGE_LAYOUT_GENERAL, 1,
                                       &copy);
}

void Recorder::copy(Image from, Image to) {
    if (isCollecting()) {
        return;
    }
    REFLET_CHECK(from.format == to.format && from.size == to.size, "a copy between images of different kinds");
    BarrierBatch batch;
    batch.use(*from.state, aspectOf(from.format),
              {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, false});
    batch.use(*to.state, aspectOf(to.format),
              {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true});
    batch.record(context_.vk, commands_);
    VkImageCopy copy{};
    copy.srcSubresource = {aspectOf(from.format), 0, 0, 1};
    copy.dstSubresource = copy.srcSubresource;
    copy.extent = {from.size.x, from.size.y, 1};
    context_.vk.vkCmdCopyImage(commands_, from.state->image, VK_IMAGE_LAYOUT_GENERAL, to.state->image,
                               VK_IMAGE_LAYOUT_GENERAL, 1, &copy);
}

Image Recorder::image(std::string_view /*name*/, VkFormat format, uvec2 size, uint32_t layers, bool array) {
    frameImages_.push_back(takeImage(storageInfo(format, size, layers, array)));
    return pooledImage(frameImages_.back());
}

Image Recorder::target(std::string_view /*name*/, VkFormat format, uvec2 size) {
    frameImages_.push_back(takeImage(targetInfo(format, size)));
    return pooledImage(frameImages_.back());
}

BufferView Recorder::buffer(std::string_view /*name*/, VkDeviceSize size) {
    frameBuffers_.push_back(takeBuffer(size));
    return pooledBuffer(frameBuffers_.back());
}

Image Recorder::placeholder(VkFormat format, ViewKind view) {
    Texture& texture = placeholders_[{format, view}];
    if (texture.info().size.x == 0) {
        const VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        const uint32_t layers = view == ViewKind::cube || view == ViewKind::cubeArray ? 6 : 1;
        const ImageInfo info{format, uvec2(1), 1, layers, usage, view};
        texture = Texture(context_, info, "placeholder");
    }
    return texture.image();
}

size_t Recorder::takeImage(const ImageInfo& info) {
    auto place =
        std::ranges::find_if(pooledImages_, [&](const PooledImage& p) { return !p.taken && p.texture.info() == info; });
    if (place == pooledImages_.end()) {
        place = std::ranges::find_if(pooledImages_, [](const PooledImage& p) { return p.texture.info().size.x == 0; });
        if (place == pooledImages_.end()) {
            place = pooledImages_.insert(place, PooledImage{});
        }
        place->texture = Texture(context_, info, nameOf("scratch"));
    }
    place->taken = true;
    place->lastUse = number_;
    return static_cast<size_t>(place - pooledImages_.begin());
}

size_t Recorder::takeBuffer(VkDeviceSize size) {
    const auto sizeOf = [](const PooledBuffer& p) { return p.buffer.view().size; };
    auto place =
        std::ranges::find_if(pooledBuffers_, [&](const PooledBuffer& p) { return !p.taken && sizeOf(p) == size; });
    if (place == pooledBuffers_.end()) {
        place = std::ranges::find(pooledBuffers_, VkDeviceSize(0), sizeOf);
        if (place == pooledBuffers_.end()) {
            place = pooledBuffers_.insert(place, PooledBuffer{});
        }
        place->buffer = storageBuffer(context_, size, nameOf("scratch"));
    }
    place->taken = true;
    place->lastUse = number_;
    return static_cast<size_t>(place - pooledBuffers_.begin());
}

void Recorder::giveBack(std::span<const size_t> images, std::span<const size_t> buffers) {
    for (const size_t i : images) {
        pooledImages_[i].taken = false;
    }
    for (const size_t i : buffers) {
        pooledBuffers_[i].taken = false;
    }
}

void Recorder::dropUnused() {
    constexpr uint64_t keptFrames = 2;
    for (PooledImage& p : pooledImages_) {
        if (!p.taken && p.lastUse + keptFrames < number_) {
            p.texture = {};
        }
    }
    for (PooledBuffer& p : pooledBuffers_) {
        if (!p.taken && p.lastUse + keptFrames < number_) {
            p.buffer = {};
        }
    }
}

Readback Recorder::readback(Image image) {
    REFLET_CHECK(!isCollecting(), "nothing is recorded to read back");
    const VkDeviceSize size = VkDeviceSize(image.size.x) * image.size.y * bytesPerTexel(image.format);
    std::vector<Buffer>& readbacks = slot().readbacks;
    const size_t index = slot().readbacksUsed++;
    if (index >= readbacks.size() || readbacks[index].view().size != size) {
        readbacks.resize(std::max(readbacks.size(), index + 1));
        readbacks[index] = Buffer(context_, size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback, "readback");
    }
    const BufferView target = readbacks[index].view();
    BarrierBatch before;
    before.use(*image.state, aspectOf(image.format),
               {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, false});
    before.use(target.state->access, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true});
    before.record(context_.vk, commands_);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {aspectOf(image.format), 0, 0, 1};
    copy.imageExtent = {image.size.x, image.size.y, 1};
    context_.vk.vkCmdCopyImageToBuffer(commands_, image.state->image, VK_IMAGE_LAYOUT_GENERAL, target.state->buffer, 1,
                                       &copy);
    BarrierBatch after;
    after.use(target.state->access, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, false});
    after.record(context_.vk, commands_);
    return {index};
}

std::span<const std::byte> Recorder::bytes(Readback readback) const {
    return slots_[finished_].readbacks.at(readback.index).bytes();
}

Recorder::Scope::Scope(Recorder& recorder, std::string_view prefix)
    : recorder_(recorder), before_(recorder.prefix_.size()) {
    recorder.prefix_ += std::string(prefix) + '.';
}

Recorder::Scope::~Scope() {
    recorder_.prefix_.resize(before_);
}

Recorder::UniformSlice Recorder::uploadUniform(std::span<const std::byte> bytes) {
    Slot& now = slot();
    const VkDeviceSize alignment = std::max<VkDeviceSize>(context_.limits().minUniformBufferOffsetAlignment, 1);
    VkDeviceSize offset = (now.uniformsUsed + alignment - 1) / alignment * alignment;
    REFLET_CHECK(bytes.size() <= uniformBytes, "a uniform block of {} bytes", bytes.size());
    if (offset + bytes.size() > uniformBytes) {
        offset = 0;
        if (now.uniformBlock + 1 == now.uniforms.size()) {
            now.uniforms.push_back(makeUniforms(context_));
        }
        ++now.uniformBlock;  // only now: a host may go on with the frame after a failure
    }
    const Buffer& block = now.uniforms[now.uniformBlock];
    std::memcpy(block.bytes().data() + offset, bytes.data(), bytes.size());
    now.uniformsUsed = offset + bytes.size();
    return {block.handle(), offset};
}

VkDescriptorSet Recorder::allocateSet(VkDescriptorSetLayout layout) {
    Slot& now = slot();
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    for (;; ++now.descriptorPool) {
        const bool fresh = now.descriptorPool == now.descriptorPools.size();
        if (fresh) {
            now.descriptorPools.push_back(makeDescriptorPool(context_));
        }
        info.descriptorPool = now.descriptorPools[now.descriptorPool];
        VkDescriptorSet set = VK_NULL_HANDLE;
        const VkResult result = context_.vk.vkAllocateDescriptorSets(context_.handle(), &info, &set);
        const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
        if (fresh || !full) {
            vkCheck(result, "allocating a descriptor set");
            return set;
        }
    }
}

}  // namespace reflet::gpu
