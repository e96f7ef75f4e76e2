// Makes images and buffers for their owners.
#include "gpu/images.h"

#include "gpu/context.h"
#include "gpu/recorder.h"

#include <algorithm>

namespace reflet::gpu {

namespace {

constexpr VkImageUsageFlags copied = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

}  // namespace

ImageInfo storageInfo(VkFormat format, uvec2 size, uint32_t layers, bool array) {
    return {format,
            size,
            1,
            layers,
            VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | copied,
            array ? ViewKind::array : ViewKind::byLayers};
}

ImageInfo targetInfo(VkFormat format, uvec2 size) {
    const VkImageUsageFlags attachment = aspectOf(format) == VK_IMAGE_ASPECT_DEPTH_BIT
                                             ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                             : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    return {format, size, 1, 1, attachment | VK_IMAGE_USAGE_SAMPLED_BIT | copied};
}

Image KeptImage::get(Recorder& f, const ImageInfo& info) {
    if (!(texture_.info() == info)) {
        texture_ = Texture(f.context(), info, f.nameOf(name_));
        contents_.clear();
    }
    return texture_.image();
}

Image KeptImage::storage(Recorder& f, VkFormat format, uvec2 size, uint32_t layers, bool array) {
    return get(f, storageInfo(format, size, layers, array));
}

Image KeptImage::target(Recorder& f, VkFormat format, uvec2 size) {
    return get(f, targetInfo(format, size));
}

bool KeptImage::holds(const Recorder& f, std::span<const std::byte> key) {
    if (f.isCollecting()) {
        return false;  // and nothing will be written
    }
    if (generation_ == f.generation() && std::ranges::equal(contents_, key)) {
        return true;
    }
    generation_ = f.generation();
    contents_.assign(key.begin(), key.end());
    return false;
}

BufferView KeptBuffer::get(Recorder& f, VkDeviceSize size) {
    if (!buffer_.view() || buffer_.view().size != size) {
        buffer_ = storageBuffer(f.context(), size, f.nameOf(name_));
    }
    return buffer_.view();
}

History HistoryImage::swap(Recorder& f, VkFormat format, uvec2 size) {
    const ImageInfo info = storageInfo(format, size);
    // Both: making the second one may have failed.
    const bool fresh = !(textures_[0].info() == info && textures_[1].info() == info);
    if (fresh) {
        for (Texture& texture : textures_) {
            texture = Texture(f.context(), info, f.nameOf(name_));
        }
    }
    if (lastUse_ != f.number() || generation_ != f.generation()) {
        current_ ^= 1U;
        valid_ = lastUse_ + 1 == f.number() && generation_ == f.generation();
        lastUse_ = f.number();
        generation_ = f.generation();
    }
    valid_ = valid_ && !fresh;
    return {textures_[current_ ^ 1U].image(), textures_[current_].image(), valid_};
}

Scratch::~Scratch() {
    f_.giveBack(images_, buffers_);
}

Image Scratch::storage(VkFormat format, uvec2 size, uint32_t layers, bool array) {
    images_.push_back(f_.takeImage(storageInfo(format, size, layers, array)));
    return f_.pooledImage(images_.back());
}

Image Scratch::target(VkFormat format, uvec2 size) {
    images_.push_back(f_.takeImage(targetInfo(format, size)));
    return f_.pooledImage(images_.back());
}

BufferView Scratch::buffer(VkDeviceSize size) {
    buffers_.push_back(f_.takeBuffer(size));
    return f_.pooledBuffer(buffers_.back());
}

}  // namespace reflet::gpu
