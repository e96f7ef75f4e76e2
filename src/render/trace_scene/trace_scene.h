// A source of the chain that knows all of the scene: rays traced through its triangles, hits shaded with their
// materials and lights. It answers what the sources before it have left over. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_TRACE_SCENE_H
#define REFLET_RENDER_TRACE_SCENE_H

#include "base/shared.h"
#include "render/shadow/shadow.h"
#include "render/view.h"

SHARED_BEGIN

#define SCENE_HIT_LIGHTS(OPTION)     \
    OPTION(SceneHitLight, screen, 0) \
    OPTION(SceneHitLight, path, 1)
CHOICES(SceneHitLight, SCENE_HIT_LIGHTS)

#define SCENE_SHADOWS(OPTION)    \
    OPTION(SceneShadows, ray, 0) \
    OPTION(SceneShadows, map, 1)
CHOICES(SceneShadows, SCENE_SHADOWS)

#define TRACE_SCENE_SETTINGS(VALUE, SWITCH, CHOICE)                                                                 \
    SWITCH(enabled, 0,                                                                                              \
           "Trace what the sources before it have not answered through all of the scene's triangles, on screen or " \
           "not. Rays that stand for a whole lobe go on to the next source.")                                       \
    CHOICE(SceneHitLight, light, screen,                                                                            \
           "What a hit brings besides what it emits and light of sun and lamps; screen: what a hit on the screen "  \
           "does (trace_screen.light; lit: to reflections, one diffuse ray more), so that there is no seam; path: " \
           "`bounces` scattered rays.")                                                                             \
    VALUE(uint, bounces, 1, 0, 1024,                                                                                \
          "Scattered rays that follow one another from a hit, with light=path, or screen and "                      \
          "trace_screen.light=previous; from the fifth on by Russian roulette.")                                    \
    CHOICE(SceneShadows, shadows, ray,                                                                              \
           "How a hit sees the sun; ray: a ray to a place on its disk; map: the sun's shadow map, and a ray where " \
           "the map does not reach. Lamps are always seen by rays.")                                                \
    SWITCH(reuseScreen, 1,                                                                                          \
           "A hit that the camera sees takes the light that the screen shows there, where that is all it is to "    \
           "bring: less noise, fewer rays.")                                                                        \
    VALUE(uint, maxRays, 1000000, 0, 1000000,                                                                       \
          "Thousands of rays that a frame answers so, about; the others, spread evenly, go on to the next source.") \
    VALUE(uint, textureSize, 1024, 16, 8192, "Texels along each side up to which hits see textures in full.")       \
    SWITCH(rayQuery, 1,                                                                                             \
           "Rays are traced by the device, where it has ray query; off, or where it has none: by a hierarchy that " \
           "a shader goes through.")
SETTINGS(TraceSceneSettings, TRACE_SCENE_SETTINGS)

// What shines, besides lamps and glowing surfaces.
struct SceneLights {
    vec3 toSun;
    float sunSine;       // of half the sun's angular diameter
    vec3 sunIrradiance;  // on a surface that faces it [W/m²]
    uint allLampsCast;   // 1: all lamps cast shadows; 0: those that LampParams::shadow says
    uint lambertOnly;    // 1: materials are Lambert of their base colour
};

struct TraceSceneParams {
    ViewParams own;   // of the surfaces that rays leave
    ViewParams view;  // of the screen
    TraceSceneSettings settings;
    SceneLights lights;
    SunShadowParams sun;
    float shadowBias;   // texels
    float rayLimit;     // rays that this batch may answer, about
    uint bounces;       // scattered rays after a hit
    uint diffuseOnly;   // 1: they are diffuse ones
    uint mips;          // 0: textures are read in full detail
    uint fromPrevious;  // 1: the screen's light is the last frame's
    uint firstRay;
};

// Of the specialization constant `sunShadows`.
const uint sunShadowNone = 0;
const uint sunShadowRay = 1;
const uint sunShadowMap = 2;

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/bounce/trace_screen.h"
#include "render/environment/environment_light.h"
#include "render/lamps.h"
#include "render/trace_scene/scene_rays.h"
#include "render/trace_scene/scene_surfaces.h"

namespace reflet {

/// A scene that rays can be traced through.
struct TracedScene {
    SceneRays rays;
    SceneSurfaces surfaces;
};

/// What a frame lights hits with.
struct TraceSceneInputs {
    const TracedScene& scene;
    const ScreenImages& screen;
    gpu::Image shadowMap;  ///< of the sun; none: it has no shadows, or rays find them
    gpu::Image ggxTable;
    gpu::BufferView blueNoise;
    const EnvironmentLight& environment;
    const LampBlock& lamps;
};

/// Answers rays that hit something, with confidence 1. Hands on the others, of which it is then known that nothing is
/// in their way, those past the limit, and those that stand for a whole lobe (Ray.spread).
void traceScene(gpu::Frame& f, Rays& rays, const TraceSceneInputs& in, uint32_t sunShadows,
                const TraceSceneParams& params);

}  // namespace reflet
#endif

#endif
