/*
 * Reflet in a host without a window: draws a room, adds sun shadow, SSGI, SSR and antialiasing, and writes a picture.
 * The host's conventions (examples/common/room.frag) are unlike Reflet's on purpose.
 *
 * usage: reflet_c_example [OUT.ppm [WIDTH HEIGHT [FRAMES]]]
 */
#include "host.h"

#include <reflet/reflet.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void reflet_check(RefletResult result) {
    if (result != REFLET_SUCCESS) {
        fprintf(stderr, "%s: %s\n", refletResultName(result), refletLastError());
        exit(1);
    }
}

/* [context] */
static RefletContext make_context(const Host* h) {
    RefletContextInfo info = {.structSize = sizeof info, .version = REFLET_VERSION};
    info.instance = h->instance;
    info.physicalDevice = h->physical;
    info.device = h->device;
    info.getInstanceProcAddr = vkGetInstanceProcAddr;
    info.enabledFeatures = &h->features;
    RefletContext context;
    reflet_check(refletCreateContext(&info, &context));
    return context;
}
/* [context] */

/* [image] */
/* A host's image: where it is, in which layout, and what wrote it last. */
static RefletImage given(const Picture* p, VkImageLayout layout, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    const RefletImage image = {.image = p->image, .view = p->view, .format = p->format, .width = p->width, .height = p->height,
                               .layout = layout, .stages = stages, .access = access};
    return image;
}

static RefletImage given_target(const Picture* p) {
    return given(p, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                 VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
}

static RefletImage given_depth(const Picture* p) {
    return given(p, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                 VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
}
/* [image] */

/* [gbuffer] */
static RefletGBuffer gbuffer_of(const Host* h) {
    RefletGBuffer g;
    memset(&g, 0, sizeof g);
    g.structSize = sizeof g;
    g.depth = given_depth(&h->depth);
    g.depthKind = REFLET_DEPTH_STANDARD;
    g.normal = given_target(&h->normal);
    g.normalKind = REFLET_NORMAL_VECTOR_SNORM;
    g.normalsInViewSpace = 1;
    g.roughness = g.normal;
    g.roughnessChannel = 3;
    g.roughnessKind = REFLET_ROUGHNESS_SMOOTHNESS;
    g.baseColor = given_target(&h->color);
    g.metallic = g.baseColor;
    g.metallicChannel = 3;
    g.motion = given_target(&h->motion);
    g.motionKind = REFLET_MOTION_NDC;
    return g;
}
/* [gbuffer] */

/* [frame] */
/* Records the frame's effects; returns the finished picture. */
static RefletImage record_effects(Host* h, Slot* slot, RefletView view, RefletSettings settings, const Camera* now,
                                  const Camera* before, const float jitter[2], const float previous_jitter[2]) {
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
    memcpy(frame.jitter, jitter, sizeof frame.jitter);
    memcpy(frame.previousJitter, previous_jitter, sizeof frame.previousJitter);
    const RefletGBuffer gbuffer = gbuffer_of(h);
    frame.gbuffer = &gbuffer;
    reflet_check(refletBeginFrame(view, &frame));

    RefletSunShadow sun;
    memset(&sun, 0, sizeof sun);
    sun.structSize = sizeof sun;
    sun.map = given_depth(&h->sun_map);
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

    RefletIndirectLight light;
    memset(&light, 0, sizeof light);
    light.structSize = sizeof light;
    light.light = given(&h->lit, VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                        VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    RefletEnvironment environment;
    memset(&environment, 0, sizeof environment);
    environment.structSize = sizeof environment;
    memcpy(environment.factor, now->sky, sizeof environment.factor);
    light.environment = &environment;
    RefletLobe diffuse = {.structSize = sizeof diffuse}, specular = {.structSize = sizeof specular};
    reflet_check(refletDiffuseGi(view, settings, &light, &diffuse));
    light.light.stages = 0; /* no longer new */
    reflet_check(refletReflections(view, settings, &light, &specular));
    RefletComposite sum = {.structSize = sizeof sum};
    reflet_check(refletComposite(view, settings, NULL, &sum));
    RefletImage mean, display;
    reflet_check(refletTemporal(view, settings, NULL, &mean));
    reflet_check(refletToneMap(view, settings, NULL, 0, &display));
    reflet_check(refletEndFrame(view));
    return display;
}
/* [frame] */

/* [prepare] */
static void prepare(RefletView view, RefletSettings settings, const RefletGBuffer* g) {
    RefletPrepareInfo info = {.structSize = sizeof info, .gbuffer = g, .shadowDepthKind = REFLET_DEPTH_STANDARD,
                              .shadowMapSide = SUN_MAP_SIDE};
    info.effects = REFLET_EFFECT_SUN_SHADOW | REFLET_EFFECT_DIFFUSE_GI | REFLET_EFFECT_REFLECTIONS | REFLET_EFFECT_COMPOSITE |
                   REFLET_EFFECT_TEMPORAL | REFLET_EFFECT_TONE_MAP;
    uint32_t remaining = 1;
    while (remaining > 0) {
        reflet_check(refletPrepare(view, settings, &info, 8, &remaining));
        fprintf(stderr, "\rpipelines to make: %u ", remaining);
    }
    fprintf(stderr, "\n");
}
/* [prepare] */

/* [times] */
/* Device times of the last frame; the device has finished all frames. */
static void print_times(RefletView view) {
    RefletPassTime times[128];
    uint32_t count = 128;
    reflet_check(refletFinishView(view));
    reflet_check(refletPassTimes(view, &count, times));
    const char* groups[] = {"import", "shadow", "diffuse", "specular", "composite", "temporal", "tonemap"};
    for (size_t g = 0; g < sizeof groups / sizeof *groups; ++g) {
        double sum = 0.0;
        for (uint32_t i = 0; i < count && i < 128; ++i) {
            if (strncmp(times[i].name, groups[g], strlen(groups[g])) == 0) sum += times[i].milliseconds;
        }
        fprintf(stderr, "%s %.2f ms, ", groups[g], sum);
    }
    fprintf(stderr, "frame %.2f ms\n", count > 0 ? times[0].milliseconds : 0.0);
}
/* [times] */

int main(int count, char** arguments) {
    const char* path = count > 1 ? arguments[1] : "room.ppm";
    const uint32_t width = count > 3 ? (uint32_t)atoi(arguments[2]) : 640;
    const uint32_t height = count > 3 ? (uint32_t)atoi(arguments[3]) : 360;
    const uint32_t frames = count > 4 ? (uint32_t)atoi(arguments[4]) : 32;
    Host h = {0};
    host_open(&h, NULL, 0, NULL, 0);
    host_make_targets(&h, width, height);
    Download download = make_download(&h, width, height);

    /* [view] */
    RefletContext context = make_context(&h);
    const RefletViewInfo view_info = {sizeof view_info, width, height, FRAMES_IN_FLIGHT, REFLET_VIEW_PASS_TIMES, 0};
    RefletView view;
    reflet_check(refletCreateView(context, &view_info, &view));
    RefletSettings settings;
    reflet_check(refletCreateSettings("balanced", &settings));
    reflet_check(refletSetSetting(settings, "shadow.history", "32"));
    /* [view] */
    const RefletGBuffer g = gbuffer_of(&h);
    prepare(view, settings, &g);

    Camera cameras[2];
    float jitters[2][2] = {{0.0F, 0.0F}, {0.0F, 0.0F}};
    for (uint32_t i = 0; i < frames; ++i) {
        Camera* now = &cameras[i % 2];
        Camera* before = i > 0 ? &cameras[(i + 1) % 2] : now;
        Slot* slot = host_begin(&h);
        refletJitter(i, jitters[i % 2]);
        host_camera(&h, now, i > 0 ? before : NULL, jitters[i % 2], 0.35F);
        host_draw(&h, slot, now);
        const RefletImage picture = record_effects(&h, slot, view, settings, now, before, jitters[i % 2], jitters[(i + (i > 0)) % 2]);
        if (i + 1 == frames) record_download(&download, slot->commands, picture.image, picture.stages, picture.access);
        host_submit(&h, slot);
    }
    check(vkDeviceWaitIdle(h.device), "vkDeviceWaitIdle");
    write_download(&h, &download, path);
    print_times(view);
    uint64_t bytes;
    reflet_check(refletViewMemory(view, &bytes));
    fprintf(stderr, "Reflet's images take %.1f MB\n", (double)bytes * 1e-6);

    refletDestroySettings(settings);
    refletDestroyView(view);
    refletDestroyContext(context);
    host_free_targets(&h);
    host_close(&h);
    return 0;
}
