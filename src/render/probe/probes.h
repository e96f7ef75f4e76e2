// Local probes: cube maps of what is seen from some places in the scene, captured from its G-buffer and direct light,
// that answer rays as if all they show lay on the walls of a box (Lagarde and Zanuttini, Local Image-Based Lighting
// with Parallax-Corrected Cubemaps, SIGGRAPH 2012). Shared by C++ and GLSL.
#ifndef REFLET_RENDER_PROBES_H
#define REFLET_RENDER_PROBES_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

#define PROBE_REFRESHES(OPTION)   \
    OPTION(ProbeRefresh, once, 0) \
    OPTION(ProbeRefresh, face, 1) \
    OPTION(ProbeRefresh, moving, 2)
CHOICES(ProbeRefresh, PROBE_REFRESHES)

#define PROBES_SETTINGS(VALUE, SWITCH, CHOICE)                                                                         \
    SWITCH(enabled, 0, "Ask cube maps of the scene, captured at some places in it, before the environment.")           \
    VALUE(uint, count, 4, 0, 16, "Probes that are placed, at most, where the view file names none.")                   \
    VALUE(uint, resolution, 128, 16, 512,                                                                              \
          "Texels along each side of a cube map's faces; a power of two, others are rounded down to one.")             \
    CHOICE(ProbeRefresh, refresh, once,                                                                                \
           "When they are captured; once: all, and anew when lights or probes change; face: one face a frame, always " \
           "in the light of now; moving: as once, and anew whenever something has moved.")                             \
    VALUE(uint, bounces, 1, 0, 8,                                                                                      \
          "Bounces of light in the captures beyond direct light; each is one more capture, lit by the one before. "    \
          "face: 0 none, else one more with every round of the faces.")                                                \
    SWITCH(parallax, 1, "Take what a cube map shows to lie on its box; off: infinitely far away.")                     \
    VALUE(float, blend, 0.25, 0.0, 100.0, "Metres outside of its box over which a probe fades out.")
SETTINGS(ProbesSettings, PROBES_SETTINGS)

const uint maxProbes = 16;
const uint probeFaces = 6;

struct ProbeParams {
    vec3 position;  // world space, inside the box
    vec3 boxMin;
    vec3 boxMax;
};

struct ProbeBlock {
    uint count;
    ProbeParams probes[maxProbes];
};

SHARED_END

#ifdef __cplusplus

#include "gpu/resource.h"

namespace reflet {

/// Cube maps for passes to read.
struct ProbeMaps {
    gpu::Image lobes;       ///< of CubeMap (cube_map.h): radiance · alpha; alpha: 1 a surface, 0 the sky
    gpu::Image irradiance;  ///< of CubeMap, alike
    gpu::Image distance;    ///< R32F cube array: metres from the probe, 0 the sky
    gpu::Image atlas;       ///< RGBA16F: the faces as they were captured, a row of six for each probe
    ProbeBlock block{};

    explicit operator bool() const { return block.count > 0; }
};

}  // namespace reflet
#endif

#endif
