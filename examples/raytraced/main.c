/*
 * Reflet with the host's own ray tracing behind the screen: rays that SSGI and SSR do not answer are traced against the room's
 * boxes by a compute shader (answer.comp), and Reflet goes on with environment and denoising. A host with acceleration structures
 * would trace them there.
 *
 * usage: reflet_raytraced_example [OUT.ppm [screen]]      screen: without the host's rays
 */
#include "effects.h"

#include <string.h>

enum { WIDTH = 640, HEIGHT = 360, FRAMES = 32, LOBES = 2 };

static const uint32_t answer_comp[] =
#include "answer.comp.inc"
    ;

/* The host's ray tracing: a compute pass that reads rays and writes answers. */
typedef struct Tracer {
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
    VkDescriptorPool pool;
    VkDescriptorSet sets[FRAMES_IN_FLIGHT][LOBES]; /* written anew in every frame: buffers may change */
} Tracer;

static Tracer make_tracer(Host* h) {
    Tracer t;
    VkDescriptorSetLayoutBinding bindings[2];
    for (uint32_t i = 0; i < 2; ++i) {
        bindings[i] = (VkDescriptorSetLayoutBinding){.binding = i, .descriptorCount = 1, .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT,
            .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    }
    const VkDescriptorSetLayoutCreateInfo set = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = 2,
        .pBindings = bindings};
    check(vkCreateDescriptorSetLayout(h->device, &set, NULL, &t.set_layout), "vkCreateDescriptorSetLayout");
    const VkDescriptorSetLayout layouts[] = {h->set_layout, t.set_layout}; /* the camera; rays and answers */
    const VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 2,
        .pSetLayouts = layouts};
    check(vkCreatePipelineLayout(h->device, &layout, NULL, &t.layout), "vkCreatePipelineLayout");
    const VkShaderModuleCreateInfo module = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = sizeof answer_comp,
        .pCode = answer_comp};
    VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, .layout = t.layout,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, .stage = VK_SHADER_STAGE_COMPUTE_BIT, .pName = "main"}};
    check(vkCreateShaderModule(h->device, &module, NULL, &info.stage.module), "vkCreateShaderModule");
    check(vkCreateComputePipelines(h->device, VK_NULL_HANDLE, 1, &info, NULL, &t.pipeline), "vkCreateComputePipelines");
    vkDestroyShaderModule(h->device, info.stage.module, NULL);
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2 * LOBES * FRAMES_IN_FLIGHT};
    const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = LOBES * FRAMES_IN_FLIGHT, .poolSizeCount = 1, .pPoolSizes = &size};
    check(vkCreateDescriptorPool(h->device, &pool, NULL, &t.pool), "vkCreateDescriptorPool");
    for (uint32_t i = 0; i < LOBES * FRAMES_IN_FLIGHT; ++i) {
        const VkDescriptorSetAllocateInfo one = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, .descriptorPool = t.pool,
            .descriptorSetCount = 1, .pSetLayouts = &t.set_layout};
        check(vkAllocateDescriptorSets(h->device, &one, &t.sets[i / LOBES][i % LOBES]), "vkAllocateDescriptorSets");
    }
    return t;
}

static void free_tracer(Host* h, Tracer* t) {
    vkDestroyDescriptorPool(h->device, t->pool, NULL);
    vkDestroyPipeline(h->device, t->pipeline, NULL);
    vkDestroyPipelineLayout(h->device, t->layout, NULL);
    vkDestroyDescriptorSetLayout(h->device, t->set_layout, NULL);
}

/* A barrier from what wrote one of Reflet's buffers. */
static void buffer_barrier(VkCommandBuffer commands, const RefletBuffer* b, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    const VkBufferMemoryBarrier2 one = {.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2, .srcStageMask = b->stages,
        .srcAccessMask = b->access, .dstStageMask = stages, .dstAccessMask = access, .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED, .buffer = b->buffer, .offset = b->offset, .size = b->size};
    const VkDependencyInfo info = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .bufferMemoryBarrierCount = 1,
        .pBufferMemoryBarriers = &one};
    vkCmdPipelineBarrier2(commands, &info);
}

/* Traces rays of Reflet. */
static void trace(Host* h, Tracer* t, Slot* slot, RefletLobeKind kind, const RefletMissedRays* missed) {
    const VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    buffer_barrier(slot->commands, &missed->rays, compute | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
    buffer_barrier(slot->commands, &missed->answers, compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    const VkDescriptorSet rays = t->sets[slot - h->slots][kind];
    const VkDescriptorBufferInfo buffers[] = {{missed->rays.buffer, missed->rays.offset, missed->rays.size},
                                              {missed->answers.buffer, missed->answers.offset, missed->answers.size}};
    const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, .dstSet = rays, .descriptorCount = 2,
        .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, .pBufferInfo = buffers};
    vkUpdateDescriptorSets(h->device, 1, &write, 0, NULL);
    const VkDescriptorSet sets[] = {slot->set, rays};
    vkCmdBindPipeline(slot->commands, VK_PIPELINE_BIND_POINT_COMPUTE, t->pipeline);
    vkCmdBindDescriptorSets(slot->commands, VK_PIPELINE_BIND_POINT_COMPUTE, t->layout, 0, 2, sets, 0, NULL);
    vkCmdDispatchIndirect(slot->commands, missed->rays.buffer, missed->rays.offset);
}

/* One lobe of indirect light. tracer: NULL: by screen and environment alone. */
static void lobe_of(Host* h, Slot* slot, RefletView view, RefletSettings settings, Tracer* tracer, RefletLobeKind kind,
                    const RefletIndirectLight* light, RefletLobe* lobe) {
    if (tracer == NULL) {
        reflet_check((kind == REFLET_LOBE_DIFFUSE ? refletDiffuseGi : refletReflections)(view, settings, light, lobe));
        return;
    }
    RefletMissedRays missed = {.structSize = sizeof missed};
    reflet_check(refletMissedRays(view, settings, kind, light, &missed));
    trace(h, tracer, slot, kind, &missed);
    const RefletRayAnswers answers = {sizeof answers, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    reflet_check(refletAnswerRays(view, settings, kind, &answers, lobe));
}

static RefletImage record_traced(Host* h, Slot* slot, RefletView view, RefletSettings settings, Tracer* tracer, const Frame* frame) {
    begin_effects(h, slot, view, frame);
    RefletEnvironment environment;
    RefletIndirectLight light = light_room(h, slot, view, settings, frame->now, &environment);
    RefletLobe diffuse = {.structSize = sizeof diffuse}, specular = {.structSize = sizeof specular};
    lobe_of(h, slot, view, settings, tracer, REFLET_LOBE_DIFFUSE, &light, &diffuse);
    light.light.stages = 0; /* no longer new */
    lobe_of(h, slot, view, settings, tracer, REFLET_LOBE_SPECULAR, &light, &specular);
    return finish_effects(view, settings);
}

int main(int count, char** arguments) {
    const char* path = count > 1 ? arguments[1] : "raytraced.ppm";
    const bool screen = count > 2 && strcmp(arguments[2], "screen") == 0;
    Host h = {0};
    host_open(&h, NULL, 0, NULL, 0);
    host_make_targets(&h, WIDTH, HEIGHT);
    Tracer tracer = make_tracer(&h);
    Download download = make_download(&h, WIDTH, HEIGHT);

    RefletContext context = make_context(&h);
    const RefletViewInfo view_info = {sizeof view_info, WIDTH, HEIGHT, FRAMES_IN_FLIGHT, 0, 0};
    RefletView view;
    reflet_check(refletCreateView(context, &view_info, &view));
    RefletSettings settings;
    reflet_check(refletCreateSettings("balanced", &settings));

    Path camera_path = {0};
    for (uint32_t i = 0; i < FRAMES; ++i) {
        Slot* slot = host_begin(&h);
        const Frame frame = next_frame(&h, &camera_path, 0.35F);
        host_draw(&h, slot, frame.now);
        const RefletImage picture = record_traced(&h, slot, view, settings, screen ? NULL : &tracer, &frame);
        if (i + 1 == FRAMES) record_download(&download, slot->commands, picture.image, picture.stages, picture.access);
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
