// Records the passes of a frame.
#include "gpu/frame.h"

#include "base/error.h"
#include "gpu/barrier.h"
#include "gpu/device.h"

#include <algorithm>
#include <cstring>

namespace reflet::gpu {

namespace {

constexpr VkDeviceSize uniformBytes = VkDeviceSize(4) << 20U;
constexpr uint32_t maxTimedPasses = 1024;
constexpr uint32_t queriesPerPass = 3;
constexpr VkDeviceSize maxUpdateBytes = 65536;

constexpr VkImageUsageFlags copied = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
constexpr VkImageUsageFlags storageUsage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | copied;

VkDescriptorPool makeDescriptorPool(Device& device) {
    std::vector<VkDescriptorPoolSize> sizes{{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 2048},
                                            {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2048},
                                            {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 4096},
                                            {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8192}};
    if (device.hasRayQuery()) {
        sizes.push_back({VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, maxTimedPasses});
    }
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = maxTimedPasses;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    vkCheck(device.vk.vkCreateDescriptorPool(device.handle(), &info, nullptr, &pool), "creating a descriptor pool");
    return pool;
}

VkQueryPool makeQueryPool(Device& device) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = queriesPerPass * maxTimedPasses;
    VkQueryPool pool = VK_NULL_HANDLE;
    vkCheck(device.vk.vkCreateQueryPool(device.handle(), &info, nullptr, &pool), "creating a query pool");
    return pool;
}

}  // namespace

Frame::Frame(Device& device)
    : device_(device),
      uniforms_(device, uniformBytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryUse::upload, "uniforms") {
    const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, device.queueFamily()};
    vkCheck(device.vk.vkCreateCommandPool(device.handle(), &pool, nullptr, &commandPool_), "creating a command pool");
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = commandPool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    vkCheck(device.vk.vkAllocateCommandBuffers(device.handle(), &allocate, &commands_), "allocating commands");
    descriptorPool_ = makeDescriptorPool(device);
    queries_ = makeQueryPool(device);
}

Frame::~Frame() {
    device_.vk.vkDeviceWaitIdle(device_.handle());
    device_.vk.vkDestroyQueryPool(device_.handle(), queries_, nullptr);
    device_.vk.vkDestroyDescriptorPool(device_.handle(), descriptorPool_, nullptr);
    device_.vk.vkDestroyCommandPool(device_.handle(), commandPool_, nullptr);
}

void Frame::begin() {
    device_.wait(serial_);
    vkCheck(device_.vk.vkResetCommandPool(device_.handle(), commandPool_, 0), "resetting commands");
    vkCheck(device_.vk.vkResetDescriptorPool(device_.handle(), descriptorPool_, 0), "resetting descriptors");
    uniformsUsed_ = 0;
    readbacksUsed_ = 0;
    timed_.clear();
    ++number_;
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    vkCheck(device_.vk.vkBeginCommandBuffer(commands_, &info), "beginning commands");
    device_.vk.vkCmdResetQueryPool(commands_, queries_, 0, queriesPerPass * maxTimedPasses);
}

void Frame::submit() {
    vkCheck(device_.vk.vkEndCommandBuffer(commands_), "ending commands");
    submitted_ = std::chrono::steady_clock::now();
    serial_ = device_.submit(commands_);
}

void Frame::wait() {
    device_.wait(serial_);
    submittedMs_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - submitted_).count();
    readTimers();
}

void Frame::beginTimer(const PassTime& pass) {
    REFLET_CHECK(timed_.size() < maxTimedPasses, "{} passes in one frame", timed_.size());
    // The second timestamp is never read. llvmpipe takes a timestamp only when the next one flushes it, which otherwise
    // would be after the pass.
    const auto query = static_cast<uint32_t>(queriesPerPass * timed_.size());
    device_.vk.vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, query);
    device_.vk.vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, query + 1);
    timed_.push_back(pass);
}

void Frame::endTimer() {
    const auto query = static_cast<uint32_t>(queriesPerPass * timed_.size() - 1);
    device_.vk.vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, query);
}

void Frame::readTimers() {
    times_.clear();
    if (timed_.empty()) {
        return;
    }
    std::vector<uint64_t> ticks(queriesPerPass * timed_.size());
    vkCheck(device_.vk.vkGetQueryPoolResults(device_.handle(), queries_, 0, static_cast<uint32_t>(ticks.size()),
                                             ticks.size() * sizeof(uint64_t), ticks.data(), sizeof(uint64_t),
                                             VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
            "reading timestamps");
    const double tick = device_.limits().timestampPeriod * 1e-6;
    times_.push_back({"frame", static_cast<double>(ticks.back() - ticks.front()) * tick});
    for (size_t i = 0; i < timed_.size(); ++i) {
        const double ms = static_cast<double>(ticks[queriesPerPass * i + 2] - ticks[queriesPerPass * i]) * tick;
        auto same = std::ranges::find(times_, timed_[i].name, &PassTime::name);
        if (same == times_.end()) {
            same = times_.insert(times_.end(), {timed_[i].name, 0.0, 0, timed_[i].raster});
        }
        same->ms += ms;
        same->bytes += timed_[i].bytes;
        times_.front().bytes += timed_[i].bytes;
    }
}

Pass Frame::compute(std::string_view name, std::string_view shader) {
    return {*this, passPrefix_ + std::string(name), {std::string(shader)}};
}

Pass Frame::raster(std::string_view name, std::vector<std::string> shaders) {
    return {*this, passPrefix_ + std::string(name), std::move(shaders)};
}

void Frame::update(BufferView buffer, std::span<const std::byte> bytes) {
    REFLET_CHECK(bytes.size() <= maxUpdateBytes && bytes.size() % 4 == 0, "{} bytes", bytes.size());
    BarrierBatch batch;
    batch.use(buffer.state->access, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true});
    batch.record(device_.vk, commands_);
    device_.vk.vkCmdUpdateBuffer(commands_, buffer.state->buffer, 0, bytes.size(), bytes.data());
}

void Frame::readByDraws(BufferView buffer) {
    BarrierBatch batch;
    batch.use(buffer.state->access,
              {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, false});
    batch.record(device_.vk, commands_);
}

void Frame::clear(Image image) {
    BarrierBatch batch;
    batch.use(*image.state, aspectOf(image.format),
              {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true});
    batch.record(device_.vk, commands_);
    const VkClearColorValue zero{};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                                      VK_REMAINING_ARRAY_LAYERS};
    device_.vk.vkCmdClearColorImage(commands_, image.state->image, VK_IMAGE_LAYOUT_GENERAL, &zero, 1, &all);
}

// Returns the texture of that name; replaces it if its info (the size, say) differs.
Image Frame::transient(std::string_view name, const ImageInfo& info) {
    const std::string fullName = imagePrefix_ + std::string(name);
    Texture& texture = images_[fullName];
    if (!(texture.info() == info)) {
        texture = Texture(device_, info, fullName);
    }
    return texture.image();
}

Image Frame::image(std::string_view name, VkFormat format, uvec2 size, uint32_t layers, bool array) {
    return transient(name, {format, size, 1, layers, storageUsage, array ? ViewKind::array : ViewKind::byLayers});
}

Image Frame::target(std::string_view name, VkFormat format, uvec2 size) {
    const VkImageUsageFlags attachment = aspectOf(format) == VK_IMAGE_ASPECT_DEPTH_BIT
                                             ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                             : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    return transient(name, {format, size, 1, 1, attachment | VK_IMAGE_USAGE_SAMPLED_BIT | copied});
}

BufferView Frame::buffer(std::string_view name, VkDeviceSize size) {
    const std::string fullName = imagePrefix_ + std::string(name);
    auto known = buffers_.find(fullName);
    if (known == buffers_.end() || known->second.view().size != size) {
        Buffer made(device_, size,
                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                        VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                    MemoryUse::device, fullName);
        known = buffers_.insert_or_assign(fullName, std::move(made)).first;
    }
    return known->second.view();
}

History Frame::history(std::string_view name, VkFormat format, uvec2 size) {
    HistoryPair& pair = histories_[imagePrefix_ + std::string(name)];
    const ImageInfo info{format, size, 1, 1, storageUsage};
    const bool fresh = !(pair.textures[0].info() == info);
    if (fresh) {
        for (Texture& texture : pair.textures) {
            texture = Texture(device_, info, std::string(name));
        }
    }
    if (pair.lastUse != number_) {
        pair.current ^= 1U;
        pair.valid = pair.lastUse + 1 == number_;
        pair.lastUse = number_;
    }
    pair.valid = pair.valid && !fresh;
    return {pair.textures[pair.current ^ 1U].image(), pair.textures[pair.current].image(), pair.valid};
}

bool Frame::holds(Image image, std::span<const std::byte> key) {
    std::vector<std::byte>& known = image.state->contents;
    if (std::ranges::equal(known, key)) {
        return true;
    }
    known.assign(key.begin(), key.end());
    return false;
}

void Frame::invalidateHistories() {
    histories_.clear();
    for (auto& [name, texture] : images_) {
        texture.image().state->contents.clear();
    }
}

Readback Frame::readback(Image image) {
    const VkDeviceSize size = VkDeviceSize(image.size.x) * image.size.y * bytesPerTexel(image.format);
    const size_t index = readbacksUsed_++;
    if (index >= readbacks_.size() || readbacks_[index].view().size != size) {
        readbacks_.resize(std::max(readbacks_.size(), index + 1));
        readbacks_[index] = Buffer(device_, size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback, "readback");
    }
    const BufferView target = readbacks_[index].view();
    BarrierBatch before;
    before.use(*image.state, aspectOf(image.format),
               {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, false});
    before.use(target.state->access, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true});
    before.record(device_.vk, commands_);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {aspectOf(image.format), 0, 0, 1};
    copy.imageExtent = {image.size.x, image.size.y, 1};
    device_.vk.vkCmdCopyImageToBuffer(commands_, image.state->image, VK_IMAGE_LAYOUT_GENERAL, target.state->buffer, 1,
                                      &copy);
    BarrierBatch after;
    after.use(target.state->access, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, false});
    after.record(device_.vk, commands_);
    return {index};
}

std::span<const std::byte> Frame::bytes(Readback readback) const {
    return readbacks_.at(readback.index).bytes();
}

Frame::Scope::Scope(Frame& frame, std::string_view prefix, bool images)
    : frame_(frame), passes_(frame.passPrefix_.size()), images_(frame.imagePrefix_.size()) {
    const std::string added = std::string(prefix) + '.';
    frame.passPrefix_ += added;
    if (images) {
        frame.imagePrefix_ += added;
    }
}

Frame::Scope::~Scope() {
    frame_.passPrefix_.resize(passes_);
    frame_.imagePrefix_.resize(images_);
}

Frame::UniformSlice Frame::uploadUniform(std::span<const std::byte> bytes) {
    const VkDeviceSize alignment = std::max<VkDeviceSize>(device_.limits().minUniformBufferOffsetAlignment, 1);
    const VkDeviceSize offset = (uniformsUsed_ + alignment - 1) / alignment * alignment;
    REFLET_CHECK(offset + bytes.size() <= uniformBytes, "uniform buffer of the frame: {} bytes", offset + bytes.size());
    std::memcpy(uniforms_.bytes().data() + offset, bytes.data(), bytes.size());
    uniformsUsed_ = offset + bytes.size();
    return {uniforms_.handle(), offset};
}

VkDescriptorSet Frame::allocateSet(VkDescriptorSetLayout layout) {
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = descriptorPool_;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    vkCheck(device_.vk.vkAllocateDescriptorSets(device_.handle(), &info, &set), "allocating a descriptor set");
    return set;
}

}  // namespace reflet::gpu
