/*
 * Reflet in a host of VkRenderPass: render passes leave the G-buffer in layouts that shaders read, an external subpass
 * dependency makes it visible to compute shaders, and so Reflet is told that nothing is to wait for (stages 0). Frames
 * have ever another size (dynamic resolution), in the top left corner of the same images.
 *
 * usage: reflet_renderpass_example [OUT.ppm [WIDTH HEIGHT [FRAMES]]]
 */
#include "effects.h"

#include <stdlib.h>

enum { COLORS = 3 };

/* The host's render passes, and what they draw into. */
typedef struct Passes {
    VkRenderPass room, sun;
    VkFramebuffer room_target, sun_target;
} Passes;

static VkAttachmentDescription attachment(VkFormat format, VkImageLayout left) {
    const VkAttachmentDescription one = {.format = format, .samples = VK_SAMPLE_COUNT_1_BIT, .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE, .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE, .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED, .finalLayout = left};
    return one;
}

/* Colours, and depth behind them. */
static VkRenderPass make_pass(const Host* h, const VkFormat* colors, uint32_t count) {
    VkAttachmentDescription all[COLORS + 1];
    VkAttachmentReference targets[COLORS];
    for (uint32_t i = 0; i < count; ++i) {
        all[i] = attachment(colors[i], h->readable_color);
        targets[i] = (VkAttachmentReference){i, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    }
    all[count] = attachment(VK_FORMAT_D32_SFLOAT, h->readable_depth);
    const VkAttachmentReference depth = {count, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass = {.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS, .colorAttachmentCount = count,
        .pColorAttachments = targets, .pDepthStencilAttachment = &depth};
    const VkPipelineStageFlags writes = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                        VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    const VkAccessFlags written = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    const VkSubpassDependency dependencies[] = {
        /* Before: the last frame's compute shaders have read these images, and its pass has written them. */
        {.srcSubpass = VK_SUBPASS_EXTERNAL, .dstSubpass = 0, .srcStageMask = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | writes,
         .srcAccessMask = written, .dstStageMask = writes, .dstAccessMask = written | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT},
        /* After: all that the pass has written, and the change to finalLayout, before any compute shader. */
        {.srcSubpass = 0, .dstSubpass = VK_SUBPASS_EXTERNAL, .srcStageMask = writes, .srcAccessMask = written,
         .dstStageMask = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, .dstAccessMask = VK_ACCESS_SHADER_READ_BIT}};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, .attachmentCount = count + 1,
        .pAttachments = all, .subpassCount = 1, .pSubpasses = &subpass, .dependencyCount = 2, .pDependencies = dependencies};
    VkRenderPass pass;
    check(vkCreateRenderPass(h->device, &info, NULL, &pass), "vkCreateRenderPass");
    return pass;
}

static VkFramebuffer make_target(const Host* h, VkRenderPass pass, const VkImageView* views, uint32_t count, const Picture* depth) {
    const VkFramebufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, .renderPass = pass, .attachmentCount = count,
        .pAttachments = views, .width = depth->width, .height = depth->height, .layers = 1};
    VkFramebuffer target;
    check(vkCreateFramebuffer(h->device, &info, NULL, &target), "vkCreateFramebuffer");
    return target;
}

static Passes make_passes(Host* h) {
    const Picture* colors[COLORS] = {&h->normal, &h->color, &h->motion};
    VkFormat formats[COLORS];
    VkImageView views[COLORS + 1];
    for (int i = 0; i < COLORS; ++i) {
        formats[i] = colors[i]->format;
        views[i] = colors[i]->view;
    }
    views[COLORS] = h->depth.view;
    Passes p;
    p.room = make_pass(h, formats, COLORS);
    p.sun = make_pass(h, NULL, 0);
    p.room_target = make_target(h, p.room, views, COLORS + 1, &h->depth);
    p.sun_target = make_target(h, p.sun, &h->sun_map.view, 1, &h->sun_map);
    host_use_render_passes(h, p.room, p.sun);
    return p;
}

static void free_passes(const Host* h, Passes* p) {
    vkDestroyFramebuffer(h->device, p->room_target, NULL);
    vkDestroyFramebuffer(h->device, p->sun_target, NULL);
    vkDestroyRenderPass(h->device, p->room, NULL);
    vkDestroyRenderPass(h->device, p->sun, NULL);
}

/* Draws into the top left rectangle of that size. */
static void draw_pass(Host* h, Slot* slot, VkRenderPass pass, VkFramebuffer target, VkPipeline pipeline, uint32_t colors, uint32_t width,
                      uint32_t height) {
    VkClearValue clear[COLORS + 1] = {0};
    clear[colors].depthStencil.depth = 1.0F;
    const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, .renderPass = pass, .framebuffer = target,
        .renderArea = {{0, 0}, {width, height}}, .clearValueCount = colors + 1, .pClearValues = clear};
    vkCmdBeginRenderPass(slot->commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    host_draw_boxes(h, slot, pipeline, width, height);
    vkCmdEndRenderPass(slot->commands);
}

int main(int count, char** arguments) {
    const char* path = count > 1 ? arguments[1] : "renderpass.ppm";
    const uint32_t width = count > 3 ? (uint32_t)atoi(arguments[2]) : 640;
    const uint32_t height = count > 3 ? (uint32_t)atoi(arguments[3]) : 360;
    const uint32_t frames = count > 4 ? (uint32_t)atoi(arguments[4]) : 48;
    Host h = {0};
    host_open(&h, NULL, 0, NULL, 0);
    host_make_targets(&h, width, height);
    h.readable_color = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    h.readable_depth = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    Passes passes = make_passes(&h);
    Download download = make_download(&h, width, height);
    RefletContext context = make_context(&h);
    const RefletViewInfo view_info = {sizeof view_info, width, height, FRAMES_IN_FLIGHT, 0, 0};
    RefletView view;
    reflet_check(refletCreateView(context, &view_info, &view));
    RefletSettings settings;
    reflet_check(refletCreateSettings("balanced", &settings));

    Path camera_path = {0};
    for (uint32_t i = 0; i < frames; ++i) {
        Slot* slot = host_begin(&h);
        /* A host would follow its frame time; here the size changes every six frames, by a few percent. */
        const uint32_t percent = 100 - 5 * (i / 6 % 3);
        h.width = width * percent / 100;
        h.height = height * percent / 100;
        Frame frame = next_frame(&h, &camera_path, 0.35F);
        frame.render_size[0] = h.width;
        frame.render_size[1] = h.height;
        host_upload(&h, slot, frame.now);
        draw_pass(&h, slot, passes.sun, passes.sun_target, h.sun, 0, SUN_MAP_SIDE, SUN_MAP_SIDE);
        draw_pass(&h, slot, passes.room, passes.room_target, h.room, COLORS, h.width, h.height);
        const RefletImage picture = record_effects(&h, slot, view, settings, &frame);
        if (i + 1 == frames) record_download(&download, slot->commands, picture.image, picture.stages, picture.access);
        host_submit(&h, slot);
    }
    check(vkDeviceWaitIdle(h.device), "vkDeviceWaitIdle");
    write_download(&h, &download, path);

    refletDestroySettings(settings);
    refletDestroyView(view);
    refletDestroyContext(context);
    free_passes(&h, &passes);
    host_free_targets(&h);
    host_close(&h);
    return 0;
}
