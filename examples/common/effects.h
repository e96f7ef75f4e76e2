/* What the examples tell Reflet about the room: examples/c/main.c has the same, one step after another. */
#ifndef EXAMPLE_EFFECTS_H
#define EXAMPLE_EFFECTS_H

#include "host.h"

#include <reflet/reflet.h>

/* Cameras and jitter of this frame and the last one. */
typedef struct Frame {
    Camera *now, *before;
    float *jitter, *previous_jitter;
    uint32_t render_size[2]; /* 0, 0: all of the images */
} Frame;

/* Cameras of successive frames. */
typedef struct Path {
    Camera cameras[2];
    float jitters[2][2];
    uint32_t frames;
} Path;

void reflet_check(RefletResult result);
RefletContext make_context(const Host* h);
/* A host's image: where it is, in which layout, and what wrote it last. */
RefletImage given(const Picture* p, VkImageLayout layout, VkPipelineStageFlags2 stages, VkAccessFlags2 access);
/* As the host's draws leave it. */
RefletImage given_target(const Host* h, const Picture* p);
RefletImage given_depth(const Host* h, const Picture* p);
RefletGBuffer gbuffer_of(const Host* h);

/* The next frame's camera, which the host has not drawn yet. */
Frame next_frame(Host* h, Path* path, float angle);
void begin_effects(Host* h, Slot* slot, RefletView view, const Frame* frame);
/* Sun shadow, and the host's own light with it. */
RefletIndirectLight light_room(Host* h, Slot* slot, RefletView view, RefletSettings settings, const Camera* now,
                               RefletEnvironment* environment);
/* Composite, antialiasing, tone map: the finished picture. */
RefletImage finish_effects(RefletView view, RefletSettings settings);
/* All of these, with SSGI and SSR in between. */
RefletImage record_effects(Host* h, Slot* slot, RefletView view, RefletSettings settings, const Frame* frame);

#endif
