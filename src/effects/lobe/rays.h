// Rays of both indirect lobes, diffuse and specular: their directions, results so far, and lists of the rays that are
// still unresolved. Shared by C++ and GLSL.
//
// The chain: generateRays → a source → the next source for its misses → … → the environment → resolveRays. Every source
// takes a list of rays with their remaining weights, adds its radiance to the ray's texel, and passes the remaining
// weight on. The weights of one ray sum to 1.
#ifndef REFLET_EFFECTS_RAYS_H
#define REFLET_EFFECTS_RAYS_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define RAY_DISTRIBUTIONS(OPTION)       \
    OPTION(RayDistribution, cosine, 0)  \
    OPTION(RayDistribution, uniform, 1) \
    OPTION(RayDistribution, normal, 2)
CHOICES(RayDistribution, RAY_DISTRIBUTIONS)

#define RAY_NOISES(OPTION)     \
    OPTION(RayNoise, white, 0) \
    OPTION(RayNoise, blue, 1)
CHOICES(RayNoise, RAY_NOISES)

// What both lobes have. RAYS: default of `rays`; WHAT: what it is the number of.
#define LOBE_SETTINGS(VALUE, SWITCH, CHOICE, RAYS, WHAT)                                                            \
    VALUE(uint, rays, RAYS, 0, 256, WHAT " More: less noise, cost grows linearly. 0: none.")                        \
    CHOICE(RayNoise, noise, blue,                                                                                   \
           "Random numbers for ray directions. white: independent. blue: a low-discrepancy sequence with "          \
           "blue-noise shifts in space and time; less error, easier to denoise.")                                   \
    SWITCH(adaptive, 0,                                                                                             \
           "Adaptive sampling: `rays` becomes the mean, and noisy or newly visible tiles get more, the others "     \
           "fewer (0.5 to 4 times, at most 8). Needs denoise.history, and `rays` of at most 8.")                    \
    VALUE(uint, downsample, 1, 1, 4,                                                                                \
          "Trace at reduced resolution: one pixel of each NxN block traces. 2: half resolution, a quarter of the "  \
          "cost. Bilateral upsampling by depth and normal.")                                                        \
    VALUE(uint, reuse, 0, 0, 8,                                                                                     \
          "Neighbouring pixels whose rays are reused (ratio estimator). More: less noise, slightly blurred light. " \
          "Needs at most 4 samples per pixel, and not with `adaptive`.")

#define DIFFUSE_METHODS(OPTION)    \
    OPTION(DiffuseMethod, rays, 0) \
    OPTION(DiffuseMethod, slices, 1)
CHOICES(DiffuseMethod, DIFFUSE_METHODS)

#define DIFFUSE_SETTINGS(VALUE, SWITCH, CHOICE)                                                                        \
    LOBE_SETTINGS(VALUE, SWITCH, CHOICE, 4, "Samples per pixel for diffuse GI (global illumination, indirect light).") \
    CHOICE(RayDistribution, distribution, cosine,                                                                      \
           "Sampling of ray directions over the hemisphere. cosine: importance-sampled, least noise. uniform: all "    \
           "directions alike. normal: one lookup along the normal instead of rays; only irradiance sources (probes, "  \
           "environment) respond.")                                                                                    \
    CHOICE(                                                                                                            \
        DiffuseMethod, method, rays,                                                                                   \
        "How the screen is searched for diffuse light. rays: each sample marches a ray (trace_screen). slices: each "  \
        "sample walks both ways through a slice of the hemisphere in a fixed number of steps (visibility bitmask), "   \
        "and "                                                                                                         \
        "takes the light of everything that covers it; open directions go to the next source. Less time per sample, "  \
        "distant and thin objects are sampled more coarsely.")                                                         \
    VALUE(uint, sliceSteps, 8, 1, 64,                                                                                  \
          "Steps to each side of a slice (method=slices). More: less noise and leaking, cost grows linearly.")         \
    VALUE(float, maxDistance, 100000.0, 0.01, 100000.0,                                                                \
          "Maximum length of diffuse rays on screen in metres (trace_screen.max_distance applies too); beyond it the " \
          "next source is used.")                                                                                      \
    VALUE(float, gain, 1.0, 0.0, 64.0,                                                                                 \
          "Factor on diffuse GI. 1 conserves energy; pi reproduces renderers that leave out the 1/pi of Lambert's "    \
          "BRDF.")
SETTINGS(DiffuseSettings, DIFFUSE_SETTINGS)

#define ROUGH_FALLBACKS(OPTION)    \
    OPTION(RoughFallback, next, 0) \
    OPTION(RoughFallback, mips, 1)
CHOICES(RoughFallback, ROUGH_FALLBACKS)

#define SPECULAR_SETTINGS(VALUE, SWITCH, CHOICE)                                                                       \
    LOBE_SETTINGS(VALUE, SWITCH, CHOICE, 1,                                                                            \
                  "Samples per pixel for reflections (indirect specular light), drawn from the GGX lobe by "           \
                  "roughness.")                                                                                        \
    VALUE(float, maxRoughness, 1.0, 0.0, 1.0,                                                                          \
          "Highest roughness with stochastic rays; rougher surfaces use `rough_fallback`. Lower: less noise and "      \
          "cost, less exact. 1: all surfaces trace.")                                                                  \
    CHOICE(RoughFallback, roughFallback, next,                                                                         \
           "Reflections on surfaces above `max_roughness`. next: skip the screen, use the next source. mips: cone "    \
           "tracing, a ray near the lobe's centre with screen light prefiltered by roughness around its hit.")         \
    VALUE(float, roughRays, 1.0, 0.0625, 1.0,                                                                          \
          "Share of the pixels that trace in a frame, in turn, where all surfaces of a tile (8x8 pixels) are rougher " \
          "than 0.3: the denoiser's history fills in. Lower: less cost, slower reaction. Needs denoise.history.")
SETTINGS(SpecularSettings, SPECULAR_SETTINGS)

// Lobes, as the specialization constant `lobe`.
const uint lobeDiffuse = 0;
const uint lobeSpecular = 1;

// Maximum rays per pixel in one batch; more are traced in several batches.
const uint maxRaysPerBatch = 4;

// Ray lists store the number of a ray in its pixel in 4 bits.
const uint maxRaysInList = 16;

// Ray lists store pixel coordinates in 14 bits.
const uint maxFrameSize = 16384;

// A ray in a list, as packWaitingRay (rays.glsl) packs it.
struct RayItem {
    uint slot;
    uint restAndClear;
    uint inFront;
};

// A ray whose march is not finished, as packUnfinished (march_phases.glsl) packs it.
struct UnfinishedRay {
    RayItem ray;
    uint place;
    uint first;
    float clear;
};

// Header size in bytes: group counts for an indirect dispatch, then the number of items.
const uint rayListHeader = 16;

struct GenerateRaysParams {
    ViewParams view;
    DiffuseSettings diffuse;
    SpecularSettings specular;
    uint firstRay;    // index of the batch's first ray in its pixel
    uint rayCount;    // of the batch
    float coneShare;  // for cones (RoughFallback_mips): the central share of the visible normals from which the ray is
                      // sampled; 0: always the lobe's mean direction
    float roughestHighlight;  // of emitters (emitter_highlight.glsl); 0: no ray leaves them out
};

struct ResolveRaysParams {
    uint firstRay;  // index of the batch's first ray in its pixel; 0: overwrite, else add to earlier batches
    uint rayCount;  // of the batch
    uint frame;     // as of the view
    uvec2 size;
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/ray_surfaces.h"
#include "effects/lobe/ray_tiles.h"
#include "gpu/pass_list.h"

#include <functional>

namespace reflet {

/// What LOBE_SETTINGS adds to the table of either lobe.
struct LobeSettings {
    uint32_t rays = 0;
    RayNoise noise = RayNoise::blue;
    bool adaptive = false;
    uint32_t downsample = 1;
    uint32_t reuse = 0;
};

template <class Table>
LobeSettings lobeSettings(const Table& s) {
    return {s.rays, s.noise, s.adaptive != 0, s.downsample, s.reuse};
}

/// One batch of rays of one lobe. Images have a layer per ray of a pixel.
struct Rays {
    RaySurfaces from;  ///< that rays start from
    RayTiles tiles;  ///< with the rays per pixel; in the images below, layers beyond a pixel's ray count are undefined
    gpu::Image direction;  ///< RG32_UINT array: direction (packUnitVector, world), packRay: weight, trust, spread
    gpu::Image answer;     ///< RGBA16F array: radiance · weights so far, hit distance · weights [m]
    gpu::Image source;     ///< RGBA8 array: colours of the sources · weights; alpha: confidence
    gpu::Image turning;  ///< RGBA16F array: what LobeLight.directional gets besides that of `direction`, for rays that
                         ///< stand for light from several directions (startSlices); none for others
    gpu::Image steps;    ///< R32F array: depth samples of the screen-space march; 1x1 unless counted
    gpu::Image imageMotion;   ///< of LobeLight, or none; sources write it for each pixel's first ray
    gpu::BufferView waiting;  ///< rays with remaining weight
    uint32_t firstRay = 0;
    uint32_t count = 0;  ///< per pixel, in this batch, at most
    uint32_t lobe = 0;
    bool highlights = false;  ///< whether some Ray.highlighted may be true
    bool spreads = false;     ///< whether some Ray.spread may be above 0
    bool ofView = false;      ///< view rays, from in front of the surfaces in `from`, whose own light is known
    bool countSteps = false;
    bool directional = false;  ///< whether to compute LobeLight.directional; diffuse only
};

/// A lobe's incoming radiance, averaged per pixel; not yet multiplied by the surface's reflectance (demodulated).
struct LobeLight {
    RaySurfaces from;     ///< one per pixel of the images
    gpu::Image radiance;  ///< RGBA16F: mean of radiance · ray weight; alpha: mean hit distance [m]. Negative: no rays
                          ///< in this frame, though other pixels of the tile had some (adaptive)
    gpu::Image source;  ///< RGBA16F: mean colour of the sources; alpha: confidence. 8 bits are too few for sums of many
                        ///< batches
    gpu::Image steps;   ///< R32F: mean depth samples per ray; none unless they are counted
    gpu::Image hits;    ///< RG32F: mean over the rays of distance [m] · share that sources with a certain hit have
                        ///< answered, and of that share; none unless they are counted
    RayTiles tiles;     ///< none without rays
    /// RG16F: uv motion of the reflected image since the last frame caused by the reflected object's own motion
    /// (object_motion.glsl); none unless requested.
    gpu::Image imageMotion;
    /// RGBA16F: variation of the light with the normal (directional_light.glsl); none unless requested.
    gpu::Image directional;
    /// RGBA16F: light of the radiance cache from earlier frames and other cameras: mean incoming radiance,
    /// cosine-weighted; alpha: its history length in frames, 0: unknown. The denoiser starts from it where it has no
    /// history. None: there is no cache.
    gpu::Image remembered;
    /// Offset, in pixels of the picture, between the position that a pixel samples and the one that its light belongs
    /// to. Temporal means belong to the pixel's whole area, the surface to this frame's subpixel jitter.
    vec2 shift{0.0F};
    bool dark = false;  ///< made by blackLobe: all black
};

/// Rays per pixel of one batch, 1 to `most`: as many as the device's buffers can hold at this size. Throws Error if not
/// even one fits.
uint32_t raysPerBatch(gpu::PassList& f, uvec2 size, uint32_t most = maxRaysPerBatch);

/// Answers what it can of rays.waiting, and leaves the other rays there: a source of the chain. It binds rays.answer
/// and rays.source, and takes the list of its misses from makeRayList.
using RaySource = std::function<void(gpu::PassList&, Rays&)>;

/// Whether some rays of the lobe may have a spread.
bool raysSpread(uint32_t lobe, const DiffuseSettings& diffuse, const SpecularSettings& specular);

/// Empties a list of rays.
void clearRayList(gpu::PassList& f, gpu::BufferView list);

/// An empty list with room for all rays, for a source's misses.
gpu::BufferView makeRayList(gpu::PassList& f, const Rays& rays);

/// A lobe's images, not yet written; `directional` only if it is asked for.
LobeLight lobeImages(gpu::PassList& f, const RaySurfaces& from, bool countSteps, bool directional);

/// A lobe without rays, cleared to black.
LobeLight blackLobe(gpu::PassList& f, const RaySurfaces& from, bool countSteps);

/// Binds a lobe's images as outputs of a pass that includes resolve_ray.glsl. firstRay: of its batch.
gpu::ComputePass& bindMeans(gpu::PassList& f, gpu::ComputePass& pass, const LobeLight& light, uint32_t firstRay);

/// Binds what ray_origin.glsl reads.
gpu::ComputePass& bindRayOrigins(gpu::PassList& f, gpu::ComputePass& pass, const Rays& rays);

/// Adds what the batch has hit so far to LobeLight::hits. Only sources with a certain hit may have answered.
void sumHits(gpu::PassList& f, const LobeLight& light, const Rays& rays);

/// Adds the batch to the lobe's images, weighted by 1 over the pixel's ray count.
void resolveRays(gpu::PassList& f, const LobeLight& light, const Rays& rays);

}  // namespace reflet
#endif

#endif
