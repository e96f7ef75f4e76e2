// Makes images and buffers for their owners.
#include "gpu/images.h"

#include "base/error.h"
#include "gpu/context.h"
#include "gpu/pass_list.h"

#include <algorithm>

namespace reflet::gpu {

namespace {

constexpr VkImageUsageFlags copied = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

// Whether an image has another size because the frames have. One that changes for another reason starts again.
bool follows(const FrameSizes& sizes, const Image& before, const ImageInfo& now, Resample resample) {
    if (sizes.rescale == nullptr || resample == Resample::never || sizes.before == sizes.now ||
        before.format != now.format) {
        return false;
    }
    const vec2 expected = vec2(before.size) * vec2(sizes.now) / vec2(sizes.before);
    return glm::all(glm::lessThanEqual(glm::abs(expected - vec2(now.size)), vec2(1.01F)));
}

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

Image HistoryImage::shown(uint32_t i) const {
    HeldImage::Sized& image = *images_[i]->current;
    return {&image.state, -1, image.info.format, image.info.size};
}

// With memory for the largest frames.
void HistoryImage::make(PassList& f, const ImageInfo& info, Resample resample) {
    ImageInfo largest = info;
    const FrameSizes& sizes = f.sizes();
    if (sizes.rescale != nullptr && resample != Resample::never) {
        largest.size = max((info.size * sizes.largest + sizes.now - 1U) / sizes.now, info.size);
    }
    for (std::shared_ptr<HeldImage>& image : images_) {
        image.reset();  // its memory may do for the new one
        image = f.hold(largest, f.nameOf(name_));
        REFLET_CHECK(f.show(*image, info), "{}: memory for {}x{} does not do for {}x{}", name_, largest.size.x,
                     largest.size.y, info.size.x, info.size.y);
    }
    images_[0]->other = images_[1];
    images_[1]->other = images_[0];
}

// Of both; false if their memory does not do for it.
bool HistoryImage::show(PassList& f, const ImageInfo& info) {
    return std::ranges::all_of(images_, [&](const std::shared_ptr<HeldImage>& image) {
        return image && image->current->info.format == info.format && f.show(*image, info);
    });
}

void HistoryImage::rescale(PassList& f, Resample resample) {
    f.sizes().rescale(f, from_, shown(current_ ^ 1U), resample);
    rescaleList_ = f.listNumber();
    f.promise();
}

History HistoryImage::swap(PassList& f, VkFormat format, uvec2 size, Resample resample) {
    const ImageInfo info = storageInfo(format, size);
    const bool first = lastUse_ != f.number() || generation_ != f.generation();
    const bool complete = images_[0] && images_[1];  // making the second one may have failed
    if (first) {
        current_ ^= 1U;
        // Asked for in the last frame, and written: that frame may have failed, or was only prepared.
        valid_ = complete && lastUse_ + 1 == f.number() && generation_ == f.generation() &&
                 images_[current_ ^ 1U]->recordedFrame == f.number();
        lastUse_ = f.number();
        generation_ = f.generation();
        rescaleList_ = 0;
    }
    const bool steady = complete && shown(0).size == size && shown(1).size == size && shown(0).format == format;
    const bool rescales =
        complete && !steady && first && valid_ && follows(f.sizes(), shown(current_ ^ 1U), info, resample);
    const Image before = rescales ? shown(current_ ^ 1U) : Image{};
    if (!steady) {
        valid_ = rescales;
        // Other callers give memory back when a size changes.
        const bool keepsMemory = f.sizes().rescale != nullptr;
        if (!complete || !keepsMemory || !show(f, info)) {
            valid_ = false;
            make(f, info, resample);
        }
    }
    // Once a list has written `next`, the memory of `previous` has served others.
    valid_ = valid_ && images_[current_]->usedFrame != f.number() + 1;
    if (rescales && valid_) {
        current_ ^= 1U;  // what would be `next` gets the content, and is written over after that
        images_[current_]->rescaledFrame = f.number() + 1;
        from_ = before;
        rescale(f, resample);
    } else if (valid_ && rescaleList_ != 0 && f.isDiscarded(rescaleList_)) {
        rescale(f, resample);
    }
    for (uint32_t i = 0; i < 2; ++i) {
        images_[i]->frame = f.number();
        images_[i]->isNext = i == current_;
    }
    return {shown(current_ ^ 1U), shown(current_), valid_};
}

}  // namespace reflet::gpu
