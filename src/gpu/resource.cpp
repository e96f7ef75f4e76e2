// Images and buffers on the device.
#include "gpu/resource.h"

#include "base/error.h"
#include "gpu/context.h"

#include <atomic>
#include <utility>

namespace reflet::gpu {

VkImageAspectFlags aspectOf(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

uint32_t bytesPerTexel(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8_UNORM:
            return 1;
        case VK_FORMAT_R8G8B8A8_UNORM:
        case VK_FORMAT_R8G8B8A8_SRGB:
        case VK_FORMAT_B8G8R8A8_UNORM:
        case VK_FORMAT_A2B10G10R10_UNORM_PACK32:
        case VK_FORMAT_A2R10G10B10_UNORM_PACK32:
        case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
        case VK_FORMAT_R16G16_SFLOAT:
        case VK_FORMAT_R32_UINT:
        case VK_FORMAT_R32_SFLOAT:
        case VK_FORMAT_D32_SFLOAT:
            return 4;
        case VK_FORMAT_R16G16B16A16_SFLOAT:
        case VK_FORMAT_R32G32_UINT:
        case VK_FORMAT_R32G32_SFLOAT:
            return 8;
        case VK_FORMAT_R32G32B32A32_UINT:
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return 16;
        default:
            break;
    }
    REFLET_CHECK(false, "no size is known for VkFormat {}", static_cast<int>(format));
    return 0;
}

uint64_t bytesOf(const Image& image) {
    uint64_t texels = 0;
    for (uint32_t level = 0; level < image.mips; ++level) {
        const uvec2 size = max(image.size >> level, uvec2(1));
        texels += uint64_t(size.x) * size.y;
    }
    return texels * image.layers * bytesPerTexel(image.format);
}

namespace {

VkImageViewType viewType(const ImageInfo& info) {
    switch (info.view) {
        case ViewKind::cube:
            return VK_IMAGE_VIEW_TYPE_CUBE;
        case ViewKind::cubeArray:
            return VK_IMAGE_VIEW_TYPE_CUBE_ARRAY;
        case ViewKind::array:
            return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
        default:
            return info.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    }
}

bool isCube(const ImageInfo& info) {
    return info.view == ViewKind::cube || info.view == ViewKind::cubeArray;
}

VkImageView makeView(Context& context, VkImage image, VkImageViewType type, const ImageInfo& info,
                     const VkImageSubresourceRange& range) {
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = image;
    view.viewType = type;
    view.format = info.format;
    view.subresourceRange = range;
    VkImageView made = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateImageView(context.handle(), &view, context.allocator(), &made),
            "creating an image view");
    return made;
}

}  // namespace

uint64_t nextResourceId() {
    static std::atomic<uint64_t> last{0};
    return ++last;
}

VkImage makeImage(Context& context, const ImageInfo& info, const std::string& name) {
    const uint32_t limit = context.limits().maxImageDimension2D;
    if (info.size.x == 0 || info.size.y == 0 || info.size.x > limit || info.size.y > limit) {
        fail("the image '{}' cannot be {}x{}: this device has images from 1x1 to {}x{}", name, info.size.x, info.size.y,
             limit, limit);
    }
    VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.flags = isCube(info) ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = info.format;
    create.extent = {info.size.x, info.size.y, 1};
    create.mipLevels = info.mips;
    create.arrayLayers = info.layers;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage = info.usage;
    context.share(create);
    ++context.counts().images;
    VkImage image = VK_NULL_HANDLE;
    vkCheck(context.vk.vkCreateImage(context.handle(), &create, context.allocator(), &image), "creating an image");
    return image;
}

void makeViews(Context& context, const ImageInfo& info, ImageState& state) {
    const VkImageAspectFlags aspect = aspectOf(info.format);
    state.view = makeView(context, state.image, viewType(info), info, {aspect, 0, info.mips, 0, info.layers});
    const bool written = (info.usage & VK_IMAGE_USAGE_STORAGE_BIT) != 0;
    for (uint32_t level = 0; written && (info.mips > 1 || isCube(info)) && level < info.mips; ++level) {
        state.mips.push_back(
            makeView(context, state.image, VK_IMAGE_VIEW_TYPE_2D_ARRAY, info, {aspect, level, 1, 0, info.layers}));
    }
}

void destroyImage(Context& context, const ImageState& state) {
    for (VkImageView mip : state.mips) {
        context.vk.vkDestroyImageView(context.handle(), mip, context.allocator());
    }
    context.vk.vkDestroyImageView(context.handle(), state.view, context.allocator());
    context.vk.vkDestroyImage(context.handle(), state.image, context.allocator());
}

Texture::Texture(Context& context, const ImageInfo& info, const std::string& name)
    : Texture() {  // so that the destructor runs if something fails below
    auto state = std::make_shared<ImageState>();
    state->image = makeImage(context, info, name);
    state->id = nextResourceId();
    state->aspect = aspectOf(info.format);
    state->name = name;
    context_ = &context;
    info_ = info;
    state_ = std::move(state);
    VkMemoryRequirements needs{};
    context.vk.vkGetImageMemoryRequirements(context.handle(), state_->image, &needs);
    state_->bytes = needs.size;
    allocation_ = context.memory().allocate(needs, MemoryUse::device, false, state_->image);
    context.nameImage(state_->image, name);
    vkCheck(context.vk.vkBindImageMemory(context.handle(), state_->image, allocation_.memory, allocation_.offset),
            "binding image memory");
    makeViews(context, info, *state_);
}

Image Texture::mip(uint32_t level) const {
    REFLET_CHECK(level < state_->mips.size(), "level {} of {}", level, state_->mips.size());
    return {state_.get(), static_cast<int32_t>(level), info_.format, max(info_.size >> level, uvec2(1)), info_.layers};
}

// The state goes with the image: passes of the frame that is being listed may still name it.
void Texture::retire() {
    if (context_ == nullptr || !state_) {
        return;
    }
    context_->retire([context = context_, state = state_, allocation = allocation_] {
        destroyImage(*context, *state);
        context->memory().release(allocation);
    });
    state_.reset();
}

Texture::~Texture() {
    retire();
}

Texture::Texture(Texture&& other) noexcept {
    *this = std::move(other);
}

Texture& Texture::operator=(Texture&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(info_, other.info_);
    std::swap(state_, other.state_);
    std::swap(allocation_, other.allocation_);
    return *this;
}

Buffer::Buffer(Context& context, VkDeviceSize size, VkBufferUsageFlags usage, MemoryUse use, const std::string& name)
    : Buffer() {  // so that the destructor runs if something fails below
    REFLET_CHECK(size > 0, "buffer '{}'", name);
    VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    create.size = size;
    create.usage = usage;
    context.share(create);
    ++context.counts().buffers;
    auto state = std::make_shared<BufferState>();
    state->id = nextResourceId();
    state->name = name;
    vkCheck(context.vk.vkCreateBuffer(context.handle(), &create, context.allocator(), &state->buffer),
            "creating a buffer");
    context_ = &context;
    size_ = size;
    state_ = std::move(state);
    VkMemoryRequirements needs{};
    context.vk.vkGetBufferMemoryRequirements(context.handle(), state_->buffer, &needs);
    state_->bytes = needs.size;
    allocation_ = context.memory().allocate(needs, use, true);
    vkCheck(context.vk.vkBindBufferMemory(context.handle(), state_->buffer, allocation_.memory, allocation_.offset),
            "binding buffer memory");
}

void Buffer::retire() {
    if (context_ == nullptr || !state_) {
        return;
    }
    context_->retire([context = context_, state = state_, allocation = allocation_] {
        context->vk.vkDestroyBuffer(context->handle(), state->buffer, context->allocator());
        context->memory().release(allocation);
    });
    state_.reset();
}

Buffer::~Buffer() {
    retire();
}

Buffer::Buffer(Buffer&& other) noexcept {
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(size_, other.size_);
    std::swap(state_, other.state_);
    std::swap(allocation_, other.allocation_);
    return *this;
}

Buffer storageBuffer(Context& context, VkDeviceSize size, const std::string& name) {
    return {context, size,
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
            MemoryUse::device, name};
}

}  // namespace reflet::gpu
