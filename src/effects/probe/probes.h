// Local reflection probes: cube maps of the light around a point, with parallax correction by box projection (Lagarde
// and Zanuttini, Local Image-Based Lighting with Parallax-Corrected Cubemaps, SIGGRAPH 2012). Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_PROBES_H
#define REFLET_EFFECTS_PROBES_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define PROBE_REFRESHES(OPTION)   \
    OPTION(ProbeRefresh, once, 0) \
    OPTION(ProbeRefresh, face, 1) \
    OPTION(ProbeRefresh, moving, 2)
CHOICES(ProbeRefresh, PROBE_REFRESHES)

#define PROBE_PARALLAXES(OPTION)   \
    OPTION(ProbeParallax, none, 0) \
    OPTION(ProbeParallax, box, 1)  \
    OPTION(ProbeParallax, depth, 2)
CHOICES(ProbeParallax, PROBE_PARALLAXES)

#define PROBES_SETTINGS(VALUE, SWITCH, CHOICE)                                                                         \
    SWITCH(enabled, 0,                                                                                                 \
           "Reflection probes: cube maps captured in the scene, used before the environment for rays without a hit.")  \
    VALUE(uint, count, 12, 0, 16,                                                                                      \
          "Maximum number of probes placed automatically, if the view file lists none. Fewer where these show all "    \
          "that lights what the camera sees.")                                                                         \
    VALUE(uint, resolution, 64, 16, 512, "Side of a cube map face in texels, rounded down to a power of two.")         \
    CHOICE(ProbeRefresh, refresh, once,                                                                                \
           "When probes are captured. once: all of them, and again when lights or probes change. face: one cube face " \
           "per frame, always with the current lighting. moving: as once, and again whenever something moved.")        \
    VALUE(uint, bounces, 4, 0, 8,                                                                                      \
          "Bounces of indirect light in the captures. Each lights the captured surfaces again by all probes; nothing " \
          "is drawn for it. With refresh face: 0 is none, otherwise each round over the faces adds one.")              \
    CHOICE(ProbeParallax, parallax, depth,                                                                             \
           "Parallax correction. depth: march rays through the distances that the probe captured; box: intersect "     \
           "them with the probe's box (box projection), faster; none: the cube map is taken as infinitely far away.")  \
    VALUE(float, reach, 4.0, 0.0, 100.0,                                                                               \
          "Distance outside of its box over which a probe fades out, in diagonals of the box. Short: what no box "     \
          "reaches has only the environment's light.")
SETTINGS(ProbesSettings, PROBES_SETTINGS)

const uint maxProbes = 16;
const uint probeFaces = 6;

struct ProbeParams {
    vec3 position;  // that its maps show the surroundings of; world space, inside the box
    float blend;    // distance outside of the box over which it fades out [m]
    vec3 boxMin;    // surfaces in it are lit by the probe
    uint parallax;  // ProbeParallax; depth only where all passes bind distances
    vec3 boxMax;
    float radianceScale;  // of what its maps hold: 1, or a host's pre-exposure
    vec3 parallaxMin;     // the surroundings, for box projection; mostly the same box
    float unused2;        // 0
    vec3 parallaxMax;
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
    gpu::Image lobes;    ///< of CubeMap (cube_map.h): radiance · alpha; alpha: 1 surface, 0 sky
    gpu::Image diffuse;  ///< its first level without what lamps stand for (lampEmitter): for diffuse rays, and others
                         ///< with Ray.highlighted
    gpu::Image irradiance;  ///< of CubeMap, with alpha as well; as `diffuse`
    gpu::Image
        distance;      ///< R32F cube array: 1 / metres from the probe, 0: sky; none: no probe has ProbeParallax::depth
    gpu::Image atlas;  ///< RGBA16F: the captured faces, a row of six per probe; of captured probes
    ProbeParallax parallax = ProbeParallax::depth;  ///< the most exact one of the block
    ProbeBlock block{};

    explicit operator bool() const { return block.count > 0; }
};

}  // namespace reflet
#endif

#endif
