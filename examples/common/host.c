#include "host.h"

#include <math.h>
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

/* ---- matrices: column-major, element (row, column) is m[4 * column + row] ---- */

static void multiply(float* out, const float* a, const float* b) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            float sum = 0.0F;
            for (int k = 0; k < 4; ++k) sum += a[4 * k + r] * b[4 * c + k];
            out[4 * c + r] = sum;
        }
    }
}

static void normalize3(float* v) {
    const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; ++i) v[i] /= length;
}

static void cross3(float* out, const float* a, const float* b) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Right-handed: the camera looks along -Z of view space. */
static void look_at(float* m, const float* eye, const float* target) {
    float z[3] = {eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]};
    const float up[3] = {0.0F, 1.0F, 0.0F};
    float x[3], y[3];
    normalize3(z);
    cross3(x, up, z);
    normalize3(x);
    cross3(y, z, x);
    for (int i = 0; i < 3; ++i) {
        m[4 * i] = x[i];
        m[4 * i + 1] = y[i];
        m[4 * i + 2] = z[i];
        m[4 * i + 3] = 0.0F;
    }
    m[12] = -(x[0] * eye[0] + x[1] * eye[1] + x[2] * eye[2]);
    m[13] = -(y[0] * eye[0] + y[1] * eye[1] + y[2] * eye[2]);
    m[14] = -(z[0] * eye[0] + z[1] * eye[1] + z[2] * eye[2]);
    m[15] = 1.0F;
}

/* Standard depth, 0 at the near plane; y down in clip space. */
static void perspective(float* m, float tangent, float aspect, float near, float far) {
    memset(m, 0, 16 * sizeof(float));
    m[0] = 1.0F / (tangent * aspect);
    m[5] = -1.0F / tangent;
    m[10] = far / (near - far);
    m[11] = -1.0F;
    m[14] = near * far / (near - far);
}

static void orthographic(float* m, float half, float near, float far) {
    memset(m, 0, 16 * sizeof(float));
    m[0] = 1.0F / half;
    m[5] = -1.0F / half;
    m[10] = 1.0F / (near - far);
    m[14] = near / (near - far);
    m[15] = 1.0F;
}

void host_camera(Host* h, Camera* c, const Camera* before, const float jitter[2], float angle) {
    const float eye[3] = {6.2F * sinf(angle), 2.2F, 6.2F * cosf(angle)};
    const float target[3] = {0.0F, 0.9F, 0.0F};
    look_at(c->world_to_view, eye, target);
    perspective(h->view_to_clip, 0.45F, (float)h->width / (float)h->height, 0.1F, 50.0F);
    multiply(c->world_to_clip_plain, h->view_to_clip, c->world_to_view);
    float jittered[16];
    memcpy(jittered, h->view_to_clip, sizeof jittered);
    for (int i = 0; i < 4; ++i) { /* x += shift * w */
        jittered[4 * i] -= 2.0F * jitter[0] / (float)h->width * h->view_to_clip[4 * i + 3];
        jittered[4 * i + 1] -= 2.0F * jitter[1] / (float)h->height * h->view_to_clip[4 * i + 3];
    }
    multiply(c->world_to_clip, jittered, c->world_to_view);
    const bool still = before != NULL && memcmp(c->world_to_view, before->world_to_view, sizeof c->world_to_view) == 0;
    h->rest = still ? h->rest + 1 : 0;
    memcpy(c->previous_world_to_clip, before != NULL ? before->world_to_clip_plain : c->world_to_clip_plain,
           sizeof c->world_to_clip);
    float to_sun[3] = {0.45F, 1.0F, 0.55F};
    normalize3(to_sun);
    const float from[3] = {10.0F * to_sun[0], 10.0F * to_sun[1], 10.0F * to_sun[2]};
    const float center[3] = {0.0F, 0.0F, 0.0F};
    float sun_view[16], sun_clip[16];
    look_at(sun_view, from, center);
    orthographic(sun_clip, 5.5F, 1.0F, 20.0F);
    multiply(c->world_to_sun, sun_clip, sun_view);
    memcpy(c->to_sun, to_sun, sizeof to_sun);
    const float sky[4] = {0.35F, 0.45F, 0.6F, 0.0F};
    memcpy(c->sky, sky, sizeof sky);
}

/* ---- images and buffers ---- */

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
