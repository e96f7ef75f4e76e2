// Ray tracing as a ray source: rays that earlier sources missed are traced against the scene's BVH, on screen or off,
// and hits are shaded with their materials and lights. Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_TRACE_SCENE_H
#define REFLET_RENDERER_TRACE_SCENE_H

#include "base/shared.h"
#include "effects/radiance_cache/radiance_cache.h"
#include "effects/shadow/shadow.h"
#include "effects/view.h"

SHARED_BEGIN

#define SCENE_HIT_LIGHTS(OPTION)     \
    OPTION(SceneHitLight, screen, 0) \
    OPTION(SceneHitLight, path, 1)
CHOICES(SceneHitLight, SCENE_HIT_LIGHTS)

#define SCENE_SHADOWS(OPTION)    \
    OPTION(SceneShadows, ray, 0) \
    OPTION(SceneShadows, map, 1)
CHOICES(SceneShadows, SCENE_SHADOWS)

#define TRACE_SCENE_SETTINGS(VALUE, SWITCH, CHOICE)                                                                    \
    SWITCH(enabled, 0,                                                                                                 \
           "Ray tracing against the scene's BVH, on screen or off, for rays without a hit so far. Cones (prefiltered " \
           "lobes) skip it. More complete, slower.")                                                                   \
    CHOICE(SceneHitLight, light, screen,                                                                               \
           "Indirect light at a hit, in addition to emission, sun and lamps. screen: the same as screen-space hits "   \
           "get (trace_screen.light; for lit, reflections trace one diffuse ray more), so that both match. path: "     \
           "path tracing with up to `bounces` bounces.")                                                               \
    VALUE(uint, bounces, 1, 0, 1024,                                                                                   \
          "Maximum bounces after a hit, with light path, or with light screen and trace_screen.light previous, whose " \
          "paths end in probes' light, if there are any. Russian roulette from the fifth on. More: brighter corners, " \
          "slower.")                                                                                                   \
    CHOICE(SceneShadows, shadows, ray,                                                                                 \
           "Sun shadows at hits. ray: a shadow ray to a random point of the sun's disk. map: the sun's shadow map, "   \
           "and a ray outside of it; faster, harder edges. Lamps always get shadow rays.")                             \
    SWITCH(reuseScreen, 1,                                                                                             \
           "Where a hit is visible on screen, reuse the light stored there instead of shading it again, if that is "   \
           "all the hit needs. Less noise, fewer rays.")                                                               \
    VALUE(uint, maxRays, 1000000, 0, 1000000,                                                                          \
          "Ray budget per frame, in thousands, approximate. Rays above it, chosen by blue noise, go to the next "      \
          "source.")                                                                                                   \
    VALUE(uint, textureSize, 1024, 16, 8192,                                                                           \
          "Maximum side of textures at ray hits, in texels; larger textures are downsampled. More: sharper "           \
          "reflections, more memory.")                                                                                 \
    SWITCH(rayQuery, 1,                                                                                                \
           "Trace with hardware ray query where the device has it. Off, or without it: a software BVH in a compute "   \
           "shader.")
SETTINGS(TraceSceneSettings, TRACE_SCENE_SETTINGS)

// Light parameters, apart from lamps and emissive surfaces.
struct SceneLights {
    vec3 toSun;
    float sunSine;       // sine of half the sun's angular diameter
    vec3 sunIrradiance;  // on a surface that faces the sun [W/m²]
    uint allLampsCast;   // 1: all lamps cast shadows; 0: only those with LampParams::shadow
    uint lambertOnly;    // 1: materials are Lambert diffuse with their base colour
};

struct TraceSceneParams {
    ViewParams own;   // view of the surfaces that rays start from
    ViewParams view;  // view of the screen
    TraceSceneSettings settings;
    SceneLights lights;
    SunShadowParams sun;
    float shadowBias;   // texels
    float rayLimit;     // approximate ray budget of this batch
    uint bounces;       // bounces after a hit
    uint diffuseOnly;   // 1: only diffuse bounces
    uint mips;          // 0: textures are read at the finest level
    uint fromPrevious;  // 1: screen light is the last frame's
    uint firstRay;
    float cellSize;      // cell size of the radiance cache
    float samplesToEnd;  // as in CacheBuffers
};

// Values of the specialization constant `sunShadows`.
const uint sunShadowNone = 0;
const uint sunShadowRay = 1;
const uint sunShadowMap = 2;

SHARED_END

#ifdef __cplusplus

#include "effects/environment/environment_light.h"
#include "effects/lamps.h"
#include "effects/lobe/trace_screen.h"
#include "effects/probe/probes.h"
#include "gpu/pass_list.h"
#include "renderer/trace_scene/scene_rays.h"
#include "renderer/trace_scene/scene_surfaces.h"

namespace reflet {

/// A scene for ray tracing.
struct TracedScene {
    SceneRays rays;
    SceneSurfaces surfaces;
};

/// Inputs for shading hits.
struct TraceSceneInputs {
    const TracedScene& scene;
    const ScreenImages& screen;
    gpu::Image shadowMap;  ///< the sun's; none without shadows or with ray-traced ones
    gpu::Image ggxTable;
    gpu::BufferView blueNoise;
    const EnvironmentLight& environment;
    const LampBlock& lamps;
    const ProbeMaps& probes;  ///< approximate further bounces where a path ends; may be empty
    CacheBuffers cache;       ///< radiance cache, used before probes and updated by the paths; may be none
    uint32_t throughGlass = glassStraight;
    float hitRadius = 0.0F;  ///< radius for smoothHits [pixels]; below 1: off
};

/// Hits get confidence 1. Misses stay in rays.waiting, marked as known misses, and so do rays beyond the budget and
/// cones (Ray.spread).
void traceScene(gpu::PassList& f, Rays& rays, const TraceSceneInputs& in, uint32_t sunShadows,
                const TraceSceneParams& params);

}  // namespace reflet
#endif

#endif
