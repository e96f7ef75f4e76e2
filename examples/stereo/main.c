/*
 * Reflet for two eyes: layers of the same array images, a view for each eye with a `viewIndex` of its own, so that their
 * noise is independent, both of one context. Each eye's frame is recorded by a thread of its own, into a command buffer of
 * its own pool.
 *
 * usage: reflet_stereo_example [OUT.ppm [WIDTH HEIGHT [FRAMES]]]      writes OUT.ppm-left.ppm and OUT.ppm-right.ppm
 */
#include "effects.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

enum { EYES = 2 };

typedef struct Eye {
    Host host; /* the second one lies beside the first: the same device, and layers of its images */
    RefletView view;
    RefletSettings settings;
    Path path;
    Slot* slot;       /* of the frame that is recorded */
    Frame frame;      /* its camera */
    RefletImage shown; /* its picture */
} Eye;

/* All targets as arrays of a layer for each eye. */
static void make_targets(Eye eyes[EYES], uint32_t width, uint32_t height) {
    Host* first = &eyes[0].host;
    const VkImageUsageFlags target = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    const VkImageUsageFlags depth = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    first->width = width;
    first->height = height;
    first->depth = make_layers(first, width, height, VK_FORMAT_D32_SFLOAT, depth, EYES);
    first->normal = make_layers(first, width, height, VK_FORMAT_R16G16B16A16_SFLOAT, target, EYES);
    first->color = make_layers(first, width, height, VK_FORMAT_R8G8B8A8_SRGB, target, EYES);
    first->motion = make_layers(first, width, height, VK_FORMAT_R16G16_SFLOAT, target, EYES);
    first->lit = make_layers(first, width, height, VK_FORMAT_R16G16B16A16_SFLOAT,
                             VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, EYES);
    first->sun_map = make_layers(first, SUN_MAP_SIDE, SUN_MAP_SIDE, VK_FORMAT_D32_SFLOAT, depth, EYES);
    Host* second = &eyes[1].host;
    second->width = width;
    second->height = height;
    second->depth = layer_of(first, &first->depth, 1);
    second->normal = layer_of(first, &first->normal, 1);
    second->color = layer_of(first, &first->color, 1);
    second->motion = layer_of(first, &first->motion, 1);
    second->lit = layer_of(first, &first->lit, 1);
    second->sun_map = layer_of(first, &first->sun_map, 1);
}

/* A thread: records what the eye sees. */
static void* record_eye(void* of) {
    Eye* eye = of;
    host_draw(&eye->host, eye->slot, eye->frame.now);
    eye->shown = record_effects(&eye->host, eye->slot, eye->view, eye->settings, &eye->frame);
    return NULL;
}

static void record_both(Eye eyes[EYES]) {
    pthread_t threads[EYES];
    for (int e = 0; e < EYES; ++e) {
        if (pthread_create(&threads[e], NULL, record_eye, &eyes[e]) != 0) {
            fprintf(stderr, "no thread can be made\n");
            exit(1);
        }
    }
    for (int e = 0; e < EYES; ++e) pthread_join(threads[e], NULL);
}

int main(int count, char** arguments) {
    const char* path = count > 1 ? arguments[1] : "stereo.ppm";
    const uint32_t width = count > 3 ? (uint32_t)atoi(arguments[2]) : 480;
    const uint32_t height = count > 3 ? (uint32_t)atoi(arguments[3]) : 360;
    const uint32_t frames = count > 4 ? (uint32_t)atoi(arguments[4]) : 32;
    static Eye eyes[EYES];
    host_open(&eyes[0].host, NULL, 0, NULL, 0);
    host_open_beside(&eyes[1].host, &eyes[0].host);
    make_targets(eyes, width, height);
    RefletContext context = make_context(&eyes[0].host);
    Download downloads[EYES];
    for (uint32_t e = 0; e < EYES; ++e) {
        Eye* eye = &eyes[e];
        const RefletViewInfo info = {.structSize = sizeof info, .width = width, .height = height, .framesInFlight = FRAMES_IN_FLIGHT,
            .viewIndex = e};
        reflet_check(refletCreateView(context, &info, &eye->view));
        reflet_check(refletCreateSettings("balanced", &eye->settings));
        downloads[e] = make_download(&eye->host, width, height);
    }
    for (uint32_t i = 0; i < frames; ++i) {
        for (int e = 0; e < EYES; ++e) {
            eyes[e].slot = host_begin(&eyes[e].host);
            eyes[e].frame = next_frame(&eyes[e].host, &eyes[e].path, 0.35F + 0.02F * (float)e); /* 12 cm apart, at 6 m */
        }
        record_both(eyes);
        for (int e = 0; e < EYES; ++e) {
            const RefletImage* shown = &eyes[e].shown;
            if (i + 1 == frames) record_download(&downloads[e], eyes[e].slot->commands, shown->image, shown->stages, shown->access);
            host_submit(&eyes[e].host, eyes[e].slot);
        }
    }
    check(vkDeviceWaitIdle(eyes[0].host.device), "vkDeviceWaitIdle");
    for (int e = 0; e < EYES; ++e) {
        char name[4096];
        snprintf(name, sizeof name, "%s-%s.ppm", path, e == 0 ? "left" : "right");
        write_download(&eyes[e].host, &downloads[e], name);
        refletDestroySettings(eyes[e].settings);
        refletDestroyView(eyes[e].view);
    }
    refletDestroyContext(context);
    host_free_targets(&eyes[1].host);
    host_free_targets(&eyes[0].host);
    host_close_beside(&eyes[1].host);
    host_close(&eyes[0].host);
    return 0;
}
