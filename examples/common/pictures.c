/* The host's images and buffers, and the way of a picture to a file. */
#include "host.h"

#include <stdio.h>
#include <stdlib.h>

static uint32_t memory_type(Host* h, uint32_t allowed, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties known;
    vkGetPhysicalDeviceMemoryProperties(h->physical, &known);
    for (uint32_t i = 0; i < known.memoryTypeCount; ++i) {
        if ((allowed >> i & 1U) != 0 && (known.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    }
    fprintf(stderr, "no memory type\n");
    exit(1);
}

static VkImageAspectFlags aspect_of(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

static VkImageView view_of(Host* h, const Picture* p) {
    const VkImageViewCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, .image = p->image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D, .format = p->format, .subresourceRange = {aspect_of(p->format), 0, 1, p->layer, 1}};
    VkImageView view;
    check(vkCreateImageView(h->device, &info, NULL, &view), "vkCreateImageView");
    return view;
}

Picture make_layers(Host* h, uint32_t width, uint32_t height, VkFormat format, VkImageUsageFlags usage, uint32_t layers) {
    Picture p = {.format = format, .width = width, .height = height, .usage = usage, .layers = layers};
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, .imageType = VK_IMAGE_TYPE_2D,
        .format = format, .extent = {width, height, 1}, .mipLevels = 1, .arrayLayers = layers,
        .samples = VK_SAMPLE_COUNT_1_BIT, .usage = usage};
    check(vkCreateImage(h->device, &info, NULL, &p.image), "vkCreateImage");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(h->device, p.image, &needs);
    const VkMemoryAllocateInfo memory = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size,
        .memoryTypeIndex = memory_type(h, needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    check(vkAllocateMemory(h->device, &memory, NULL, &p.memory), "vkAllocateMemory");
    check(vkBindImageMemory(h->device, p.image, p.memory, 0), "vkBindImageMemory");
    p.view = view_of(h, &p);
    return p;
}

Picture make_picture(Host* h, uint32_t width, uint32_t height, VkFormat format, VkImageUsageFlags usage) {
    return make_layers(h, width, height, format, usage, 1);
}

Picture layer_of(Host* h, const Picture* p, uint32_t layer) {
    Picture one = *p;
    one.layer = layer;
    one.memory = VK_NULL_HANDLE;
    one.view = view_of(h, &one);
    return one;
}

void free_picture(Host* h, Picture* p) {
    vkDestroyImageView(h->device, p->view, NULL);
    if (p->memory != VK_NULL_HANDLE) { /* else it is a layer of another one */
        vkDestroyImage(h->device, p->image, NULL);
        vkFreeMemory(h->device, p->memory, NULL);
    }
    *p = (Picture){0};
}

VkDeviceMemory bind_buffer(Host* h, VkBuffer buffer, VkMemoryPropertyFlags properties) {
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(h->device, buffer, &needs);
    const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size,
        .memoryTypeIndex = memory_type(h, needs.memoryTypeBits, properties)};
    VkDeviceMemory memory;
    check(vkAllocateMemory(h->device, &info, NULL, &memory), "vkAllocateMemory");
    check(vkBindBufferMemory(h->device, buffer, memory, 0), "vkBindBufferMemory");
    return memory;
}

static void layer_barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, uint32_t layer, VkImageLayout from,
                          VkImageLayout to, VkPipelineStageFlags2 source, VkAccessFlags2 written, VkPipelineStageFlags2 target,
                          VkAccessFlags2 access) {
    const VkImageMemoryBarrier2 one = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2, .srcStageMask = source,
        .srcAccessMask = written, .dstStageMask = target, .dstAccessMask = access, .oldLayout = from, .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED, .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED, .image = image,
        .subresourceRange = {aspect, 0, 1, layer, 1}};
    const VkDependencyInfo info = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1,
        .pImageMemoryBarriers = &one};
    vkCmdPipelineBarrier2(commands, &info);
}

void barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, VkImageLayout from, VkImageLayout to,
             VkPipelineStageFlags2 source, VkAccessFlags2 written, VkPipelineStageFlags2 target, VkAccessFlags2 access) {
    layer_barrier(commands, image, aspect, 0, from, to, source, written, target, access);
}

void picture_barrier(VkCommandBuffer commands, const Picture* p, VkImageLayout from, VkImageLayout to, VkPipelineStageFlags2 source,
                     VkAccessFlags2 written, VkPipelineStageFlags2 target, VkAccessFlags2 access) {
    layer_barrier(commands, p->image, aspect_of(p->format), p->layer, from, to, source, written, target, access);
}

Download make_download(Host* h, uint32_t width, uint32_t height) {
    Download d = {.width = width, .height = height};
    const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = 4 * (VkDeviceSize)width * height,
        .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    check(vkCreateBuffer(h->device, &info, NULL, &d.buffer), "vkCreateBuffer");
    d.memory = bind_buffer(h, d.buffer, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    return d;
}

void record_download(const Download* d, VkCommandBuffer commands, VkImage image, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    barrier(commands, image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL, stages, access,
            VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
    const VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, .imageExtent = {d->width, d->height, 1}};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_GENERAL, d->buffer, 1, &copy);
    const VkMemoryBarrier2 for_host = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
        .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT, .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
        .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
    const VkDependencyInfo info = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &for_host};
    vkCmdPipelineBarrier2(commands, &info);
}

void write_download(Host* h, Download* d, const char* path) {
    void* pixels;
    check(vkMapMemory(h->device, d->memory, 0, VK_WHOLE_SIZE, 0, &pixels), "vkMapMemory");
    FILE* file = fopen(path, "wb");
    if (file == NULL) {
        fprintf(stderr, "%s: cannot be written\n", path);
        exit(1);
    }
    fprintf(file, "P6\n%u %u\n255\n", d->width, d->height);
    for (uint32_t i = 0; i < d->width * d->height; ++i) fwrite((const uint8_t*)pixels + 4 * (size_t)i, 1, 3, file);
    fclose(file);
    vkDestroyBuffer(h->device, d->buffer, NULL);
    vkFreeMemory(h->device, d->memory, NULL);
    fprintf(stderr, "written: %s\n", path);
}
