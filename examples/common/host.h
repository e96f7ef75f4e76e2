/* A small Vulkan renderer that knows nothing of Reflet: it draws a room into a G-buffer and lights it. */
#ifndef EXAMPLE_HOST_H
#define EXAMPLE_HOST_H

#include <stdbool.h>
#include <stdint.h>
#include <vulkan/vulkan.h>

enum { FRAMES_IN_FLIGHT = 3, SUN_MAP_SIDE = 1024 };

typedef struct Picture {
    VkImage image;
    VkImageView view;
    VkDeviceMemory memory;
    VkFormat format;
    uint32_t width, height;
    VkImageUsageFlags usage;
    uint32_t layer, layers; /* that the view shows; of the image */
} Picture;

/* As std140 in room.glsl. */
typedef struct Camera {
    float world_to_view[16], world_to_clip[16], world_to_clip_plain[16], previous_world_to_clip[16], world_to_sun[16],
        to_sun[4], sky[4];
} Camera;

typedef struct Slot { /* one per frame in flight */
    VkCommandBuffer commands;
    VkFence fence;
    VkDescriptorSet set, light_set; /* for drawing and lighting */
} Slot;

typedef struct Host {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    uint32_t family;
    VkPhysicalDeviceFeatures2 features; /* what was enabled, with the chain below */
    VkPhysicalDeviceVulkan12Features features12;
    VkPhysicalDeviceVulkan13Features features13;
    VkCommandPool pool;
    VkDescriptorPool sets;
    VkDescriptorSetLayout set_layout, light_set_layout; /* the camera; the camera and images */
    VkPipelineLayout layout, light_layout;
    VkPipeline room, sun, light;
    VkSampler sampler;
    VkBuffer cameras;
    VkDeviceMemory camera_memory;
    uint8_t* mapped_cameras;
    Slot slots[FRAMES_IN_FLIGHT];
    uint32_t width, height, frame;
    uint32_t rest; /* frames since anything moved: here only the camera can */
    Picture depth, normal, color, motion, lit, sun_map;
    /* How draws leave targets: readable by compute shaders in these layouts, without further barriers. UNDEFINED: as
     * attachments. */
    VkImageLayout readable_color, readable_depth;
    float view_to_clip[16]; /* without jitter */
} Host;

/* Ends the program with a message if a Vulkan call failed. */
void check(VkResult result, const char* what);
void host_open(Host* h, const char* const* instance_extensions, uint32_t instance_extension_count,
               const char* const* device_extensions, uint32_t device_extension_count);
void host_make_targets(Host* h, uint32_t width, uint32_t height);
void host_free_targets(Host* h);
/* Another host of the same device, with pictures, command buffers and cameras of its own: a second eye. Closed before
 * the first. */
void host_open_beside(Host* h, const Host* first);
void host_close_beside(Host* h);
/* Room and sun are drawn in render passes that are compatible with these. */
void host_use_render_passes(Host* h, VkRenderPass room, VkRenderPass sun);
void host_close(Host* h);
Picture make_picture(Host* h, uint32_t width, uint32_t height, VkFormat format, VkImageUsageFlags usage);
/* An image of several layers, as its first one; and another layer of it, of which only the view is its own. */
Picture make_layers(Host* h, uint32_t width, uint32_t height, VkFormat format, VkImageUsageFlags usage,
                    uint32_t layers);
Picture layer_of(Host* h, const Picture* p, uint32_t layer);
void free_picture(Host* h, Picture* p);
VkDeviceMemory bind_buffer(Host* h, VkBuffer buffer, VkMemoryPropertyFlags properties);

/* Waits for the frame that used the slot before, and begins its command buffer. */
Slot* host_begin(Host* h);
/* Fills the camera of this frame; jitter in pixels, right and down. */
void host_camera(Host* h, Camera* c, const Camera* before, const float jitter[2], float angle);
/* Uploads the camera; draws the boxes into the rectangle, for hosts with render passes of their own. */
void host_upload(Host* h, Slot* slot, const Camera* c);
void host_draw_boxes(Host* h, Slot* slot, VkPipeline pipeline, uint32_t width, uint32_t height);
/* Draws shadow map and G-buffer; all are left in attachment layouts. */
void host_draw(Host* h, Slot* slot, const Camera* c);
/* Lights the G-buffer into `lit`, in the layout GENERAL. visibility: of the sun, in the layout GENERAL. */
void host_light(Host* h, Slot* slot, VkImageView visibility);

/* Ends the command buffer and submits it. */
void host_submit(Host* h, Slot* slot);
/* The way of an RGBA8 picture to a file. */
typedef struct Download {
    VkBuffer buffer;
    VkDeviceMemory memory;
    uint32_t width, height;
} Download;
Download make_download(Host* h, uint32_t width, uint32_t height);
/* Records the copy; the image is in the layout GENERAL, and these wrote it last. */
void record_download(const Download* d, VkCommandBuffer commands, VkImage image, VkPipelineStageFlags2 stages,
                     VkAccessFlags2 access);
/* After the device has finished: writes a PPM file, and frees the buffer. */
void write_download(Host* h, Download* d, const char* path);

/* Of a picture's layer. */
void picture_barrier(VkCommandBuffer commands, const Picture* p, VkImageLayout from, VkImageLayout to,
                     VkPipelineStageFlags2 source, VkAccessFlags2 written, VkPipelineStageFlags2 target,
                     VkAccessFlags2 access);
void barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, VkImageLayout from, VkImageLayout to,
             VkPipelineStageFlags2 source, VkAccessFlags2 written, VkPipelineStageFlags2 target, VkAccessFlags2 access);

#endif
