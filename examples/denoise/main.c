/*
 * Reflet as a denoiser: the host traces one diffuse ray per pixel and frame itself; Reflet removes the noise, multiplies by the
 * surface's reflectance and adds the direct light.
 *
 * usage: reflet_denoise_example [OUT.ppm [noisy]]      noisy: as it comes from the host
 */
#include "host.h"

#include <reflet/reflet.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 640, HEIGHT = 360, FRAMES = 32 };

static const uint32_t noisy_comp[] =
#include "noisy.comp.inc"
    ;

static void reflet_check(RefletResult result) {
    if (result != REFLET_SUCCESS) {
        fprintf(stderr, "%s: %s\n", refletResultName(result), refletLastError());
        exit(1);
    }
}

/* The host's ray tracing: a compute pass that reads the G-buffer. */
typedef struct Tracer {
    VkPipelineLayout layout;
    VkPipeline pipeline;
    VkDescriptorPool pool;
    VkDescriptorSet sets[FRAMES_IN_FLIGHT];
    Picture noisy;
} Tracer;

static Tracer make_tracer(Host* h) {
    Tracer t;
    t.noisy = make_picture(h, h->width, h->height, VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    const VkPushConstantRange push = {VK_SHADER_STAGE_COMPUTE_BIT, 0, 4};
    const VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1,
        .pSetLayouts = &h->light_set_layout, .pushConstantRangeCount = 1, .pPushConstantRanges = &push};
    check(vkCreatePipelineLayout(h->device, &layout, NULL, &t.layout), "vkCreatePipelineLayout");
    const VkShaderModuleCreateInfo module = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = sizeof noisy_comp,
        .pCode = noisy_comp};
    VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, .layout = t.layout,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, .stage = VK_SHADER_STAGE_COMPUTE_BIT, .pName = "main"}};
    check(vkCreateShaderModule(h->device, &module, NULL, &info.stage.module), "vkCreateShaderModule");
    check(vkCreateComputePipelines(h->device, VK_NULL_HANDLE, 1, &info, NULL, &t.pipeline), "vkCreateComputePipelines");
    vkDestroyShaderModule(h->device, info.stage.module, NULL);
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, FRAMES_IN_FLIGHT},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4 * FRAMES_IN_FLIGHT}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, FRAMES_IN_FLIGHT}};
    const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, .maxSets = FRAMES_IN_FLIGHT,
        .poolSizeCount = 3, .pPoolSizes = sizes};
    check(vkCreateDescriptorPool(h->device, &pool, NULL, &t.pool), "vkCreateDescriptorPool");
    for (uint32_t i = 0; i < FRAMES_IN_FLIGHT; ++i) {
        const VkDescriptorSetAllocateInfo set = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, .descriptorPool = t.pool,
            .descriptorSetCount = 1, .pSetLayouts = &h->light_set_layout};
        check(vkAllocateDescriptorSets(h->device, &set, &t.sets[i]), "vkAllocateDescriptorSets");
        const VkDescriptorBufferInfo camera = {h->cameras, 1024 * i, sizeof(Camera)};
        const VkImageLayout read = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        const VkDescriptorImageInfo images[5] = {{h->sampler, h->depth.view, read}, {h->sampler, h->normal.view, read},
            {h->sampler, h->color.view, read}, {h->sampler, h->color.view, read}, {VK_NULL_HANDLE, t.noisy.view, VK_IMAGE_LAYOUT_GENERAL}};
        VkWriteDescriptorSet writes[6];
        for (uint32_t k = 0; k < 6; ++k) {
            writes[k] = (VkWriteDescriptorSet){.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, .dstSet = t.sets[i], .dstBinding = k,
                .descriptorCount = 1, .pBufferInfo = &camera, .pImageInfo = k > 0 ? &images[k - 1] : NULL,
                .descriptorType = k == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : k == 5 ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                                                                               : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
        }
        vkUpdateDescriptorSets(h->device, 6, writes, 0, NULL);
    }
    return t;
}

static void free_tracer(Host* h, Tracer* t) {
    vkDestroyDescriptorPool(h->device, t->pool, NULL);
    vkDestroyPipeline(h->device, t->pipeline, NULL);
    vkDestroyPipelineLayout(h->device, t->layout, NULL);
    free_picture(h, &t->noisy);
}

/* After host_light, which has made the G-buffer readable. */
static void trace(Host* h, Tracer* t, Slot* slot) {
    barrier(slot->commands, t->noisy.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL,
            VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
            VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    vkCmdBindPipeline(slot->commands, VK_PIPELINE_BIND_POINT_COMPUTE, t->pipeline);
    vkCmdBindDescriptorSets(slot->commands, VK_PIPELINE_BIND_POINT_COMPUTE, t->layout, 0, 1, &t->sets[slot - h->slots], 0, NULL);
    vkCmdPushConstants(slot->commands, t->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, 4, &h->frame);
    vkCmdDispatch(slot->commands, (h->width + 7) / 8, (h->height + 7) / 8, 1);
}

static RefletImage given(const Picture* p, VkImageLayout layout, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    const RefletImage image = {.image = p->image, .view = p->view, .format = p->format, .width = p->width, .height = p->height,
                               .layout = layout, .stages = stages, .access = access};
    return image;
}

static void begin_frame(Host* h, Slot* slot, RefletView view, const Camera* now, const Camera* before) {
    RefletFrameInfo frame;
    memset(&frame, 0, sizeof frame);
    frame.structSize = sizeof frame;
    frame.commandBuffer = slot->commands;
    frame.frameIndex = h->frame;
    memcpy(frame.worldToView, now->world_to_view, sizeof frame.worldToView);
    memcpy(frame.viewToClip, h->view_to_clip, sizeof frame.viewToClip);
    memcpy(frame.previousWorldToView, before->world_to_view, sizeof frame.worldToView);
    memcpy(frame.previousViewToClip, h->view_to_clip, sizeof frame.viewToClip);
    RefletGBuffer gbuffer;
    memset(&gbuffer, 0, sizeof gbuffer);
    RefletGBuffer* g = &gbuffer;
    g->structSize = sizeof *g;
    frame.gbuffer = g;
    const VkPipelineStageFlags2 drawn = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    const VkAccessFlags2 written = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    g->depth = given(&h->depth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
    g->depthKind = REFLET_DEPTH_STANDARD;
    g->normal = given(&h->normal, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, drawn, written);
    g->normalKind = REFLET_NORMAL_VECTOR_SNORM;
    g->normalsInViewSpace = 1;
    g->roughness = g->normal;
    g->roughnessChannel = 3;
    g->roughnessKind = REFLET_ROUGHNESS_SMOOTHNESS;
    g->baseColor = given(&h->color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, drawn, written);
    g->metallic = g->baseColor;
    g->metallicChannel = 3;
    reflet_check(refletBeginFrame(view, &frame));
}

int main(int count, char** arguments) {
    const char* path = count > 1 ? arguments[1] : "denoised.ppm";
    const bool noisy = count > 2 && strcmp(arguments[2], "noisy") == 0;
    Host h = {0};
    host_open(&h, NULL, 0, NULL, 0);
    host_make_targets(&h, WIDTH, HEIGHT);
    Tracer tracer = make_tracer(&h);
    Download download = make_download(&h, WIDTH, HEIGHT);

    RefletContextInfo info = {.structSize = sizeof info, .version = REFLET_VERSION, .instance = h.instance,
        .physicalDevice = h.physical, .device = h.device, .getInstanceProcAddr = vkGetInstanceProcAddr, .enabledFeatures = &h.features};
    RefletContext context;
    reflet_check(refletCreateContext(&info, &context));
    const RefletViewInfo view_info = {sizeof view_info, WIDTH, HEIGHT, FRAMES_IN_FLIGHT, 0, 0};
    RefletView view;
    reflet_check(refletCreateView(context, &view_info, &view));
    RefletSettings settings;
    reflet_check(refletCreateSettings("balanced", &settings));
    if (noisy) {
        reflet_check(refletSetSetting(settings, "denoise.history", "0"));
        reflet_check(refletSetSetting(settings, "denoise.passes", "0"));
    }

    Camera cameras[2];
    const float jitter[2] = {0.0F, 0.0F};
    for (uint32_t i = 0; i < FRAMES; ++i) {
        Camera* now = &cameras[i % 2];
        Slot* slot = host_begin(&h);
        host_camera(&h, now, i > 0 ? &cameras[(i + 1) % 2] : NULL, jitter, 0.35F);
        host_draw(&h, slot, now);
        begin_frame(&h, slot, view, now, i > 0 ? &cameras[(i + 1) % 2] : now);
        RefletSunShadow sun;
        memset(&sun, 0, sizeof sun);
        sun.structSize = sizeof sun;
        sun.map = given(&h.sun_map, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
        sun.depthKind = REFLET_DEPTH_STANDARD;
        sun.cascades = 1;
        memcpy(sun.worldToClip[0], now->world_to_sun, sizeof sun.worldToClip[0]);
        memcpy(sun.toSun, now->to_sun, sizeof sun.toSun);
        RefletImage visibility, display;
        reflet_check(refletSunShadow(view, settings, &sun, &visibility));
        barrier(slot->commands, visibility.image, VK_IMAGE_ASPECT_COLOR_BIT, visibility.layout, VK_IMAGE_LAYOUT_GENERAL, visibility.stages,
                visibility.access, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
        host_light(&h, slot, visibility.view);
        trace(&h, &tracer, slot);

        const VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        const RefletImage rays = given(&tracer.noisy, VK_IMAGE_LAYOUT_GENERAL, compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
        const RefletImage direct = given(&h.lit, VK_IMAGE_LAYOUT_GENERAL, compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
        RefletLobe clean = {.structSize = sizeof clean};
        reflet_check(refletDenoise(view, settings, REFLET_LOBE_DIFFUSE, &rays, &clean));
        RefletIndirectLight light; /* metals have no diffuse light: screen-space reflections for them */
        memset(&light, 0, sizeof light);
        light.structSize = sizeof light;
        light.light = direct;
        RefletEnvironment environment;
        memset(&environment, 0, sizeof environment);
        environment.structSize = sizeof environment;
        memcpy(environment.factor, now->sky, sizeof environment.factor);
        light.environment = &environment;
        RefletLobe specular = {.structSize = sizeof specular};
        reflet_check(refletReflections(view, settings, &light, &specular));
        RefletComposite sum = {.structSize = sizeof sum};
        reflet_check(refletComposite(view, settings, NULL, &sum));
        reflet_check(refletToneMap(view, settings, NULL, 0, &display));
        reflet_check(refletEndFrame(view));
        if (i + 1 == FRAMES) record_download(&download, slot->commands, display.image, display.stages, display.access);
        host_submit(&h, slot);
    }
    check(vkDeviceWaitIdle(h.device), "vkDeviceWaitIdle");
    write_download(&h, &download, path);
    refletDestroySettings(settings);
    refletDestroyView(view);
    refletDestroyContext(context);
    free_tracer(&h, &tracer);
    host_free_targets(&h);
    host_close(&h);
    return 0;
}
