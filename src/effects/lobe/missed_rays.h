// A host's own source of light for rays: lists the unresolved rays for the host, and reads its answers. Shared by C++
// and GLSL.
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

/// The unresolved rays of a lobe that a host reads, and the answers that it writes.
struct MissedRays {
    gpu::BufferView rays;     ///< header as in ray lists: groups of an indirect dispatch, count; then MissedRay
    gpu::BufferView answers;  ///< HostAnswer of each, in the same order; zero at first
    uint32_t capacity = 0;    ///< the most rays
};

/// Lists begun.rays.waiting for a host. Everything that finishLobe reads of the rays stays for later lists of the
/// frame, until releaseMissed. Throws UsageError if the device's buffers cannot hold the rays.
MissedRays listMissed(gpu::PassList& f, const BegunLobe& begun);

/// A source of light for rays: the host's answers.
void takeAnswers(gpu::PassList& f, Rays& rays, gpu::BufferView answers);

/// To be called behind the list of finishLobe: later lists may use the memory.
void releaseMissed(gpu::PassList& f, const BegunLobe& begun, const MissedRays& missed);

}  // namespace reflet
#endif

#endif
