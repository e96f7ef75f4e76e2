/*
 * Reflet in a window: the room of the examples with a swap chain, resizing, and effects switched by keys.
 *
 * keys: 1 SSGI   2 SSR   3 contact shadows   4 antialiasing   5 motion blur   left, right: turn   Escape: quit
 * usage: reflet_window_example [FRAMES]      FRAMES: ends after so many
 */
#include "host.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <reflet/reflet.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_IMAGES = 8 };

static void reflet_check(RefletResult result) {
    if (result != REFLET_SUCCESS) {
        fprintf(stderr, "%s: %s\n", refletResultName(result), refletLastError());
        exit(1);
    }
}

/* ---- the swap chain ---- */

typedef struct Swap {
    VkSurfaceKHR surface;
    VkSwapchainKHR chain;
    VkImage images[MAX_IMAGES];
    uint32_t count;
    VkExtent2D extent;
    VkSemaphore acquired[FRAMES_IN_FLIGHT], drawn[MAX_IMAGES];
} Swap;

static VkSemaphore make_semaphore(Host* h) {
    const VkSemaphoreCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore;
    check(vkCreateSemaphore(h->device, &info, NULL, &semaphore), "vkCreateSemaphore");
    return semaphore;
}

/* Returns false while the window has no size. */
static bool make_chain(Host* h, Swap* s, GLFWwindow* window) {
    VkSurfaceCapabilitiesKHR can;
    check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(h->physical, s->surface, &can), "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    int width, height;
    glfwGetFramebufferSize(window, &width, &height);
    s->extent = can.currentExtent.width != UINT32_MAX ? can.currentExtent : (VkExtent2D){(uint32_t)width, (uint32_t)height};
    if (s->extent.width == 0 || s->extent.height == 0) return false;
    VkSurfaceFormatKHR formats[64];
    uint32_t known = 64;
    vkGetPhysicalDeviceSurfaceFormatsKHR(h->physical, s->surface, &known, formats);
    VkSurfaceFormatKHR format = formats[0]; /* the tone map encodes: no _SRGB format */
    for (uint32_t i = 0; i < known; ++i) {
        if (formats[i].format == VK_FORMAT_B8G8R8A8_UNORM || formats[i].format == VK_FORMAT_R8G8B8A8_UNORM) format = formats[i];
    }
    const VkSwapchainKHR old = s->chain;
    const uint32_t wanted = can.minImageCount + 1;
    const VkSwapchainCreateInfoKHR info = {.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR, .surface = s->surface,
        .minImageCount = can.maxImageCount != 0 && can.maxImageCount < wanted ? can.maxImageCount : wanted,
        .imageFormat = format.format, .imageColorSpace = format.colorSpace, .imageExtent = s->extent, .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT, .preTransform = can.currentTransform,
        .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, .presentMode = VK_PRESENT_MODE_FIFO_KHR, .clipped = VK_TRUE,
        .oldSwapchain = old};
    check(vkCreateSwapchainKHR(h->device, &info, NULL, &s->chain), "vkCreateSwapchainKHR");
    vkDestroySwapchainKHR(h->device, old, NULL);
    s->count = MAX_IMAGES;
    check(vkGetSwapchainImagesKHR(h->device, s->chain, &s->count, s->images), "vkGetSwapchainImagesKHR");
    return true;
}

/* ---- effects ---- */

typedef struct Switches {
    bool diffuse, specular, contact, antialias, blur;
    float angle;
} Switches;

static void on_key(GLFWwindow* window, int key, int code, int action, int modifiers) {
    (void)code;
    (void)modifiers;
    Switches* on = glfwGetWindowUserPointer(window);
    if (action == GLFW_RELEASE) return;
    switch (key) {
        case GLFW_KEY_1: on->diffuse = !on->diffuse; break;
        case GLFW_KEY_2: on->specular = !on->specular; break;
        case GLFW_KEY_3: on->contact = !on->contact; break;
        case GLFW_KEY_4: on->antialias = !on->antialias; break;
        case GLFW_KEY_5: on->blur = !on->blur; break;
        case GLFW_KEY_LEFT: on->angle -= 0.05F; break;
        case GLFW_KEY_RIGHT: on->angle += 0.05F; break;
        case GLFW_KEY_ESCAPE: glfwSetWindowShouldClose(window, GLFW_TRUE); break;
        default: break;
    }
    char title[128];
    snprintf(title, sizeof title, "Reflet: SSGI %s, SSR %s, contact shadows %s, TAA %s, motion blur %s", on->diffuse ? "on" : "off",
             on->specular ? "on" : "off", on->contact ? "on" : "off", on->antialias ? "on" : "off", on->blur ? "on" : "off");
    glfwSetWindowTitle(window, title);
}

static RefletImage given(const Picture* p, VkImageLayout layout, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    const RefletImage image = {.image = p->image, .view = p->view, .format = p->format, .width = p->width, .height = p->height,
                               .layout = layout, .stages = stages, .access = access};
    return image;
}

static RefletImage given_depth(const Picture* p) {
    return given(p, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                 VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
}

static RefletImage given_target(const Picture* p) {
    return given(p, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                 VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
}

static RefletImage record_effects(Host* h, Slot* slot, RefletView view, RefletSettings settings, const Switches* on,
                                  const Camera* now, const Camera* before, float jitters[2][2]) {
    RefletFrameInfo frame;
    memset(&frame, 0, sizeof frame);
    frame.structSize = sizeof frame;
    frame.commandBuffer = slot->commands;
    frame.frameIndex = h->frame;
    frame.restFrames = h->rest;
    memcpy(frame.worldToView, now->world_to_view, sizeof frame.worldToView);
    memcpy(frame.viewToClip, h->view_to_clip, sizeof frame.viewToClip);
    memcpy(frame.previousWorldToView, before->world_to_view, sizeof frame.worldToView);
    memcpy(frame.previousViewToClip, h->view_to_clip, sizeof frame.viewToClip);
    memcpy(frame.jitter, jitters[0], sizeof frame.jitter);
    memcpy(frame.previousJitter, jitters[1], sizeof frame.previousJitter);
    RefletGBuffer gbuffer;
    memset(&gbuffer, 0, sizeof gbuffer);
    RefletGBuffer* g = &gbuffer;
    g->structSize = sizeof *g;
    frame.gbuffer = g;
    g->depth = given_depth(&h->depth);
    g->depthKind = REFLET_DEPTH_STANDARD;
    g->normal = given_target(&h->normal);
    g->normalKind = REFLET_NORMAL_VECTOR_SNORM;
    g->normalsInViewSpace = 1;
    g->roughness = g->normal;
    g->roughnessChannel = 3;
    g->roughnessKind = REFLET_ROUGHNESS_SMOOTHNESS;
    g->baseColor = given_target(&h->color);
    g->metallic = g->baseColor;
    g->metallicChannel = 3;
    g->motion = given_target(&h->motion);
    g->motionKind = REFLET_MOTION_NDC;
    reflet_check(refletBeginFrame(view, &frame));

    RefletSunShadow sun;
    memset(&sun, 0, sizeof sun);
    sun.structSize = sizeof sun;
    sun.map = given_depth(&h->sun_map);
    sun.depthKind = REFLET_DEPTH_STANDARD;
    sun.cascades = 1;
    memcpy(sun.worldToClip[0], now->world_to_sun, sizeof sun.worldToClip[0]);
    memcpy(sun.toSun, now->to_sun, sizeof sun.toSun);
    sun.contactShadows = on->contact;
    RefletImage visibility, display;
    reflet_check(refletSunShadow(view, settings, &sun, &visibility));
    barrier(slot->commands, visibility.image, VK_IMAGE_ASPECT_COLOR_BIT, visibility.layout, VK_IMAGE_LAYOUT_GENERAL, visibility.stages,
            visibility.access, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
    host_light(h, slot, visibility.view);

    RefletIndirectLight light;
    memset(&light, 0, sizeof light);
    light.structSize = sizeof light;
    light.light = given(&h->lit, VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    RefletEnvironment environment;
    memset(&environment, 0, sizeof environment);
    environment.structSize = sizeof environment;
    memcpy(environment.factor, now->sky, sizeof environment.factor);
    light.environment = &environment;
    RefletLobe lobe = {.structSize = sizeof lobe};
    if (on->diffuse) reflet_check(refletDiffuseGi(view, settings, &light, &lobe));
    if (on->specular) reflet_check(refletReflections(view, settings, &light, &lobe));
    RefletComposite sum = {.structSize = sizeof sum};
    reflet_check(refletComposite(view, settings, &light.light, &sum));
    RefletImage mean, blurred;
    if (on->antialias) reflet_check(refletTemporal(view, settings, NULL, &mean));
    if (on->blur) reflet_check(refletMotionBlur(view, settings, NULL, &blurred));
    reflet_check(refletToneMap(view, settings, NULL, 0, &display));
    reflet_check(refletEndFrame(view));
    return display;
}

static void copy_to_window(Slot* slot, const RefletImage* display, const Swap* s, uint32_t index) {
    const VkImageAspectFlags color = VK_IMAGE_ASPECT_COLOR_BIT;
    barrier(slot->commands, display->image, color, display->layout, VK_IMAGE_LAYOUT_GENERAL, display->stages, display->access,
            VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
    barrier(slot->commands, s->images[index], color, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
            VK_PIPELINE_STAGE_2_BLIT_BIT, 0, VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    const VkImageBlit blit = {.srcSubresource = {color, 0, 0, 1}, .dstSubresource = {color, 0, 0, 1},
        .srcOffsets = {{0, 0, 0}, {(int32_t)display->width, (int32_t)display->height, 1}},
        .dstOffsets = {{0, 0, 0}, {(int32_t)s->extent.width, (int32_t)s->extent.height, 1}}};
    vkCmdBlitImage(slot->commands, display->image, VK_IMAGE_LAYOUT_GENERAL, s->images[index], VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                   &blit, VK_FILTER_NEAREST);
    barrier(slot->commands, s->images[index], color, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
            VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0);
}

/* Targets, swap chain and Reflet's view for the window's size now. */
static bool resize(Host* h, Swap* s, GLFWwindow* window, RefletView view) {
    check(vkDeviceWaitIdle(h->device), "vkDeviceWaitIdle");
    if (!make_chain(h, s, window)) return false;
    host_free_targets(h);
    host_make_targets(h, s->extent.width, s->extent.height);
    reflet_check(refletResizeView(view, s->extent.width, s->extent.height));
    return true;
}

int main(int count, char** arguments) {
    const uint32_t frames = count > 1 ? (uint32_t)atoi(arguments[1]) : UINT32_MAX;
    if (!glfwInit()) {
        fprintf(stderr, "no display\n");
        return 1;
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    GLFWwindow* window = glfwCreateWindow(640, 360, "Reflet: keys 1 to 5", NULL, NULL);
    Switches on = {true, true, false, true, false, 0.35F};
    glfwSetWindowUserPointer(window, &on);
    glfwSetKeyCallback(window, on_key);

    Host h = {0};
    Swap s = {0};
    uint32_t extension_count;
    const char** extensions = glfwGetRequiredInstanceExtensions(&extension_count);
    const char* device_extensions[] = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    host_open(&h, extensions, extension_count, device_extensions, 1);
    check(glfwCreateWindowSurface(h.instance, window, NULL, &s.surface), "glfwCreateWindowSurface");
    VkBool32 presents = VK_FALSE;
    vkGetPhysicalDeviceSurfaceSupportKHR(h.physical, h.family, s.surface, &presents);
    if (!presents || !make_chain(&h, &s, window)) check(VK_ERROR_INITIALIZATION_FAILED, "presenting");
    host_make_targets(&h, s.extent.width, s.extent.height);
    for (uint32_t i = 0; i < FRAMES_IN_FLIGHT; ++i) s.acquired[i] = make_semaphore(&h);
    for (uint32_t i = 0; i < MAX_IMAGES; ++i) s.drawn[i] = make_semaphore(&h);

    RefletContextInfo info = {.structSize = sizeof info, .version = REFLET_VERSION, .instance = h.instance,
        .physicalDevice = h.physical, .device = h.device, .getInstanceProcAddr = vkGetInstanceProcAddr, .enabledFeatures = &h.features};
    RefletContext context;
    reflet_check(refletCreateContext(&info, &context));
    const RefletViewInfo view_info = {sizeof view_info, s.extent.width, s.extent.height, FRAMES_IN_FLIGHT, 0, 0};
    RefletView view;
    reflet_check(refletCreateView(context, &view_info, &view));
    RefletSettings settings;
    reflet_check(refletCreateSettings("fast", &settings));
    reflet_check(refletSetSetting(settings, "contact.distance", "0.2"));
    reflet_check(refletSetSetting(settings, "motion_blur.enabled", "true")); /* key 5 */

    Camera cameras[2];
    float jitters[2][2] = {{0.0F, 0.0F}, {0.0F, 0.0F}}; /* of this frame and the last */
    for (uint32_t i = 0; i < frames && !glfwWindowShouldClose(window); ++i) {
        glfwPollEvents();
        int width, height; /* not every driver says that the swap chain is out of date */
        glfwGetFramebufferSize(window, &width, &height);
        if ((uint32_t)width != s.extent.width || (uint32_t)height != s.extent.height) {
            while (!resize(&h, &s, window, view) && !glfwWindowShouldClose(window)) glfwWaitEvents();
        }
        Slot* slot = host_begin(&h);
        const uint32_t which = (uint32_t)(slot - h.slots);
        uint32_t index = 0;
        VkResult acquired = vkAcquireNextImageKHR(h.device, s.chain, UINT64_MAX, s.acquired[which], VK_NULL_HANDLE, &index);
        while (acquired == VK_ERROR_OUT_OF_DATE_KHR) {
            while (!resize(&h, &s, window, view) && !glfwWindowShouldClose(window)) glfwWaitEvents();
            acquired = vkAcquireNextImageKHR(h.device, s.chain, UINT64_MAX, s.acquired[which], VK_NULL_HANDLE, &index);
        }
        check(acquired, "vkAcquireNextImageKHR");
        memcpy(jitters[1], jitters[0], sizeof jitters[0]);
        jitters[0][0] = jitters[0][1] = 0.0F;
        if (on.antialias) refletJitter(i, jitters[0]);
        Camera* now = &cameras[i % 2];
        Camera* before = i > 0 ? &cameras[(i + 1) % 2] : now;
        host_camera(&h, now, i > 0 ? before : NULL, jitters[0], on.angle);
        host_draw(&h, slot, now);
        const RefletImage display = record_effects(&h, slot, view, settings, &on, now, before, jitters);
        copy_to_window(slot, &display, &s, index);
        check(vkEndCommandBuffer(slot->commands), "vkEndCommandBuffer");
        const VkPipelineStageFlags wait = VK_PIPELINE_STAGE_TRANSFER_BIT;
        const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .waitSemaphoreCount = 1,
            .pWaitSemaphores = &s.acquired[which], .pWaitDstStageMask = &wait, .commandBufferCount = 1,
            .pCommandBuffers = &slot->commands, .signalSemaphoreCount = 1, .pSignalSemaphores = &s.drawn[index]};
        check(vkQueueSubmit(h.queue, 1, &submit, slot->fence), "vkQueueSubmit");
        const VkPresentInfoKHR present = {.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR, .waitSemaphoreCount = 1,
            .pWaitSemaphores = &s.drawn[index], .swapchainCount = 1, .pSwapchains = &s.chain, .pImageIndices = &index};
        const VkResult presented = vkQueuePresentKHR(h.queue, &present);
        if (presented == VK_ERROR_OUT_OF_DATE_KHR || presented == VK_SUBOPTIMAL_KHR) {
            resize(&h, &s, window, view);
        } else {
            check(presented, "vkQueuePresentKHR");
        }
    }
    check(vkDeviceWaitIdle(h.device), "vkDeviceWaitIdle");
    refletDestroySettings(settings);
    refletDestroyView(view);
    refletDestroyContext(context);
    for (uint32_t i = 0; i < FRAMES_IN_FLIGHT; ++i) vkDestroySemaphore(h.device, s.acquired[i], NULL);
    for (uint32_t i = 0; i < MAX_IMAGES; ++i) vkDestroySemaphore(h.device, s.drawn[i], NULL);
    vkDestroySwapchainKHR(h.device, s.chain, NULL);
    vkDestroySurfaceKHR(h.instance, s.surface, NULL);
    host_free_targets(&h);
    host_close(&h);
    glfwDestroyWindow(window);
    glfwTerminate();
    return 0;
}
