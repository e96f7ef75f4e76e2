#include "host.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t room_vert[] =
#include "room.vert.inc"
    ;
static const uint32_t room_frag[] =
#include "room.frag.inc"
    ;
static const uint32_t sun_vert[] =
#include "sun.vert.inc"
    ;
static const uint32_t light_comp[] =
#include "light.comp.inc"
    ;

void check(VkResult result, const char* what) {
    if (result < 0) {
        fprintf(stderr, "%s failed: VkResult %d\n", what, result);
        exit(1);
    }
}

void host_make_targets(Host* h, uint32_t width, uint32_t height) {
    h->width = width;
    h->height = height;
    const VkImageUsageFlags target = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    const VkImageUsageFlags depth = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    h->depth = make_picture(h, width, height, VK_FORMAT_D32_SFLOAT, depth);
    h->normal = make_picture(h, width, height, VK_FORMAT_R16G16B16A16_SFLOAT, target);
    h->color = make_picture(h, width, height, VK_FORMAT_R8G8B8A8_SRGB, target);
    h->motion = make_picture(h, width, height, VK_FORMAT_R16G16_SFLOAT, target);
    h->lit = make_picture(h, width, height, VK_FORMAT_R16G16B16A16_SFLOAT,
                          VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    h->sun_map = make_picture(h, SUN_MAP_SIDE, SUN_MAP_SIDE, VK_FORMAT_D32_SFLOAT, depth);
}

void host_free_targets(Host* h) {
    Picture* all[] = {&h->depth, &h->normal, &h->color, &h->motion, &h->lit, &h->sun_map};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) free_picture(h, all[i]);
}

/* ---- device and pipelines ---- */

static VkPipelineShaderStageCreateInfo stage_of(Host* h, VkShaderStageFlagBits stage, const uint32_t* words, size_t size) {
    const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size,
        .pCode = words};
    VkPipelineShaderStageCreateInfo made = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, .stage = stage,
        .pName = "main"};
    check(vkCreateShaderModule(h->device, &info, NULL, &made.module), "vkCreateShaderModule");
    return made;
}

/* pass: VK_NULL_HANDLE: drawn by dynamic rendering. */
static VkPipeline make_raster(Host* h, VkPipelineShaderStageCreateInfo* stages, uint32_t count, const VkFormat* colors,
                              uint32_t color_count, VkRenderPass pass) {
    const VkPipelineVertexInputStateCreateInfo input = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo triangles = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1, .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1.0F};
    const VkPipelineMultisampleStateCreateInfo samples = {.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineDepthStencilStateCreateInfo depth = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = VK_TRUE, .depthWriteEnable = VK_TRUE, .depthCompareOp = VK_COMPARE_OP_LESS};
    VkPipelineColorBlendAttachmentState writes[3] = {{.colorWriteMask = 15}, {.colorWriteMask = 15}, {.colorWriteMask = 15}};
    const VkPipelineColorBlendStateCreateInfo blend = {.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = color_count, .pAttachments = writes};
    const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2, .pDynamicStates = states};
    const VkPipelineRenderingCreateInfo targets = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = color_count, .pColorAttachmentFormats = colors, .depthAttachmentFormat = VK_FORMAT_D32_SFLOAT};
    const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, .renderPass = pass,
        .pNext = pass == VK_NULL_HANDLE ? &targets : NULL, .stageCount = count, .pStages = stages, .pVertexInputState = &input, .pInputAssemblyState = &triangles,
        .pViewportState = &viewport, .pRasterizationState = &raster, .pMultisampleState = &samples,
        .pDepthStencilState = &depth, .pColorBlendState = &blend, .pDynamicState = &dynamic, .layout = h->layout};
    VkPipeline pipeline;
    check(vkCreateGraphicsPipelines(h->device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline), "vkCreateGraphicsPipelines");
    for (uint32_t i = 0; i < count; ++i) vkDestroyShaderModule(h->device, stages[i].module, NULL);
    return pipeline;
}

static void make_raster_pipelines(Host* h, VkRenderPass room_pass, VkRenderPass sun_pass) {
    const VkFormat colors[] = {VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R16G16_SFLOAT};
    VkPipelineShaderStageCreateInfo room[] = {stage_of(h, VK_SHADER_STAGE_VERTEX_BIT, room_vert, sizeof room_vert),
                                              stage_of(h, VK_SHADER_STAGE_FRAGMENT_BIT, room_frag, sizeof room_frag)};
    h->room = make_raster(h, room, 2, colors, 3, room_pass);
    VkPipelineShaderStageCreateInfo sun = stage_of(h, VK_SHADER_STAGE_VERTEX_BIT, sun_vert, sizeof sun_vert);
    h->sun = make_raster(h, &sun, 1, NULL, 0, sun_pass);
}

void host_use_render_passes(Host* h, VkRenderPass room, VkRenderPass sun) {
    vkDestroyPipeline(h->device, h->room, NULL);
    vkDestroyPipeline(h->device, h->sun, NULL);
    make_raster_pipelines(h, room, sun);
}

static void make_pipelines(Host* h) {
    VkDescriptorSetLayoutBinding bindings[6];
    for (uint32_t i = 0; i < 6; ++i) {
        bindings[i] = (VkDescriptorSetLayoutBinding){.binding = i, .descriptorCount = 1, .stageFlags = VK_SHADER_STAGE_ALL,
            .descriptorType = i == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : i == 5 ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                                                                            : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
    }
    VkDescriptorSetLayoutCreateInfo set = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = 6, .pBindings = bindings};
    check(vkCreateDescriptorSetLayout(h->device, &set, NULL, &h->light_set_layout), "vkCreateDescriptorSetLayout");
    set.bindingCount = 1;
    check(vkCreateDescriptorSetLayout(h->device, &set, NULL, &h->set_layout), "vkCreateDescriptorSetLayout");
    VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1,
        .pSetLayouts = &h->set_layout};
    check(vkCreatePipelineLayout(h->device, &layout, NULL, &h->layout), "vkCreatePipelineLayout");
    layout.pSetLayouts = &h->light_set_layout;
    check(vkCreatePipelineLayout(h->device, &layout, NULL, &h->light_layout), "vkCreatePipelineLayout");
    make_raster_pipelines(h, VK_NULL_HANDLE, VK_NULL_HANDLE);
    const VkComputePipelineCreateInfo light = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, .layout = h->light_layout,
        .stage = stage_of(h, VK_SHADER_STAGE_COMPUTE_BIT, light_comp, sizeof light_comp)};
    check(vkCreateComputePipelines(h->device, VK_NULL_HANDLE, 1, &light, NULL, &h->light), "vkCreateComputePipelines");
    vkDestroyShaderModule(h->device, light.stage.module, NULL);
}

static void open_device(Host* h, const char* const* extensions, uint32_t count) {
    uint32_t one = 1;
    vkEnumeratePhysicalDevices(h->instance, &one, &h->physical);
    if (one == 0) check(VK_ERROR_INITIALIZATION_FAILED, "finding a device");
    VkQueueFamilyProperties families[16];
    uint32_t known = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(h->physical, &known, NULL);
    known = known < 16 ? known : 16;
    vkGetPhysicalDeviceQueueFamilyProperties(h->physical, &known, families);
    while ((families[h->family].queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0 && h->family + 1 < known) ++h->family;
    h->features13 = (VkPhysicalDeviceVulkan13Features){.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
        .dynamicRendering = VK_TRUE, .synchronization2 = VK_TRUE};
    h->features12 = (VkPhysicalDeviceVulkan12Features){.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
        .pNext = &h->features13, .scalarBlockLayout = VK_TRUE};
    h->features = (VkPhysicalDeviceFeatures2){.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &h->features12,
        .features = {.imageCubeArray = VK_TRUE, .shaderStorageImageExtendedFormats = VK_TRUE}};
    const float priority = 1.0F;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueFamilyIndex = h->family,
        .queueCount = 1, .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .pNext = &h->features,
        .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue, .enabledExtensionCount = count,
        .ppEnabledExtensionNames = extensions};
    check(vkCreateDevice(h->physical, &info, NULL, &h->device), "vkCreateDevice");
    vkGetDeviceQueue(h->device, h->family, 0, &h->queue);
}

static void make_slots(Host* h) {
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT, .queueFamilyIndex = h->family};
    check(vkCreateCommandPool(h->device, &pool, NULL, &h->pool), "vkCreateCommandPool");
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 2 * FRAMES_IN_FLIGHT},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8 * FRAMES_IN_FLIGHT}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 2 * FRAMES_IN_FLIGHT}};
    const VkDescriptorPoolCreateInfo sets = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, .maxSets = 2 * FRAMES_IN_FLIGHT,
        .poolSizeCount = 3, .pPoolSizes = sizes};
    check(vkCreateDescriptorPool(h->device, &sets, NULL, &h->sets), "vkCreateDescriptorPool");
    const VkBufferCreateInfo buffer = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = 1024 * FRAMES_IN_FLIGHT,
        .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT};
    check(vkCreateBuffer(h->device, &buffer, NULL, &h->cameras), "vkCreateBuffer");
    h->camera_memory = bind_buffer(h, h->cameras, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkMapMemory(h->device, h->camera_memory, 0, VK_WHOLE_SIZE, 0, (void**)&h->mapped_cameras), "vkMapMemory");
    for (uint32_t i = 0; i < FRAMES_IN_FLIGHT; ++i) {
        Slot* slot = &h->slots[i];
        const VkCommandBufferAllocateInfo commands = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
            .commandPool = h->pool, .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY, .commandBufferCount = 1};
        check(vkAllocateCommandBuffers(h->device, &commands, &slot->commands), "vkAllocateCommandBuffers");
        const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, .flags = VK_FENCE_CREATE_SIGNALED_BIT};
        check(vkCreateFence(h->device, &fence, NULL, &slot->fence), "vkCreateFence");
        VkDescriptorSetAllocateInfo set = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
            .descriptorPool = h->sets, .descriptorSetCount = 1, .pSetLayouts = &h->set_layout};
        check(vkAllocateDescriptorSets(h->device, &set, &slot->set), "vkAllocateDescriptorSets");
        set.pSetLayouts = &h->light_set_layout;
        check(vkAllocateDescriptorSets(h->device, &set, &slot->light_set), "vkAllocateDescriptorSets");
        const VkDescriptorBufferInfo camera = {h->cameras, 1024 * i, sizeof(Camera)};
        VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, .dstSet = slot->set,
            .descriptorCount = 1, .descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, .pBufferInfo = &camera};
        vkUpdateDescriptorSets(h->device, 1, &write, 0, NULL);
        write.dstSet = slot->light_set;
        vkUpdateDescriptorSets(h->device, 1, &write, 0, NULL);
    }
}

void host_open(Host* h, const char* const* instance_extensions, uint32_t instance_extension_count,
               const char* const* device_extensions, uint32_t device_extension_count) {
    const VkApplicationInfo app = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &app,
        .enabledExtensionCount = instance_extension_count, .ppEnabledExtensionNames = instance_extensions};
    check(vkCreateInstance(&info, NULL, &h->instance), "vkCreateInstance");
    open_device(h, device_extensions, device_extension_count);
    const VkSamplerCreateInfo sampler = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    check(vkCreateSampler(h->device, &sampler, NULL, &h->sampler), "vkCreateSampler");
    make_pipelines(h);
    make_slots(h);
}

void host_open_beside(Host* h, const Host* first) {
    *h = *first;
    const Picture none = {0};
    h->depth = h->normal = h->color = h->motion = h->lit = h->sun_map = none;
    make_slots(h);
}

void host_close_beside(Host* h) {
    for (uint32_t i = 0; i < FRAMES_IN_FLIGHT; ++i) vkDestroyFence(h->device, h->slots[i].fence, NULL);
    vkDestroyDescriptorPool(h->device, h->sets, NULL);
    vkDestroyCommandPool(h->device, h->pool, NULL);
    vkDestroyBuffer(h->device, h->cameras, NULL);
    vkFreeMemory(h->device, h->camera_memory, NULL);
}

void host_close(Host* h) {
    VkPipeline pipelines[] = {h->room, h->sun, h->light};
    for (int i = 0; i < 3; ++i) vkDestroyPipeline(h->device, pipelines[i], NULL);
    vkDestroyPipelineLayout(h->device, h->layout, NULL);
    vkDestroyPipelineLayout(h->device, h->light_layout, NULL);
    vkDestroyDescriptorSetLayout(h->device, h->set_layout, NULL);
    vkDestroyDescriptorSetLayout(h->device, h->light_set_layout, NULL);
    vkDestroySampler(h->device, h->sampler, NULL);
    host_close_beside(h);
    vkDestroyDevice(h->device, NULL);
    vkDestroyInstance(h->instance, NULL);
}

/* ---- a frame ---- */

Slot* host_begin(Host* h) {
    Slot* slot = &h->slots[h->frame++ % FRAMES_IN_FLIGHT];
    check(vkWaitForFences(h->device, 1, &slot->fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    check(vkResetFences(h->device, 1, &slot->fence), "vkResetFences");
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(vkBeginCommandBuffer(slot->commands, &begin), "vkBeginCommandBuffer");
    return slot;
}

void host_draw_boxes(Host* h, Slot* slot, VkPipeline pipeline, uint32_t width, uint32_t height) {
    const VkViewport viewport = {0, 0, (float)width, (float)height, 0, 1};
    const VkRect2D all = {{0, 0}, {width, height}};
    vkCmdSetViewport(slot->commands, 0, 1, &viewport);
    vkCmdSetScissor(slot->commands, 0, 1, &all);
    vkCmdBindPipeline(slot->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(slot->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, h->layout, 0, 1, &slot->set, 0, NULL);
    vkCmdDraw(slot->commands, 36, 8, 0, 0);
}

static void draw_boxes(Host* h, Slot* slot, VkPipeline pipeline, const Picture* depth, const VkRenderingAttachmentInfo* colors,
                       uint32_t count) {
    const VkPipelineStageFlags2 tests = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    const VkAccessFlags2 tested = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    picture_barrier(slot->commands, depth, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                    tests | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, tested, tests, tested);
    const VkRenderingAttachmentInfo depth_target = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = depth->view, .imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR, .storeOp = VK_ATTACHMENT_STORE_OP_STORE, .clearValue = {.depthStencil = {1.0F, 0}}};
    const VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = {{0, 0}, {depth->width, depth->height}},
        .layerCount = 1, .colorAttachmentCount = count, .pColorAttachments = colors, .pDepthAttachment = &depth_target};
    vkCmdBeginRendering(slot->commands, &info);
    host_draw_boxes(h, slot, pipeline, depth->width, depth->height);
    vkCmdEndRendering(slot->commands);
}

void host_upload(Host* h, Slot* slot, const Camera* c) { memcpy(h->mapped_cameras + 1024 * (size_t)(slot - h->slots), c, sizeof *c); }

void host_draw(Host* h, Slot* slot, const Camera* c) {
    host_upload(h, slot, c);
    draw_boxes(h, slot, h->sun, &h->sun_map, NULL, 0);
    const Picture* targets[] = {&h->normal, &h->color, &h->motion};
    VkRenderingAttachmentInfo colors[3];
    for (int i = 0; i < 3; ++i) {
        picture_barrier(slot->commands, targets[i], VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
        colors[i] = (VkRenderingAttachmentInfo){.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = targets[i]->view, .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR, .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    }
    draw_boxes(h, slot, h->room, &h->depth, colors, 3);
}

void host_light(Host* h, Slot* slot, VkImageView visibility) {
    const VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    const bool readable = h->readable_color != VK_IMAGE_LAYOUT_UNDEFINED;
    const VkImageLayout read = readable ? h->readable_color : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkImageLayout read_depth = readable ? h->readable_depth : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const Picture* sampled[] = {&h->normal, &h->color};
    for (int i = 0; i < 2 && !readable; ++i) {
        picture_barrier(slot->commands, sampled[i], VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, read,
                        VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, compute,
                        VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
    }
    if (!readable) {
        picture_barrier(slot->commands, &h->depth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, read_depth,
                        VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, compute,
                        VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
    }
    picture_barrier(slot->commands, &h->lit, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, compute,
                    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    VkDescriptorImageInfo images[5] = {{h->sampler, h->depth.view, read_depth}, {h->sampler, h->normal.view, read},
        {h->sampler, h->color.view, read}, {h->sampler, visibility, VK_IMAGE_LAYOUT_GENERAL},
        {VK_NULL_HANDLE, h->lit.view, VK_IMAGE_LAYOUT_GENERAL}};
    VkWriteDescriptorSet writes[5];
    for (uint32_t i = 0; i < 5; ++i) {
        writes[i] = (VkWriteDescriptorSet){.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, .dstSet = slot->light_set, .dstBinding = i + 1,
            .descriptorCount = 1, .pImageInfo = &images[i],
            .descriptorType = i < 4 ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
    }
    vkUpdateDescriptorSets(h->device, 5, writes, 0, NULL);
    vkCmdBindPipeline(slot->commands, VK_PIPELINE_BIND_POINT_COMPUTE, h->light);
    vkCmdBindDescriptorSets(slot->commands, VK_PIPELINE_BIND_POINT_COMPUTE, h->light_layout, 0, 1, &slot->light_set, 0, NULL);
    vkCmdDispatch(slot->commands, (h->width + 7) / 8, (h->height + 7) / 8, 1);
}

void host_submit(Host* h, Slot* slot) {
    check(vkEndCommandBuffer(slot->commands), "vkEndCommandBuffer");
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1,
        .pCommandBuffers = &slot->commands};
    check(vkQueueSubmit(h->queue, 1, &submit, slot->fence), "vkQueueSubmit");
}
