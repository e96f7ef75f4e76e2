/*
 * Reflet: screen-space reflections (SSR), screen-space diffuse global illumination (SSGI), sun shadows from shadow maps
 * (hard, PCF, PCSS), contact shadows, ambient occlusion (AO), denoising, temporal antialiasing (TAA) and tone mapping,
 * recorded into the host's own Vulkan command buffer, from the host's G-buffer.
 *
 * C11 and C++. docs/library.md of the sources is the guide; examples/ there has complete hosts.
 *
 * The library only records commands. It never submits, waits, or touches a queue; nothing is written to standard output
 * or error. A function that returns RefletResult reports failures by it, and refletLastError() says what, where and
 * what to do. No exception leaves the library.
 *
 * Structs that can grow begin with `structSize`, which the host sets to sizeof the struct as it knows it: newer
 * libraries then accept older structs and take the fields that these lack as zero. They are passed by pointer, also
 * from struct to struct. RefletImage, RefletBuffer, RefletPassTime and the structs stored in buffers have a fixed size.
 * Zero is the default of every field, unless its comment says "required". Flags of type uint32_t are 0 or 1.
 *
 * Threads: calls may come from any thread. Calls on one view are serialized; different views, even of one context,
 * record in parallel. A command buffer belongs to the thread that records it, as always in Vulkan; callbacks of a
 * context (memory, log) may then be called by several threads at once.
 *
 * Units: metres, W/(m² sr) for radiance (any other linear unit works as well; images are half floats, so choose one in
 * which lit surfaces are about 1), pixels, seconds. Matrices are column-major, multiply column vectors, and are in this
 * order in memory: element (row r, column c) is m[4 * c + r].
 */
#ifndef REFLET_REFLET_H
#define REFLET_REFLET_H

#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan_core.h>

#if defined(REFLET_STATIC)
#define REFLET_API
#elif defined(_WIN32)
#if defined(REFLET_BUILD)
#define REFLET_API __declspec(dllexport)
#else
#define REFLET_API __declspec(dllimport)
#endif
#else
#define REFLET_API __attribute__((visibility("default")))
#endif

#define REFLET_VERSION_MAJOR 0
#define REFLET_VERSION_MINOR 2
#define REFLET_VERSION_PATCH 0
#define REFLET_MAKE_VERSION(major, minor, patch) \
    (((uint32_t)(major) << 20) | ((uint32_t)(minor) << 10) | (uint32_t)(patch))
/** The version of this header; pass it to refletCreateContext. */
#define REFLET_VERSION REFLET_MAKE_VERSION(REFLET_VERSION_MAJOR, REFLET_VERSION_MINOR, REFLET_VERSION_PATCH)

#ifdef __cplusplus
extern "C" {
#endif

/** One VkDevice: functions, pipelines, samplers, memory. Shared by all views on that device. */
typedef struct RefletContext_T* RefletContext;
/** One camera: the images and histories of its effects, for frames of at most its size. */
typedef struct RefletView_T* RefletView;
/** Values of all settings. Belongs to no context: plain data behind a handle. */
typedef struct RefletSettings_T* RefletSettings;

typedef enum RefletResult {
    REFLET_SUCCESS = 0,
    /** A parameter is NULL, out of range, of an unknown value or does not fit the others. Nothing was recorded. */
    REFLET_ERROR_INVALID_ARGUMENT = -1,
    /** The header's version is newer than the library, or of another major version. */
    REFLET_ERROR_INCOMPATIBLE_VERSION = -2,
    /** The device, or what the host enabled on it, lacks a function, feature or format; the text names it. */
    REFLET_ERROR_MISSING_FEATURE = -3,
    /** Device or host memory is exhausted. */
    REFLET_ERROR_OUT_OF_MEMORY = -4,
    /** A Vulkan call failed. */
    REFLET_ERROR_VULKAN = -5,
    /** A mistake in Reflet; please report the text. */
    REFLET_ERROR_INTERNAL = -6
} RefletResult;

/** REFLET_VERSION of the library that is linked. */
REFLET_API uint32_t refletVersion(void);
/** "REFLET_ERROR_VULKAN"; "unknown" for other values. */
REFLET_API const char* refletResultName(RefletResult result);
/**
 * What went wrong in the last failed call of this thread: one line that names the field and what to do. "" before the
 * first failure. Valid until the thread's next failed call.
 */
REFLET_API const char* refletLastError(void);

/* ---------------------------------------------------------------------------------------------------- context --- */

/** Device memory from the host's allocator; all NULL: the library allocates blocks of 64 MiB itself. */
typedef struct RefletMemoryCallbacks {
    size_t structSize; /**< required */
    void* user;        /**< passed to the callbacks */
    /** Allocates as vkAllocateMemory would; must be thread-safe if views are used by several threads. */
    VkResult (*allocate)(void* user, const VkMemoryAllocateInfo* info, VkDeviceMemory* memory);
    void (*free)(void* user, VkDeviceMemory memory); /**< frees what `allocate` returned */
} RefletMemoryCallbacks;

/** The host's Vulkan device, for refletCreateContext. */
typedef struct RefletContextInfo {
    size_t structSize;               /**< required: sizeof(RefletContextInfo) */
    uint32_t version;                /**< required: REFLET_VERSION */
    VkInstance instance;             /**< required; Vulkan 1.3, or 1.2 with VK_KHR_synchronization2 */
    VkPhysicalDevice physicalDevice; /**< required */
    VkDevice device;                 /**< required; must outlive the context */
    /** Required. All other Vulkan functions are loaded through it, into function tables of the context. */
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    /**
     * Required: the features that the device was created with, which Vulkan cannot query. The chain may hold
     * VkPhysicalDeviceVulkan12Features and VkPhysicalDeviceVulkan13Features, or the structs of single features. Needed:
     * shaderStorageImageExtendedFormats, imageCubeArray, scalarBlockLayout, synchronization2. Used if enabled:
     * samplerAnisotropy, shaderStorageImageWriteWithoutFormat (RefletToneMapInfo::format).
     */
    const VkPhysicalDeviceFeatures2* enabledFeatures;
    /** Enabled instance and device extensions. Used: VK_EXT_debug_utils, for names and labels. */
    const char* const* enabledExtensions;
    uint32_t enabledExtensionCount;      /**< number of enabledExtensions */
    const RefletMemoryCallbacks* memory; /**< copied; NULL: vkAllocateMemory */
    /** Host memory allocator for Vulkan objects; copied. NULL: the driver's own. */
    const VkAllocationCallbacks* allocator;
    /**
     * Pipelines are created with it. It must outlive the context, whose calls access it while they create pipelines.
     * VK_NULL_HANDLE: the context creates one, from `pipelineCacheData`.
     */
    VkPipelineCache pipelineCache;
    const void* pipelineCacheData; /**< data from refletPipelineCacheData in an earlier run; NULL: none */
    size_t pipelineCacheDataSize;  /**< bytes */
    /**
     * Called with the text of every error and, with REFLET_SUCCESS, for each contradiction that refletDescribe reports,
     * once per view and only in its first 16 frames. NULL: no log.
     */
    void (*log)(void* user, RefletResult result, const char* text);
    void* logUser; /**< passed to log */
    /**
     * Families of the queues that execute the library's commands, if there are several (asynchronous compute): its
     * images and buffers are then created with VK_SHARING_MODE_CONCURRENT, which may cost bandwidth. None: a single
     * family, whichever it is.
     */
    const uint32_t* queueFamilies;
    uint32_t queueFamilyCount; /**< number of queueFamilies */
} RefletContextInfo;

/** Creates a context. On failure *context is NULL. Records no commands and creates no pipelines. */
REFLET_API RefletResult refletCreateContext(const RefletContextInfo* info, RefletContext* context);
/**
 * Destroys a context. The device must have finished all recorded work, and all views and radiance caches must have been
 * destroyed; otherwise `log` gets an error, and the context is freed with the last of them. NULL, or a context that was
 * destroyed: does nothing.
 */
REFLET_API void refletDestroyContext(RefletContext context);
/** Returns the bytes of device memory that the context has allocated: whole blocks, for all its views. */
REFLET_API RefletResult refletContextMemory(RefletContext context, uint64_t* bytes);
/**
 * Copies the content of the context's own pipeline cache, for RefletContextInfo::pipelineCacheData of a later run;
 * drivers ignore data of another device or driver. *size in: room in `data`; out: bytes. data NULL: only *size is set.
 * An error if the host gave a cache.
 */
REFLET_API RefletResult refletPipelineCacheData(RefletContext context, size_t* size, void* data);

/* --------------------------------------------------------------------------------------------------- settings --- */

typedef enum RefletSettingType {
    REFLET_SETTING_REAL = 0,
    REFLET_SETTING_INTEGER = 1,
    REFLET_SETTING_SWITCH = 2, /**< true or false */
    REFLET_SETTING_CHOICE = 3  /**< one of a list of names */
} RefletSettingType;

/** A setting, for a host's user interface. The texts belong to the library and are valid for ever. */
typedef struct RefletSettingInfo {
    size_t structSize;          /**< required */
    const char* name;           /**< "trace_screen.max_steps", as in docs/settings.md */
    const char* help;           /**< what it does, and its effect on quality and cost */
    RefletSettingType type;     /**< type of the value */
    double min;                 /**< smallest value of a number */
    double max;                 /**< largest value of a number */
    const char* range;          /**< the range as text: "1 to 4096", "true or false", "linear, halving, …" */
    const char* defaultValue;   /**< default value as text */
    double defaultNumber;       /**< default value as refletGetSettingNumber returns it */
    uint32_t choiceCount;       /**< number of choices; 0 for other types */
    const char* const* choices; /**< names of the choices; refletSetSettingNumber takes the index */
} RefletSettingInfo;

/** Creates settings. preset: NULL or "" for the defaults, else a name as for refletApplyPreset. */
REFLET_API RefletResult refletCreateSettings(const char* preset, RefletSettings* settings);
REFLET_API void refletDestroySettings(RefletSettings settings);
/**
 * Sets the values in which a preset of the program differs from the defaults: "fast", "balanced" or "quality". Settings
 * of effects that only the program has (captured probes, drawn planar reflections) are left out.
 */
REFLET_API RefletResult refletApplyPreset(RefletSettings settings, const char* preset);
/**
 * Sets a setting from text: ("trace_screen.max_steps", "64"). The error suggests the nearest name or tells the range.
 */
REFLET_API RefletResult refletSetSetting(RefletSettings settings, const char* name, const char* value);
/** Returns a setting's value as text, valid until the thread's next call of this function; NULL for an unknown name. */
REFLET_API const char* refletGetSetting(RefletSettings settings, const char* name);
/** Sets a setting from a number: the value of a real or an integer, 0 or 1 of a switch, the index of a choice. */
REFLET_API RefletResult refletSetSettingNumber(RefletSettings settings, const char* name, double value);
/** Returns a setting as a number, in the same form. */
REFLET_API RefletResult refletGetSettingNumber(RefletSettings settings, const char* name, double* value);
/** Number of settings. */
REFLET_API uint32_t refletSettingCount(void);
/** Describes a setting. index: 0 to refletSettingCount() - 1. */
REFLET_API RefletResult refletSettingInfo(uint32_t index, RefletSettingInfo* info);

/* ------------------------------------------------------------------------------------------------------- view --- */

#define REFLET_MAX_FRAMES_IN_FLIGHT 4
#define REFLET_MAX_VIEW_INDEX 64

typedef enum RefletViewFlags {
    /**
     * Device times of each pass are measured, for refletPassTimes. Needs a queue family whose `timestampValidBits` is
     * not 0.
     */
    REFLET_VIEW_PASS_TIMES = 1 << 0
} RefletViewFlags;

/** Parameters of refletCreateView. */
typedef struct RefletViewInfo {
    size_t structSize; /**< required */
    /**
     * Required: size in pixels, 1 to 16384, of its frames; with dynamic resolution, of the largest
     * (RefletFrameInfo::renderSize).
     */
    uint32_t width;
    uint32_t height; /**< required */
    /**
     * Required: 1 to 4. When refletBeginFrame is called, the device must have finished the frame of this view that was
     * begun this many frames before.
     */
    uint32_t framesInFlight;
    uint32_t flags; /**< a combination of RefletViewFlags */
    /**
     * Index among views that are shown together, such as two eyes or the faces of a cube: makes their noise
     * independent. Below REFLET_MAX_VIEW_INDEX.
     */
    uint32_t viewIndex;
} RefletViewInfo;

REFLET_API RefletResult refletCreateView(RefletContext context, const RefletViewInfo* info, RefletView* view);
/**
 * Destroys a view. The device must have finished all of its frames. NULL, or a view that was destroyed: does nothing.
 */
REFLET_API void refletDestroyView(RefletView view);
/**
 * Changes the size of frames, from the next frame on. That frame recreates the images that it needs, and histories
 * restart. For dynamic resolution use RefletFrameInfo::renderSize, which keeps both.
 */
REFLET_API RefletResult refletResizeView(RefletView view, uint32_t width, uint32_t height);
/**
 * Temporal upscaling: from the next frame on, refletTemporal writes images of this size from frames of the view's size
 * or of RefletFrameInfo::renderSize. It must be at least the frame's size along each side, or refletTemporal fails. The
 * host draws with mip bias log2(frame height / output height) and the jitter of refletJitter, in pixels of the frame;
 * effects after refletTemporal run at the output's size. More than a factor of 2 along each side is not useful. 0, 0:
 * the view's size.
 */
REFLET_API RefletResult refletSetOutputSize(RefletView view, uint32_t width, uint32_t height);
/**
 * Discards all histories, from the next frame on: after a camera cut, or when something other than motion changed the
 * picture. Not between refletBeginFrame and refletEndFrame.
 */
REFLET_API RefletResult refletResetView(RefletView view);
/**
 * Tells the library that the device has finished all frames begun so far, and frees the resources that only they used.
 * Needed only if the view pauses: otherwise its next frames free them.
 */
REFLET_API RefletResult refletFinishView(RefletView view);
/** Returns the bytes of device memory that the view's images and buffers use. */
REFLET_API RefletResult refletViewMemory(RefletView view, uint64_t* bytes);

/* ----------------------------------------------------------------------------------------------------- images --- */

/**
 * An image of the host that the library samples, or a result of the library. To be sampled, the view must be 2D with
 * one level, of a float, unorm or snorm format; the image needs VK_IMAGE_USAGE_SAMPLED_BIT; depth formats need a view
 * of the depth aspect. Absent: image VK_NULL_HANDLE.
 */
typedef struct RefletImage {
    VkImage image;    /**< VK_NULL_HANDLE: absent */
    VkImageView view; /**< view of the image's level `baseLevel` and layer `baseLayer` */
    VkFormat format;  /**< format of the view */
    uint32_t width;   /**< width of that level in pixels */
    uint32_t height;  /**< height of that level in pixels */
    /**
     * Current layout of that level and layer. If it does not allow sampling, the call transitions the image and
     * restores the layout.
     */
    VkImageLayout layout;
    /**
     * Stages that last wrote it; 0: a barrier has already made it visible to compute (docs/library.md: render passes).
     */
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access; /**< accesses by which these stages wrote it */
    uint32_t baseLayer;    /**< array layer of the view, such as an eye's; barriers cover only this one */
    uint32_t baseLevel;    /**< mip level of the view; barriers cover only this one */
    /**
     * Offset in pixels, from the left and the top, of the rectangle that is read or written. The rectangle has the size
     * of the frame, or of the output where a call asks for that. Not 0, 0: width and height may be larger than it. Must
     * be 0, 0 in images that are read as a whole: shadow maps (lamps: `tiles`), environments, probes, planar views,
     * exposures.
     */
    uint32_t offset[2];
    uint32_t reserved[4]; /**< 0 */
} RefletImage;

typedef enum RefletDepthKind {
    REFLET_DEPTH_REVERSED = 0,              /**< 1 at the near plane, decreasing; infinite or finite far plane */
    REFLET_DEPTH_STANDARD = 1,              /**< 0 at the near plane, increasing */
    REFLET_DEPTH_KIND_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletDepthKind;

typedef enum RefletNormalKind {
    REFLET_NORMAL_OCTAHEDRAL_SNORM = 0,      /**< two channels, -1 to 1 (Cigolle et al., 2014), +Z at the centre */
    REFLET_NORMAL_OCTAHEDRAL_UNORM = 1,      /**< the same, mapped to 0 to 1 */
    REFLET_NORMAL_VECTOR_SNORM = 2,          /**< three channels, -1 to 1, of any length but 0 */
    REFLET_NORMAL_VECTOR_UNORM = 3,          /**< the same, mapped to 0 to 1 */
    REFLET_NORMAL_KIND_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletNormalKind;

typedef enum RefletRoughnessKind {
    REFLET_ROUGHNESS_PERCEPTUAL = 0,            /**< as in glTF: alpha of GGX is its square */
    REFLET_ROUGHNESS_ALPHA = 1,                 /**< alpha of GGX */
    REFLET_ROUGHNESS_SMOOTHNESS = 2,            /**< 1 minus perceptual roughness */
    REFLET_ROUGHNESS_KIND_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletRoughnessKind;

typedef enum RefletColorKind {
    REFLET_COLOR_LINEAR = 0,                /**< linear when sampled: also every _SRGB format */
    REFLET_COLOR_SRGB = 1,                  /**< sRGB-encoded values in a format that does not decode them */
    REFLET_COLOR_KIND_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletColorKind;

typedef enum RefletMotionKind {
    REFLET_MOTION_UV = 0,                    /**< a value of 1 spans the picture's width or height; y down */
    REFLET_MOTION_NDC = 1,                   /**< a value of 2 spans the picture's width or height, as in clip space */
    REFLET_MOTION_PIXELS = 2,                /**< y down */
    REFLET_MOTION_KIND_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletMotionKind;

/**
 * The host's G-buffer. All images have the view's size; with RefletFrameInfo::renderSize or RefletImage::offset they
 * may be larger than the frame, and the rectangle of the frame's size at the offset is read.
 */
typedef struct RefletGBuffer {
    size_t structSize;           /**< required */
    RefletImage depth;           /**< required: D16, D24S8, D32, D32S8, or R32F in red */
    RefletDepthKind depthKind;   /**< of `depth` and `backDepth` */
    RefletImage normal;          /**< required: shading normals */
    RefletNormalKind normalKind; /**< of `normal` and `geometricNormal` */
    /** 0: normals are in world space; 1: in view space. */
    uint32_t normalsInViewSpace;
    /** Triangle normals, encoded as `normal`; absent: from depth, or `normal` on surfaces one pixel wide. */
    RefletImage geometricNormal;
    RefletImage roughness;             /**< absent: 1 */
    uint32_t roughnessChannel;         /**< 0 to 3 */
    RefletRoughnessKind roughnessKind; /**< of `roughness` */
    RefletImage metallic;              /**< absent: 0 */
    uint32_t metallicChannel;          /**< 0 to 3 */
    RefletImage baseColor;             /**< as in glTF, or the albedo if `f0` is given; absent: 0.5 */
    RefletColorKind baseColorKind;     /**< of `baseColor` */
    /** Linear specular reflectance at normal incidence; given: `metallic` is not read. */
    RefletImage f0;
    RefletImage motion; /**< red and green; absent: computed from the matrices, correct for static surfaces only */
    RefletMotionKind motionKind; /**< of `motion` */
    /**
     * Factor on `motion` that gives current minus previous position in the units of `motionKind`: (-1, -1) if `motion`
     * is previous minus current. Both 0 stand for (1, 1).
     */
    float motionScale[2];
    uint32_t motionIncludesJitter; /**< 1: computed from jittered positions */
    /**
     * Depth of the nearest back faces, in the kind of `depth`: the thickness of objects for
     * `trace_screen.thickness_mode=second_layer`. Absent: that choice acts as `constant`.
     */
    RefletImage backDepth;
    /**
     * Mask, 0 to 1, a channel of any image; absent: 0. Above 0.5: rays and ambient occlusion ignore the surface (first
     * person weapons, gizmos, water with its own reflections), and it receives no indirect light or occlusion.
     */
    RefletImage excluded;
    uint32_t excludedChannel; /**< 0 to 3 */
    /**
     * Mask, as above. Above 0.5: reflects no light, but rays can hit it (screens, skies with depth, user interface).
     */
    RefletImage unlit;
    uint32_t unlitChannel; /**< 0 to 3 */
    /**
     * Mask, as above: the share of the history that refletTemporal discards, for content that motion vectors do not
     * describe (particles, animated textures, blended surfaces).
     */
    RefletImage reactive;
    uint32_t reactiveChannel; /**< 0 to 3 */
} RefletGBuffer;

/** A frame of a view: its command buffer, camera and G-buffer. */
typedef struct RefletFrameInfo {
    size_t structSize; /**< required */
    /** Required: recording, outside of a render pass, for a queue with compute. */
    VkCommandBuffer commandBuffer;
    uint32_t frameIndex; /**< counts up; decorrelates the noise of successive frames */
    /** Required: world to view (camera) space; left- or right-handed. No scale. */
    float worldToView[16];
    /**
     * Required: projection without jitter; perspective or orthographic; near plane above 0. Clip-space depth is 0 to 1
     * in the direction that RefletGBuffer::depthKind says; with `clipDepthFromMinusOne` -1 to 1.
     */
    float viewToClip[16];
    /** Matrices of the last frame. Both all zero: those of this frame. */
    float previousWorldToView[16];
    float previousViewToClip[16]; /**< without jitter */
    /**
     * Subpixel jitter in pixels, right and down, -0.5 to 0.5: offset of the sample from the pixel's centre; the host's
     * projection was shifted by -2 * jitter / size in normalized device coordinates (y down).
     */
    float jitter[2];
    float previousJitter[2]; /**< of the last frame */
    /** 0: y is down in clip space, as in Vulkan; 1: up, drawn with a viewport of negative height. */
    uint32_t clipYUp;
    /**
     * 1: both projections are OpenGL's, with clip-space depth from -1 to 1 (VK_EXT_depth_clip_control); the depth image
     * holds 0 to 1 all the same.
     */
    uint32_t clipDepthFromMinusOne;
    float elapsed; /**< seconds since the last frame, 0 to 3600, for automatic exposure */
    /**
     * Number of consecutive frames before this one in which nothing changed: camera, lights, surfaces, materials,
     * settings and all resources behind them. A static view converges: histories grow beyond the lengths that the
     * settings allow in motion. 0: something changed, or the host cannot tell. Jitter continues at rest.
     */
    uint32_t restFrames;
    /**
     * Share of the light that has changed since the last frame, 0 to 1: a lamp was switched, the sun moved. Histories
     * are shortened to those of an exponential mean that drops this share in each frame. Rays read the last frame's
     * light at hits, so let the value decay over some frames, such as by a factor of 0.7 in each.
     */
    float lightChange;
    /**
     * 1: the background of refletTemporal's input (pixels without a surface) is the environment of RefletIndirectLight,
     * unchanged. While the camera turns, refletTemporal then filters the environment over each pixel's area instead of
     * reprojecting its history, which preserves stars. 0: the background may be anything.
     */
    uint32_t backgroundIsEnvironment;
    const RefletGBuffer* gbuffer; /**< required; read in refletBeginFrame */
    /**
     * Dynamic resolution: width and height of this frame in pixels, 1 to the view's. The host has drawn the camera's
     * whole picture into the rectangle of that size at the top left of its images, or at RefletImage::offset; images
     * may be larger. Results have that size, except those from refletTemporal on, which have the output's. May change
     * in every frame: histories are resampled, and device memory stays that of the largest frame. Jitter is in pixels
     * of its own frame. 0, 0: the view's size, which images must have.
     */
    uint32_t renderSize[2];
    /**
     * Pre-exposure: the factor by which the host has multiplied all radiance of this frame, to fit the range of half
     * floats: `light`, `color`, `noisy`, answers to rays, `specularFallback`, `irradiance`, colours of planar views.
     * Results are multiplied by it, too. May change in every frame: histories are rescaled. RefletEnvironment and
     * RefletProbe are given without it, and tone mapping divides by it before exposure. 1e-8 to 1e8; 0: 1.
     */
    float preExposure;
} RefletFrameInfo;

/**
 * Jitter of a frame, for RefletFrameInfo::jitter: a low-discrepancy sequence, of which four frames from a multiple of
 * four have one sample in each quarter of a pixel (Owen-scrambled Sobol').
 */
REFLET_API void refletJitter(uint32_t frameIndex, float jitter[2]);

/**
 * Later calls on the view, including refletEndFrame, record into this command buffer: to run shadows on another queue,
 * for example, or to give a thread its own buffer. It must be recording, outside of a render pass, for a queue with
 * compute; if its queue family is not that of the frame's buffer, both must be in RefletContextInfo::queueFamilies.
 * Call it between refletBeginFrame, whose RefletFrameInfo::commandBuffer is the first, and refletEndFrame.
 *
 * The device must execute a view's calls in their order: buffers of one queue are submitted in that order, and between
 * two queues the host puts a semaphore. Each buffer contains the barriers for the library's earlier commands. Images of
 * the host need a layout and stages that the buffer's queue supports.
 */
REFLET_API RefletResult refletUseCommandBuffer(RefletView view, VkCommandBuffer commandBuffer);

/**
 * Starts a frame, and records the import of the G-buffer into the view's own images; the host's images are free to be
 * overwritten by later commands. Between this call and refletEndFrame the host may record other commands.
 *
 * After a failure that is not REFLET_ERROR_INVALID_ARGUMENT or REFLET_ERROR_INCOMPATIBLE_VERSION (memory, for example)
 * the frame counts as begun and ended for framesInFlight.
 *
 * The library's commands overwrite compute state: bind pipelines, descriptor sets and push constants of the compute
 * bind point again after them. Graphics state is not touched.
 */
REFLET_API RefletResult refletBeginFrame(RefletView view, const RefletFrameInfo* info);
REFLET_API RefletResult refletEndFrame(RefletView view);

/* ---------------------------------------------------------------------------------------------------- effects --- */
/*
 * Each effect is recorded when it is called, between refletBeginFrame and refletEndFrame. A result is a RefletImage in
 * VK_IMAGE_LAYOUT_GENERAL, with the stage and access that wrote it; it belongs to the view and holds its content until
 * the view's next refletBeginFrame. To read it, the host records a barrier from these to its own use. The next frame
 * waits for what the queue did before, so no barrier back is needed.
 */

/** The sun, and the shadow maps that the host has drawn from it. */
typedef struct RefletSunShadow {
    size_t structSize; /**< required */
    /**
     * Required: depth of an orthographic map from the sun, or a 2D array with a layer per cascade. Width and height are
     * of one layer.
     */
    RefletImage map;
    RefletDepthKind depthKind; /**< of `map` */
    uint32_t clipYUp;          /**< as in RefletFrameInfo, for the maps */
    /** Required: 1: `map` is a 2D image; 2 to 4: a 2D array view of as many layers, from near to far. */
    uint32_t cascades;
    float worldToClip[4][16]; /**< required, of each cascade: world to clip space, orthographic, depth 0 to 1 as
                                 `depthKind` says */
    /** Far end of each cascade: metres in front of the camera. With one map: not read. */
    float cascadeSplits[4];
    float toSun[3]; /**< required: world space; need not have length 1 */
    /** Of the sun's disk, in radians; 0: 0.0093 (0.53 degrees). Sets the width of PCSS penumbras. */
    float angularDiameter;
    /** 1: also contact shadows by screen-space rays of `contact.distance`, which close the gap that the bias leaves. */
    uint32_t contactShadows;
} RefletSunShadow;

/**
 * Visibility of the sun, R8, 1: lit. `shadow.filter` selects hard, pcf or pcss. `shadow.denoise` denoises soft filters;
 * `shadow.history` is the length of the denoiser's temporal history.
 */
REFLET_API RefletResult refletSunShadow(RefletView view, RefletSettings settings, const RefletSunShadow* sun,
                                        RefletImage* visibility);

/** Layout of a lamp's shadow map. */
typedef enum RefletLampMapKind {
    REFLET_LAMP_MAP_TILE = 0,                  /**< a square of a 2D image, or all of it: spot lights */
    REFLET_LAMP_MAP_SIX_TILES = 1,             /**< six squares of a 2D image, for all directions */
    REFLET_LAMP_MAP_CUBE = 2,                  /**< a view of type VK_IMAGE_VIEW_TYPE_CUBE, in world space */
    REFLET_LAMP_MAP_KIND_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletLampMapKind;

/** Content of a lamp's shadow map. */
typedef enum RefletLampDepth {
    REFLET_LAMP_DEPTH_REVERSED = 0, /**< depth, 1 at the near plane; 0: nothing is there */
    REFLET_LAMP_DEPTH_STANDARD = 1, /**< depth, 0 at the near plane; 1: nothing is there */
    REFLET_LAMP_DEPTH_DISTANCE = 2, /**< distance from the lamp, in red, any float or unorm format; 0: nothing */
    REFLET_LAMP_DEPTH_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletLampDepth;

#define REFLET_MAX_LAMP_SHADOWS 16

/** A point or spot light with the shadow map that the host has drawn. */
typedef struct RefletLampShadow {
    size_t structSize;      /**< required; in an array, that of the first is the stride */
    float position[3];      /**< required: world space */
    float radius;           /**< metres, of the emitting disk: sets the width of PCSS penumbras. 0: sharp shadows */
    float range;            /**< metres beyond which it lights nothing, and its visibility is 0. 0: infinite */
    float direction[3];     /**< of a spot: axis of the light cone, world space, any length. All 0: a point light */
    float coneAngle;        /**< of a spot: half angle in radians, beyond which it is dark; above 0, below pi / 2 */
    RefletLampMapKind kind; /**< of `map` */
    RefletImage map;        /**< required: depth as in RefletSunShadow::map, or colour with distances */
    RefletLampDepth depth;  /**< what `map` holds */
    float distanceScale;    /**< metres per unit of REFLET_LAMP_DEPTH_DISTANCE; 0: 1 */
    /**
     * Required for tiles: world to clip space, a perspective projection from the lamp. One tile: the same field of view
     * along both axes, centred. Six tiles: in any order, together covering all directions.
     */
    float worldToClip[6][16];
    uint32_t clipYUp;               /**< as in RefletFrameInfo, for the tiles */
    uint32_t clipDepthFromMinusOne; /**< as in RefletFrameInfo, for the tiles */
    uint32_t tiles[6][3];           /**< first texel, x and y, and side of each tile; all 0: a whole square map */
    float nearPlane; /**< of a cube of depth, required: metres; faces have a field of view of 90 degrees */
    float farPlane;  /**< of a cube of depth: metres; 0: infinite */
} RefletLampShadow;

/**
 * Visibility of lamps, RGBA8 of the frame's size, a 2D array view with a layer per four lamps, (count + 3) / 4: lamp i
 * is channel i % 4 of layer i / 4; 1: lit; 0 also on what faces away from the lamp, and beyond its range or cone.
 * `shadow.filter` selects hard, pcf or pcss, with `shadow.samples`; refletTemporal averages the noise. Maps may differ
 * in size. Call it once per frame: another call replaces this result. lamps: an array of `count`, at most
 * REFLET_MAX_LAMP_SHADOWS. For casters thinner than a texel use refletContactShadows.
 */
REFLET_API RefletResult refletLampShadows(RefletView view, RefletSettings settings, const RefletLampShadow* lamps,
                                          uint32_t count, RefletImage* visibility);

/** A light that casts contact shadows. */
typedef struct RefletContactLight {
    size_t structSize; /**< required */
    /** Required: world space: direction toward the light, any length but 0; with isPositional its position [m]. */
    float light[3];
    uint32_t isPositional; /**< 0: far away, such as the sun; 1: a point or spot light */
} RefletContactLight;

/** Most calls of refletContactShadows in a frame. */
#define REFLET_MAX_CONTACT_LIGHTS 16

/**
 * Contact shadows of one light, with any shadow map or none: R8, 1: lit. Marches rays of `contact.distance` metres, at
 * most to the light, through the depth buffer. Multiply the light's visibility by the result. For the sun of
 * refletSunShadow use RefletSunShadow::contactShadows instead.
 */
REFLET_API RefletResult refletContactShadows(RefletView view, RefletSettings settings, const RefletContactLight* light,
                                             RefletImage* visibility);

/** The environment: an infinitely distant map of radiance (image-based lighting). */
typedef struct RefletEnvironment {
    size_t structSize; /**< required */
    /**
     * Radiance, equirectangular: its upper edge is `worldUp`. With +Y up the centre is -Z, and u increases toward +X,
     * as seen in a right-handed world. In a left-handed (or mirrored) world flip the image horizontally. Absent:
     * `factor` is the radiance from all directions.
     */
    RefletImage image;
    float factor[3]; /**< times the image, 0 to 65504 / preExposure; all 0 and no image: black. With an image, all 0
                        stands for 1 */
    float rotation;  /**< around `worldUp`, in radians */
    /**
     * Up axis in world space; all 0 stands for +Y. For another axis the image is rotated by the shortest rotation from
     * +Y to it: with +Z up the centre is +Y. For -Y it is rotated around X: the centre is +Z.
     */
    float worldUp[3];
    /** Change it whenever the image's content changes: the maps made from it are then rebuilt in that frame. */
    uint64_t revision;
} RefletEnvironment;

/** Unit of irradiance that a host gives. */
typedef enum RefletIrradianceKind {
    REFLET_IRRADIANCE = 0,                       /**< E: the integral of radiance times cosine, W/m² */
    REFLET_IRRADIANCE_OVER_PI = 1,               /**< E / pi: the cosine-weighted mean of radiance, W/(m² sr) */
    REFLET_IRRADIANCE_KIND_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletIrradianceKind;

/** Parallax correction: where a ray meets the surroundings that a probe shows. */
typedef enum RefletParallax {
    REFLET_PARALLAX_BOX = 0,  /**< on the parallax box (Lagarde and Zanuttini, SIGGRAPH 2012) */
    REFLET_PARALLAX_NONE = 1, /**< infinitely far away */
    /**
     * Where the ray passes behind the surfaces in RefletProbe::distance (Szirmay-Kalos et al., 2005), else on the box.
     */
    REFLET_PARALLAX_DEPTH = 2,
    REFLET_PARALLAX_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletParallax;

#define REFLET_MAX_PROBES 16

/**
 * A light probe of the host, for rays that find nothing on the screen. Its cube maps are views of type
 * VK_IMAGE_VIEW_TYPE_CUBE, faces in Vulkan's order and orientation, in world space; RefletImage's size is that of a
 * face, and the faces are the six layers from `baseLayer`. The library resamples them once for each `revision`, to
 * faces of 16 to 256 texels, the largest of all probes: later frames do not read them, but they must still exist.
 */
typedef struct RefletProbe {
    size_t structSize;       /**< required; in an array, that of the first is the stride */
    float position[3];       /**< required: world space: the point whose surroundings the maps show */
    float boxCenter[3];      /**< required: world space: surfaces in this box, along the world's axes, are lit by it */
    float boxHalfExtents[3]; /**< required: metres, above 0 */
    float blend;             /**< metres outside of the box over which it fades out. Nearer probes count more */
    RefletParallax parallax; /**< how far the surroundings are */
    float parallaxCenter[3]; /**< centre of the box that approximates the surroundings */
    float parallaxHalfExtents[3]; /**< metres; all 0: the parallax box is the box */
    RefletImage radiance;         /**< required: cube map of radiance, without pre-exposure */
    /**
     * 0, 1: `radiance` has one level and is not filtered: the library prefilters it. More: its view has as many levels
     * from `baseLevel`, level l filtered by the GGX lobe of perceptual roughness l / (levels - 1).
     */
    uint32_t radianceLevels;
    /** 1: `radiance` is premultiplied by its alpha: 1 surface, 0 sky (rays get the environment). 0: all surface. */
    uint32_t alphaIsCoverage;
    RefletImage distance;   /**< cube map, red: metres from `position`; 0, infinity: sky; for REFLET_PARALLAX_DEPTH */
    RefletImage irradiance; /**< cube map indexed by normal, without pre-exposure; absent: `sphericalHarmonics`,
                               or from `radiance` */
    RefletIrradianceKind irradianceKind; /**< of `irradiance` and `sphericalHarmonics` */
    /**
     * Irradiance as 9 colours, 27 floats: factors of the real basis 0.282095, 0.488603 (y, z, x), 1.092548 (xy, yz),
     * 0.315392 (3z² - 1), 1.092548 xz, 0.546274 (x² - y²) of the world-space normal. NULL: none.
     */
    const float* sphericalHarmonics;
    uint64_t revision; /**< counts changes of the content of its images */
    /**
     * Factor on all its radiance and irradiance, above 0; 0 stands for 1. The library stores half floats: divide very
     * bright images by a number, and give that number here.
     */
    float factor;
} RefletProbe;

#define REFLET_MAX_PLANAR_VIEWS 4

/** A planar reflection that the host has drawn: rays that start on the mirror are marched through its depth. */
typedef struct RefletPlanarView {
    size_t structSize;         /**< required; in an array, that of the first is the stride */
    RefletImage color;         /**< required: radiance seen by the mirrored camera, with the sky; of any size */
    RefletImage depth;         /**< required: of the same size, as RefletGBuffer::depth */
    RefletDepthKind depthKind; /**< of `depth` */
    /** Required: of the mirrored camera, the frame's matrix times the reflection in the plane. No jitter. */
    float worldToView[16];
    float viewToClip[16];           /**< required: the frame's projection, or one of a part of its picture */
    uint32_t clipYUp;               /**< as in RefletFrameInfo */
    uint32_t clipDepthFromMinusOne; /**< as in RefletFrameInfo */
    /** Required: dot(plane, (p, 1)) is how far p is in front of the mirror in metres; the first three: unit normal. */
    float plane[4];
    float tolerance; /**< surfaces up to so many metres off the plane belong to the mirror; 0: 0.001 */
} RefletPlanarView;

/**
 * World-space radiance cache: diffuse light in cells whose side is `radiance_cache.cell_size` times the distance from
 * the camera. refletDiffuseGi, or refletAnswerRays of REFLET_LOBE_DIFFUSE, fills it with the light of the surfaces that
 * its view sees, including the host's answers. Pixels without a history (disoccluded, after a cut, at the picture's
 * edge while the camera turns) start from it instead of from noise. Its history is `radiance_cache.history` frames
 * long, shorter with RefletFrameInfo::lightChange; cells that no view has fed for 120 frames are freed. 11 MB of device
 * memory.
 *
 * Several views of a context may share one: each then reads the light that the others found. The device must then
 * execute their calls that use it in the order in which they were recorded; calls with the same `frameIndex` count as
 * one frame.
 */
typedef struct RefletRadianceCache_T* RefletRadianceCache;

/** Creates an empty cache. */
REFLET_API RefletResult refletCreateRadianceCache(RefletContext context, RefletRadianceCache* cache);
/** The device must have finished all frames that used it. NULL, or one that was destroyed: does nothing. */
REFLET_API void refletDestroyRadianceCache(RefletRadianceCache cache);
/** Empties the cache, from the next frame on: after a change of the world that no motion describes (another level). */
REFLET_API RefletResult refletResetRadianceCache(RefletRadianceCache cache);

/** Light that rays find: the radiance on screen, and the sources to fall back to where the screen has no data. */
typedef struct RefletIndirectLight {
    size_t structSize; /**< required */
    /**
     * Required: linear radiance without indirect light: direct light, emission, sky. Of the frame's size. With
     * `trace_screen.light=previous`, rays read the result of refletComposite of the last frame, which adds further
     * bounces; if it did not run, this image.
     */
    RefletImage light;
    const RefletEnvironment* environment; /**< for rays that hit nothing; NULL: black */
    /*
     * The host's own sources of light, in this order, each for the remaining weight of a ray: planar views (reflections
     * only; before or after the screen), answers to refletMissedRays, the image of the lobe (the two below), the
     * probes, the environment. Rays that are known to hit nothing (answers with a negative distance) get the
     * environment alone.
     */
    /** For reflections: RGB: radiance that arrives along the pixel's lobe; alpha: confidence, 0 to 1. Frame's size. */
    RefletImage specularFallback;
    /** For diffuse light: RGB: irradiance at the pixel's surface; alpha: confidence, 0 to 1. Of the frame's size. */
    RefletImage irradiance;
    RefletIrradianceKind irradianceKind; /**< of `irradiance` */
    uint32_t probeCount;                 /**< at most REFLET_MAX_PROBES */
    const RefletProbe* probes;           /**< the same in both lobes' calls of a frame */
    uint32_t planarViewCount;            /**< at most REFLET_MAX_PLANAR_VIEWS */
    uint32_t planarViewsAfterScreen;     /**< 0: reflections use planar views before the screen; 1: for its misses */
    const RefletPlanarView* planarViews; /**< only reflections use them */
    RefletRadianceCache radianceCache;   /**< of the view's context; only diffuse light uses it. NULL: none */
} RefletIndirectLight;

/** One lobe of indirect light. */
typedef struct RefletLobe {
    size_t structSize; /**< required */
    /**
     * RGBA16F: incoming radiance, weighted by the lobe (diffuse: irradiance / pi), without the surface's reflectance;
     * alpha: mean hit distance in metres. At traced resolution: (size + downsample - 1) / downsample.
     */
    RefletImage radiance;
    /** RGBA16F: alpha: confidence, the share of rays that a source answered with certainty, 0 to 1. */
    RefletImage confidence;
    uint32_t downsample; /**< `diffuse.downsample` or `specular.downsample` */
} RefletLobe;

/**
 * Ambient occlusion (AO) by `ao.method`: horizon (GTAO; Jimenez et al., 2016) or bitmask (visibility bitmask; Therrien,
 * Levesque and Gilet, 2023), within `ao.radius`. RGBA16F of the frame's size; alpha: ambient visibility, the
 * cosine-weighted share of unoccluded directions, 0 to 1; RGB: the bent normal, their mean direction, world space, unit
 * length. (0, 0, 0, 1) in the background. Denoised if the settings say so.
 *
 * The host multiplies its own ambient light by alpha, never direct light. If this ran before refletDiffuseGi or
 * refletReflections in this frame, these multiply light of the prefiltered environment by it
 * (`diffuse.distribution=normal`, `specular.rough_fallback=mips`), but not light of traced rays, which find nearby
 * occluders themselves.
 */
REFLET_API RefletResult refletAmbientOcclusion(RefletView view, RefletSettings settings, RefletImage* occlusion);

/**
 * Screen-space diffuse global illumination (SSGI), denoised if the settings say so. `diffuse.method`: rays or slices,
 * `diffuse.rays` of them per traced pixel.
 */
REFLET_API RefletResult refletDiffuseGi(RefletView view, RefletSettings settings, const RefletIndirectLight* light,
                                        RefletLobe* lobe);
/**
 * Screen-space reflections (SSR), mirror and glossy: rays of the GGX lobe (visible normals: Heitz, 2018). If
 * refletDiffuseGi ran in this frame, its light is added to what rays read (`trace_screen.light=lit`).
 */
REFLET_API RefletResult refletReflections(RefletView view, RefletSettings settings, const RefletIndirectLight* light,
                                          RefletLobe* lobe);

typedef enum RefletLobeKind {
    REFLET_LOBE_DIFFUSE = 0,
    REFLET_LOBE_SPECULAR = 1,
    REFLET_LOBE_KIND_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletLobeKind;

/**
 * Denoises a lobe that the host traced itself, by ray tracing for instance: of the frame's size, RGB radiance without
 * the surface's reflectance, as in RefletLobe, alpha: hit distance in metres. Stands in for refletDiffuseGi or
 * refletReflections in this frame: refletComposite takes its result.
 */
REFLET_API RefletResult refletDenoise(RefletView view, RefletSettings settings, RefletLobeKind kind,
                                      const RefletImage* noisy, RefletLobe* lobe);

/** Results of refletComposite, at full resolution. */
typedef struct RefletComposite {
    size_t structSize; /**< required */
    RefletImage lit;   /**< RGBA16F: light + both below; alpha: distance in front of the camera in metres, 0: sky */
    RefletImage indirectDiffuse;  /**< RGBA16F: what refletDiffuseGi adds to each pixel, upsampled and reflected */
    RefletImage indirectSpecular; /**< RGBA16F: the same for refletReflections */
} RefletComposite;

/**
 * Multiplies the lobes of this frame by the surface's reflectance, upsampled, and adds them to `light`; NULL: the light
 * that refletDiffuseGi or refletReflections was given last. A lobe that was not traced in this frame adds nothing.
 */
REFLET_API RefletResult refletComposite(RefletView view, RefletSettings settings, const RefletImage* light,
                                        RefletComposite* composite);

/**
 * Temporal antialiasing, RGBA16F of the output's size (refletSetOutputSize): radiance. color: of the frame's size,
 * drawn with the frame's jitter; NULL: the result of refletComposite. Call it, as all effects with a history (the sun's
 * shadow, ambient occlusion, each lobe, depth of field), at most once in a frame of a view.
 */
REFLET_API RefletResult refletTemporal(RefletView view, RefletSettings settings, const RefletImage* color,
                                       RefletImage* antialiased);

/** A thin lens, of the camera of this frame. */
typedef struct RefletLens {
    size_t structSize;    /**< required */
    float apertureRadius; /**< metres, at least 0; f-number N: focal length / (2 N). 0: everything is sharp */
    float focusDistance;  /**< required: metres along the view axis, above 0 */
    uint32_t blades;      /**< corners of the aperture, 3 to 16, on the circle of apertureRadius; 0: round */
    float bladeRotation;  /**< radians, counter-clockwise as seen in far bokeh disks; 0: a corner at the right */
} RefletLens;

/**
 * Depth of field, RGBA16F of the output's size: near and far blur at half resolution by the settings `dof` (Jimenez,
 * 2014; Abadie, 2018), before the tone map. What is in focus does not change. color: linear radiance, of the output's
 * size; NULL: the last of refletTemporal and refletComposite that ran. Without an aperture, or with
 * `dof.enabled=false`: that picture.
 */
REFLET_API RefletResult refletDepthOfField(RefletView view, RefletSettings settings, const RefletLens* lens,
                                           const RefletImage* color, RefletImage* blurred);

/**
 * Motion blur, RGBA16F of the output's size, by the settings `motion_blur` (off by default: `motion_blur.enabled`;
 * McGuire et al., 2012; Guertin, McGuire and Nowrouzezahrai, 2014; Jimenez, 2014): the shutter is open for
 * `motion_blur.shutter` of the time since the last frame, half before this frame and half after it, and motion is
 * constant: that of RefletGBuffer::motion, of the camera alone where it is absent and in the background. After a cut,
 * give this frame's matrices as the last ones. color: linear radiance, of the output's size; NULL: the last of
 * refletDepthOfField, refletTemporal and refletComposite that ran. With `motion_blur.enabled=false` or a shutter of 0:
 * that picture.
 */
REFLET_API RefletResult refletMotionBlur(RefletView view, RefletSettings settings, const RefletImage* color,
                                         RefletImage* blurred);

/**
 * Tone map, RGBA8, display-encoded: `tonemap.curve`, `tonemap.exposure`. autoExposure 1: surfaces become middle grey on
 * average (histogram; Reinhard et al., 2002). color: linear radiance, of the output's size; NULL: the last of
 * refletMotionBlur, refletDepthOfField, refletTemporal and refletComposite that ran.
 */
REFLET_API RefletResult refletToneMap(RefletView view, RefletSettings settings, const RefletImage* color,
                                      uint32_t autoExposure, RefletImage* display);

/** Colour encoding of a display. */
typedef enum RefletTransfer {
    /** The sRGB curve (of `tonemap.curve=gamma22`: a power of 2.2), Rec. 709 primaries; 1 is the display's white. */
    REFLET_TRANSFER_SRGB = 0,
    /** Linear, 1: 80 nits, Rec. 709 primaries (IEC 61966-2-2): VK_COLOR_SPACE_EXTENDED_SRGB_LINEAR_EXT. */
    REFLET_TRANSFER_SCRGB = 1,
    /** SMPTE ST 2084 (PQ), 1: 10000 nits, Rec. 2020 primaries: VK_COLOR_SPACE_HDR10_ST2084_EXT. */
    REFLET_TRANSFER_PQ = 2,
    REFLET_TRANSFER_MAX_ENUM = 0x7FFFFFFF /**< no value: lets any int be refused */
} RefletTransfer;

/** Parameters of refletToneMapTo: exposure, target image, encoding. */
typedef struct RefletToneMapInfo {
    size_t structSize;        /**< required */
    const RefletImage* color; /**< as in refletToneMap */
    uint32_t autoExposure;    /**< as in refletToneMap; not together with `exposure` */
    /**
     * 1x1, a float format: its first channel is a factor on radiance without pre-exposure, on top of
     * 2^`tonemap.exposure`. Values that are not positive and finite count as 1. NULL: none.
     */
    const RefletImage* exposure;
    /**
     * The host's image to write: at least of the size of the picture (the output's; the frame's if neither
     * refletTemporal, refletDepthOfField nor refletMotionBlur ran and no color is given), with
     * VK_IMAGE_USAGE_STORAGE_BIT, in one of the formats listed at `format`. `layout` may be VK_IMAGE_LAYOUT_UNDEFINED:
     * its content is discarded, and it is left in VK_IMAGE_LAYOUT_GENERAL; any other layout is restored. `stages`:
     * those that used it last. NULL: an image of the library.
     */
    const RefletImage* output;
    /**
     * Format of the library's own image: VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_A2B10G10R10_UNORM_PACK32,
     * VK_FORMAT_R16G16B16A16_SFLOAT; with shaderStorageImageWriteWithoutFormat also VK_FORMAT_B8G8R8A8_UNORM and
     * VK_FORMAT_A2R10G10B10_UNORM_PACK32. Shaders cannot write _SRGB formats: give `output` with a view of the UNORM
     * format (VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT). VK_FORMAT_UNDEFINED: the first for a `transfer` of sRGB, the second
     * for PQ, the third for scRGB, which requires it. Not read with `output`.
     */
    VkFormat format;
    RefletTransfer transfer; /**< encoding of the picture */
    /**
     * For scRGB and PQ: luminance of sRGB's white, 1 to 10000 nits; 0: 203 (ITU-R BT.2408). `tonemap.curve=neutral`
     * rolls brighter values off toward peakLuminance, srgb and gamma22 clip there; aces and agx end at white.
     */
    float paperWhite;
    float peakLuminance; /**< the display's: paperWhite to 10000 nits; 0: 1000, or paperWhite if that is more */
} RefletToneMapInfo;

/** Results of refletToneMapTo. */
typedef struct RefletDisplay {
    size_t structSize; /**< required */
    RefletImage image; /**< to display; with RefletToneMapInfo::output that image, as left; alpha 1 */
    /**
     * 1x1, R32_SFLOAT: the factor on radiance without pre-exposure that autoExposure found, for the host to pre-expose
     * the next frame by. Absent without autoExposure.
     */
    RefletImage exposure;
} RefletDisplay;

/** As refletToneMap, with a choice of display encoding, target image and exposure. */
REFLET_API RefletResult refletToneMapTo(RefletView view, RefletSettings settings, const RefletToneMapInfo* info,
                                        RefletDisplay* display);

/* ------------------------------------------------------------------------------------------------ missed rays --- */
/*
 * Between the screen and the other sources (RefletIndirectLight) a host can resolve rays by its own means, such as ray
 * tracing or distance fields. refletMissedRays replaces refletDiffuseGi or refletReflections and stops after the
 * screen-space march; the host records commands that read `rays` and write `answers`; refletAnswerRays completes the
 * effect.
 */

/** A buffer of the library that the host reads or writes. */
typedef struct RefletBuffer {
    VkBuffer buffer;              /**< with the usages storage, indirect, transfer source and transfer destination */
    VkDeviceSize offset;          /**< of the content, in bytes */
    VkDeviceSize size;            /**< of the content, in bytes */
    VkPipelineStageFlags2 stages; /**< stages that last wrote it */
    VkAccessFlags2 access;        /**< accesses by which they wrote it */
    uint64_t reserved[3];         /**< 0 */
} RefletBuffer;

/** At the start of RefletMissedRays::rays; the rays follow it. The same in GLSL's scalar and std430 layouts. */
typedef struct RefletMissedRayHeader {
    /** For vkCmdDispatchIndirect: groups of 64 threads, at most 65535 of them; y and z are 1. */
    uint32_t groups[3];
    uint32_t count; /**< of rays; above 64 * 65535, each thread loops with a stride of 64 * groups[0] */
} RefletMissedRayHeader;

/**
 * A ray that the screen did not resolve, or not with full confidence. 48 bytes, the same in GLSL's scalar and std430
 * layouts:
 * struct MissedRay { vec3 origin; float clear; vec3 direction; float rest; uint pixel, number; float spread, roughness;
 * };
 */
typedef struct RefletMissedRay {
    /**
     * World space, metres: the surface, offset along its geometric normal by the rounding error of 32-bit float depth.
     * Coarser depth needs an additional bias by the host.
     */
    float origin[3];
    /**
     * Metres from the origin that the screen shows to be unoccluded, at its resolution. Start at 0 to find objects
     * thinner than a pixel.
     */
    float clear;
    float direction[3]; /**< world space, unit length */
    float rest;         /**< remaining weight, above 0 to 1: 1 minus the screen's confidence */
    uint32_t pixel;     /**< it starts from, at full resolution: x + 65536 * y */
    uint32_t number;    /**< RefletLobeKind + 65536 * the number of the ray in its pixel */
    /**
     * 0: a single direction. Else a cone of directions, for prefiltered sources: specular
     * (`specular.rough_fallback=mips`): the lobe of this perceptual roughness; diffuse (`diffuse.distribution=normal`),
     * 1: the hemisphere around it.
     */
    float spread;
    float roughness; /**< perceptual, of the surface that it starts from, 0 to 1 */
} RefletMissedRay;

/**
 * The answer to a ray, at the ray's index in RefletMissedRays::answers. All 0, as the library initializes it: no
 * answer. 32 bytes, the same in GLSL's scalar and std430 layouts:
 * struct RayAnswer { vec3 radiance; float confidence, distance; uint reserved[3]; };
 */
typedef struct RefletRayAnswer {
    /** Arriving along the ray, in the unit of RefletIndirectLight::light. If it is not finite, there is no answer. */
    float radiance[3];
    /**
     * 0 to 1: the share of `rest` that it resolves. The image of the lobe, probes and the environment resolve the
     * remainder.
     */
    float confidence;
    /**
     * Hit distance in metres, 0 or more; 10000 for light from infinitely far away. Negative: the ray hits nothing and
     * gets the environment alone for all of `rest`, not scaled by `environment.occluded_weight`, which applies to rays
     * that pass behind a surface; radiance and confidence are not read.
     */
    float distance;
    uint32_t reserved[3]; /**< 0 */
} RefletRayAnswer;

/** Result of refletMissedRays; the host may use its buffers until refletAnswerRays. */
typedef struct RefletMissedRays {
    size_t structSize;    /**< required */
    RefletBuffer rays;    /**< RefletMissedRayHeader, then a RefletMissedRay per ray; the host reads it */
    RefletBuffer answers; /**< a RefletRayAnswer per ray, in the same order, zeroed; the host writes it */
    uint32_t capacity;    /**< of both, in rays: traced pixels times rays per pixel */
} RefletMissedRays;

/**
 * Records ray generation and the screen-space march of a lobe, and lists the rays that remain. Hits on smooth metals
 * (roughness below 0.5) count as misses, as their radiance on screen depends on the camera's direction. One lobe at a
 * time: until refletAnswerRays, calls of lobes, refletComposite and refletEndFrame fail, as they would lose the rays.
 * Other effects and commands of the host are allowed. At most 16 rays per pixel. The host records barriers for `rays`
 * and `answers` from their stages and access to its own use.
 */
REFLET_API RefletResult refletMissedRays(RefletView view, RefletSettings settings, RefletLobeKind kind,
                                         const RefletIndirectLight* light, RefletMissedRays* missed);

/** How the host has accessed the buffers of RefletMissedRays, for barriers. */
typedef struct RefletRayAnswers {
    size_t structSize; /**< required */
    /**
     * Stages that wrote the answers last, and read the rays; 0: a barrier has already made the answers visible to
     * compute, or there are none.
     */
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access; /**< accesses by which they wrote the answers */
} RefletRayAnswers;

/**
 * Completes the lobe of refletMissedRays: the host's answers, the other sources for the remainder, and denoising, with
 * the settings that refletMissedRays was given, regardless of later changes. kind: the same as there. The result is
 * that of refletDiffuseGi or refletReflections, and refletComposite takes it. Confidence includes rays that the host
 * answered.
 */
REFLET_API RefletResult refletAnswerRays(RefletView view, RefletSettings settings, RefletLobeKind kind,
                                         const RefletRayAnswers* answers, RefletLobe* lobe);

/* -------------------------------------------------------------------------------------------------- pipelines --- */

typedef enum RefletEffect {
    REFLET_EFFECT_SUN_SHADOW = 1 << 0,
    REFLET_EFFECT_CONTACT_SHADOWS = 1 << 1, /**< refletContactShadows, and RefletSunShadow::contactShadows */
    REFLET_EFFECT_DIFFUSE_GI = 1 << 2,
    REFLET_EFFECT_REFLECTIONS = 1 << 3,
    REFLET_EFFECT_DENOISE = 1 << 4,
    REFLET_EFFECT_COMPOSITE = 1 << 5,
    REFLET_EFFECT_TEMPORAL = 1 << 6,
    REFLET_EFFECT_TONE_MAP = 1 << 7,
    REFLET_EFFECT_AMBIENT_OCCLUSION = 1 << 8,
    REFLET_EFFECT_DEPTH_OF_FIELD = 1 << 9,
    REFLET_EFFECT_MISSED_DIFFUSE_RAYS = 1 << 10,    /**< refletMissedRays and refletAnswerRays of the diffuse lobe */
    REFLET_EFFECT_MISSED_REFLECTION_RAYS = 1 << 11, /**< and of the specular lobe */
    REFLET_EFFECT_LAMP_SHADOWS = 1 << 12,
    REFLET_EFFECT_MOTION_BLUR = 1 << 13
} RefletEffect;

/** Describes coming frames, for refletPrepare. */
typedef struct RefletPrepareInfo {
    size_t structSize; /**< required */
    uint32_t effects;  /**< required: a combination of RefletEffect */
    /** Required: as in coming frames. Of images only whether they are given matters: any handle will do. */
    const RefletGBuffer* gbuffer;
    uint32_t hasEnvironmentImage;    /**< 1: RefletEnvironment::image will be given */
    uint32_t cascades;               /**< of RefletSunShadow; 0 stands for 1 */
    RefletDepthKind shadowDepthKind; /**< of RefletSunShadow::map */
    uint32_t shadowMapSide;          /**< texels; 0: 2048 */
    uint32_t autoExposure;           /**< of refletToneMap */
    uint32_t changesSize;            /**< 1: RefletFrameInfo::renderSize will change from frame to frame */
    /** Probes, planar views and images of the frames to come; of images, only whether they are given. NULL: none. */
    const RefletIndirectLight* light;
    uint32_t lampMapSide;  /**< of refletLampShadows: texels of the largest map or face; 0: 512 */
    uint32_t lampMapTiles; /**< sum over all lamps: 1 for a 2D map, 6 for a cube; 0: 7 */
    /** As in coming frames, with its own autoExposure; NULL: refletToneMap. Handles as for gbuffer. */
    const RefletToneMapInfo* toneMap;
} RefletPrepareInfo;

/**
 * Creates up to `maxPipelines` of the pipelines that frames with these effects and settings need, and their images;
 * *remaining: number of pipelines still to create. Before a view's first frame, images and memory are those of the
 * view's size, the largest; later, those of the last frame's. Call it until *remaining is 0, while loading (to show
 * progress) and after settings have changed. Without it, the first frame creates them. Not between refletBeginFrame and
 * refletEndFrame.
 */
REFLET_API RefletResult refletPrepare(RefletView view, RefletSettings settings, const RefletPrepareInfo* info,
                                      uint32_t maxPipelines, uint32_t* remaining);

/* --------------------------------------------------------------------------------------------------- debugging --- */

/**
 * Describes the current or last frame as the library understood it, in about ten lines of text: sizes, camera,
 * conventions, formats, absent inputs, and contradictions. Look at it first. *size in: room in `text`; out: bytes
 * including the final 0. text NULL: only sets *size. Text that does not fit is truncated.
 */
REFLET_API RefletResult refletDescribe(RefletView view, size_t* size, char* text);

/** Device time of one pass. */
typedef struct RefletPassTime {
    const char* name;    /**< "diffuse.trace_screen"; valid until the view's next refletBeginFrame */
    double milliseconds; /**< device time, summed over passes of the same name */
} RefletPassTime;

/**
 * Device times of the last frame that the device is known to have finished; the first entry, "frame", is from start to
 * end, with the host's commands in between. *count in: room in `times`; out: number of passes. times NULL: only sets
 * *count. An error without REFLET_VIEW_PASS_TIMES.
 */
REFLET_API RefletResult refletPassTimes(RefletView view, uint32_t* count, RefletPassTime* times);

/**
 * An intermediate image of the current frame: depth, normal, geometric_normal, base_color, material, motion, pyramid,
 * light, sun_visibility, lamp_visibility, ambient_occlusion, exposure, circle_of_confusion, velocity_tiles, diffuse,
 * specular, diffuse_confidence, specular_confidence. The error lists what there is.
 */
REFLET_API RefletResult refletFindImage(RefletView view, const char* name, RefletImage* image);

#ifdef __cplusplus
}
#endif

#endif
