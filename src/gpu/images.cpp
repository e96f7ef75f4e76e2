// Makes images and buffers for their owners.
#include "gpu/images.h"

#include "gpu/context.h"
#include "gpu/pass_list.h"

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

Image KeptImage::get(PassList& f, const ImageInfo& info) {
    if (!(texture_.info() == info)) {
        texture_ = Texture(f.context(), info, f.nameOf(name_));
        contents_.clear();
    }
    return texture_.image();
}

Image KeptImage::storage(PassList& f, VkFormat format, uvec2 size, uint32_t layers, bool array) {
    return get(f, storageInfo(format, size, layers, array));
}

Image KeptImage::target(PassList& f, VkFormat format, uvec2 size) {
    return get(f, targetInfo(format, size));
}

bool KeptImage::holds(PassList& f, std::span<const std::byte> key) {
    if (generation_ == f.generation() && std::ranges::equal(contents_, key) && !f.isDiscarded(list_)) {
        return true;
    }
    generation_ = f.generation();
    list_ = f.listNumber();
    contents_.assign(key.begin(), key.end());
    f.promise();
    return false;
}

bool KeptBuffer::holds(PassList& f) {
    if (written_ && !f.isDiscarded(list_)) {
        return true;
    }
    written_ = true;
    list_ = f.listNumber();
    f.promise();
    return false;
}

BufferView KeptBuffer::get(PassList& f, VkDeviceSize size) {
    if (!buffer_.view() || buffer_.view().size != size) {
        buffer_ = storageBuffer(f.context(), size, f.nameOf(name_));
        written_ = false;
    }
    return buffer_.view();
}

History HistoryImage::swap(PassList& f, VkFormat format, uvec2 size) {
    const ImageInfo info = storageInfo(format, size);
    // Both: making the second one may have failed.
    const bool fresh = !(images_[0] && images_[0]->info == info && images_[1] && images_[1]->info == info);
    if (fresh) {
        for (std::shared_ptr<HeldImage>& image : images_) {
            image.reset();  // its memory may do for the new one
            image = f.hold(info, f.nameOf(name_));
        }
        images_[0]->other = images_[1];
        images_[1]->other = images_[0];
    }
    if (lastUse_ != f.number() || generation_ != f.generation()) {
        current_ ^= 1U;
        // Asked for in the last frame, and written: that frame may have failed, or was only prepared.
        valid_ = lastUse_ + 1 == f.number() && generation_ == f.generation() &&
                 images_[current_ ^ 1U]->recordedFrame == f.number();
        lastUse_ = f.number();
        generation_ = f.generation();
    }
    // Once a list has written `next`, the memory of `previous` has served others.
    valid_ = valid_ && !fresh && images_[current_]->usedFrame != f.number() + 1;
    for (uint32_t i = 0; i < 2; ++i) {
        images_[i]->frame = f.number();
        images_[i]->isNext = i == current_;
    }
    const auto view = [&](HeldImage& image) { return Image{&image.state, -1, info.format, info.size}; };
    return {view(*images_[current_ ^ 1U]), view(*images_[current_]), valid_};
}

}  // namespace reflet::gpu
