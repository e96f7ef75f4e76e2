#include "effects.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void reflet_check(RefletResult result) {
    if (result != REFLET_SUCCESS) {
        fprintf(stderr, "%s: %s\n", refletResultName(result), refletLastError());
        exit(1);
    }
}

RefletContext make_context(const Host* h) {
    const RefletContextInfo info = {.structSize = sizeof info, .version = REFLET_VERSION, .instance = h->instance,
        .physicalDevice = h->physical, .device = h->device, .getInstanceProcAddr = vkGetInstanceProcAddr, .enabledFeatures = &h->features};
    RefletContext context;
    reflet_check(refletCreateContext(&info, &context));
    return context;
}

RefletImage given(const Picture* p, VkImageLayout layout, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    const RefletImage image = {.image = p->image, .view = p->view, .format = p->format, .width = p->width, .height = p->height,
                               .layout = layout, .stages = stages, .access = access, .baseLayer = p->layer};
    return image;
}

RefletImage given_target(const Host* h, const Picture* p) {
    if (h->readable_color != VK_IMAGE_LAYOUT_UNDEFINED) return given(p, h->readable_color, 0, 0);
    return given(p, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                 VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
}

RefletImage given_depth(const Host* h, const Picture* p) {
    if (h->readable_depth != VK_IMAGE_LAYOUT_UNDEFINED) return given(p, h->readable_depth, 0, 0);
    return given(p, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                 VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
}

RefletGBuffer gbuffer_of(const Host* h) {
    RefletGBuffer g;
    memset(&g, 0, sizeof g);
    g.structSize = sizeof g;
    g.depth = given_depth(h, &h->depth);
    g.depthKind = REFLET_DEPTH_STANDARD;
    g.normal = given_target(h, &h->normal);
    g.normalKind = REFLET_NORMAL_VECTOR_SNORM;
    g.normalsInViewSpace = 1;
    g.roughness = g.normal;
    g.roughnessChannel = 3;
    g.roughnessKind = REFLET_ROUGHNESS_SMOOTHNESS;
    g.baseColor = given_target(h, &h->color);
    g.metallic = g.baseColor;
    g.metallicChannel = 3;
    g.motion = given_target(h, &h->motion);
    g.motionKind = REFLET_MOTION_NDC;
    return g;
}

Frame next_frame(Host* h, Path* path, float angle) {
    const uint32_t i = path->frames++;
    Frame frame = {.now = &path->cameras[i % 2], .before = &path->cameras[(i + (i > 0)) % 2], .jitter = path->jitters[i % 2],
                   .previous_jitter = path->jitters[(i + (i > 0)) % 2]};
    refletJitter(i, frame.jitter);
    host_camera(h, frame.now, i > 0 ? frame.before : NULL, frame.jitter, angle);
    return frame;
}

void begin_effects(Host* h, Slot* slot, RefletView view, const Frame* frame) {
    RefletFrameInfo info;
    memset(&info, 0, sizeof info);
    info.structSize = sizeof info;
    info.commandBuffer = slot->commands;
    info.frameIndex = h->frame;
    info.restFrames = h->rest;
    memcpy(info.worldToView, frame->now->world_to_view, sizeof info.worldToView);
    memcpy(info.viewToClip, h->view_to_clip, sizeof info.viewToClip);
    memcpy(info.previousWorldToView, frame->before->world_to_view, sizeof info.worldToView);
    memcpy(info.previousViewToClip, h->view_to_clip, sizeof info.viewToClip);
    memcpy(info.jitter, frame->jitter, sizeof info.jitter);
    memcpy(info.previousJitter, frame->previous_jitter, sizeof info.previousJitter);
    memcpy(info.renderSize, frame->render_size, sizeof info.renderSize);
    const RefletGBuffer gbuffer = gbuffer_of(h);
    info.gbuffer = &gbuffer;
    reflet_check(refletBeginFrame(view, &info));
}

RefletIndirectLight light_room(Host* h, Slot* slot, RefletView view, RefletSettings settings, const Camera* now,
                               RefletEnvironment* environment) {
    RefletSunShadow sun;
    memset(&sun, 0, sizeof sun);
    sun.structSize = sizeof sun;
    sun.map = given_depth(h, &h->sun_map);
    sun.depthKind = REFLET_DEPTH_STANDARD;
    sun.cascades = 1;
    memcpy(sun.worldToClip[0], now->world_to_sun, sizeof sun.worldToClip[0]);
    memcpy(sun.toSun, now->to_sun, sizeof sun.toSun);
    sun.angularDiameter = 0.03F;
    RefletImage visibility;
    reflet_check(refletSunShadow(view, settings, &sun, &visibility));
    /* The host's own pass reads the result: a barrier from what wrote it. */
    barrier(slot->commands, visibility.image, VK_IMAGE_ASPECT_COLOR_BIT, visibility.layout, VK_IMAGE_LAYOUT_GENERAL,
            visibility.stages, visibility.access, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
    host_light(h, slot, visibility.view);

    memset(environment, 0, sizeof *environment);
    environment->structSize = sizeof *environment;
    memcpy(environment->factor, now->sky, sizeof environment->factor);
    const RefletIndirectLight light = {.structSize = sizeof light, .environment = environment,
        .light = given(&h->lit, VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT)};
    return light;
}

RefletImage finish_effects(RefletView view, RefletSettings settings) {
    RefletComposite sum = {.structSize = sizeof sum};
    RefletImage mean, display;
    reflet_check(refletComposite(view, settings, NULL, &sum));
    reflet_check(refletTemporal(view, settings, NULL, &mean));
    reflet_check(refletToneMap(view, settings, NULL, 0, &display));
    reflet_check(refletEndFrame(view));
    return display;
}

RefletImage record_effects(Host* h, Slot* slot, RefletView view, RefletSettings settings, const Frame* frame) {
    begin_effects(h, slot, view, frame);
    RefletEnvironment environment;
    RefletIndirectLight light = light_room(h, slot, view, settings, frame->now, &environment);
    RefletLobe diffuse = {.structSize = sizeof diffuse}, specular = {.structSize = sizeof specular};
    reflet_check(refletDiffuseGi(view, settings, &light, &diffuse));
    light.light.stages = 0; /* no longer new */
    reflet_check(refletReflections(view, settings, &light, &specular));
    return finish_effects(view, settings);
}
