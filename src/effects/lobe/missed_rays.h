// A host's own source of rays: lists the waiting rays for the host, and takes its answers. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_MISSED_RAYS_H
#define REFLET_EFFECTS_MISSED_RAYS_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

// RefletMissedRay of the C API, which documents it.
struct MissedRay {
    vec3 origin;
    float clear;
    vec3 direction;
    float rest;
    uint pixel;   // x + 65536 · y, at full resolution
    uint number;  // lobe + 65536 · number of the ray in its pixel
    float spread;
    float roughness;
};

// RefletRayAnswer of the C API.
struct HostAnswer {
    vec3 radiance;
    float confidence;
    float hitDistance;  // negative: the ray hits nothing
    uint reserved0;
    uint reserved1;
    uint reserved2;
};

struct ListMissedParams {
    ViewParams own;    // of the grid
    uint scale;        // of RaySurfaces
    uint blockOffset;  // of the picked pixel in its block, along each side
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/lobe.h"

namespace reflet {

/// The waiting rays of a lobe as a host reads them, and what it writes.
struct MissedRays {
    gpu::BufferView rays;     ///< header as in ray lists: groups of an indirect dispatch, count; then MissedRay
    gpu::BufferView answers;  ///< HostAnswer of each, in the same order; zero at first
    uint32_t capacity = 0;    ///< the most rays
};

/// Lists begun.rays.waiting for a host. Everything that finishLobe reads of the rays stays for later lists of the
/// frame, until releaseMissed. Throws UsageError if the device's buffers cannot hold the rays.
MissedRays listMissed(gpu::PassList& f, const BegunLobe& begun);

/// A source of rays: what the host has answered.
void takeAnswers(gpu::PassList& f, Rays& rays, gpu::BufferView answers);

/// To be called behind the list of finishLobe: later lists may use the memory.
void releaseMissed(gpu::PassList& f, const BegunLobe& begun, const MissedRays& missed);

}  // namespace reflet
#endif

#endif
