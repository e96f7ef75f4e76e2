// Radiance cache: the light that reaches surfaces after at least one bounce, stored in world-space cells, on screen or
// off. The diffuse lobe of visible surfaces fills it, and so do the vertices of ray-traced paths. Pixels without a
// history start from it, and paths end in it, so that they bring all bounces. Shared by C++ and GLSL.
//
// A cell is a cube of the world and a range of normals, in a hash table of fixed size. It holds the mean incoming
// radiance of its surfaces, cosine-weighted: the irradiance over pi, which diffuse surfaces multiply by their albedo.
// Direct light of sun and lamps is not in it, as hits compute that exactly, so that cells need not resolve shadows.
//
// P. Gautron: Real-Time Ray-Traced Ambient Occlusion of Complex Scenes using Spatial Hashing (SIGGRAPH 2020 talk), for
// the table; T. Müller et al.: Real-time Neural Radiance Caching for Path Tracing (2021), for paths that end in what
// they have fed. docs/methods/radiance-cache.md.
#ifndef REFLET_EFFECTS_RADIANCE_CACHE_H
#define REFLET_EFFECTS_RADIANCE_CACHE_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define RADIANCE_CACHE_SETTINGS(VALUE, SWITCH, CHOICE)                                                                 \
    SWITCH(enabled, 0,                                                                                                 \
           "World-space radiance cache: diffuse light of what the camera sees or has seen is remembered. Pixels "      \
           "without a history start from it; paths of scene rays (trace_scene with light=screen) end in it, with all " \
           "bounces, instead of probes. 11 MB.")                                                                       \
    VALUE(float, cellSize, 0.03, 0.001, 0.5,                                                                           \
          "Largest side of a cell, as a share of its distance from the camera; sides are powers of two in metres. "    \
          "Smaller: sharper indirect light at hits, fewer leaks, more noise.")                                         \
    VALUE(uint, history, 16, 1, 10000,                                                                                 \
          "Frames whose light a cell remembers, about, while lights and surfaces stand still; where they change, it "  \
          "forgets faster by itself. More: less noise.")
SETTINGS(RadianceCacheSettings, RADIANCE_CACHE_SETTINGS)

// Of the table. 2^18 cells: closed rooms have about 3e4 within sight of a camera that stands still.
const uint cacheSlots = 262144;
// Slots that a key may be in.
const uint cacheProbes = 8;

struct CacheCell {
    // Of this frame: number of samples, and their sums in fixed point, so that the order of additions has no influence.
    uint count;
    uint sumRed;
    uint sumGreen;
    uint sumBlue;
    // Settled at the start of the frame.
    vec3 mean;     // incoming radiance, cosine-weighted
    float weight;  // samples that it stands for; 0: none yet
    uint idle;     // frames since its last sample
};

struct SettleCacheParams {
    float keep;      // factor on the weight of earlier samples per frame
    uint keptSlots;  // all bits, or none: the table starts empty
    float
        unitChange;  // factor on radiance in cells, which have the pre-exposure of the last update: this one over that
};

struct RememberedLightParams {
    ViewParams view;  // of the surfaces
    float cellSize;   // RadianceCacheSettings
    float unit;       // CacheBuffers
};

struct FeedCacheParams {
    ViewParams view;  // of the surfaces
    float cellSize;   // RadianceCacheSettings
    float unit;       // CacheBuffers
    uint step;        // one pixel of each square of so many pixels to each side is a sample
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"
#include "gpu/resource.h"

namespace reflet {

/// The table of a frame.
struct CacheBuffers {
    gpu::BufferView keys;   ///< uint per slot; 0: free
    gpu::BufferView cells;  ///< CacheCell per slot
    /// Paths end in a cell with the probability 1 - this / its samples; those that go on feed it.
    float samplesToEnd = 0.0F;
    float cellSize = 0.0F;  ///< RadianceCacheSettings
    float unit = 1.0F;      ///< pre-exposure of the view over that of the cells
    explicit operator bool() const { return bool(cells); }
};

/// Looks up the light that surfaces receive in the cache: LobeLight::remembered of the diffuse lobe.
gpu::Image rememberedLight(gpu::PassList& f, const CacheBuffers& cache, const RaySurfaces& from);

/// Adds the light of a diffuse lobe, as traced in this frame, to the cells of its surfaces.
void feedCache(gpu::PassList& f, const CacheBuffers& cache, const LobeLight& light);

/// A cache's persistent state. A cut need not empty it, as it does not depend on the view. Several views may feed and
/// read it, whose lists the device executes in the order in which they were made.
class RadianceCache {
public:
    /// Makes the table, if it was not made yet. Throws Error without memory.
    void allocate(gpu::Context& context);
    /// ViewParams::preExposure of the last update.
    [[nodiscard]] float exposure() const { return exposure_; }
    /// Empties it in the next update.
    void forget() { holds_ = false; }
    /// Takes over the last frame's samples, and frees cells that nothing has fed for long. Once a frame. change: share
    /// of the light that has changed since the last frame, 0 to 1. exposure: ViewParams::preExposure of the frame.
    CacheBuffers update(gpu::PassList& f, const RadianceCacheSettings& settings, float change, float exposure);

private:
    gpu::Buffer keys_;
    gpu::Buffer cells_;
    bool holds_ = false;     ///< what the tables contain is defined
    uint64_t list_ = 0;      ///< that wrote them first
    uint32_t frames_ = 0;    ///< since the table was empty
    float unrest_ = 0.0F;    ///< share of the cells' light that may be outdated, 0 to 1
    float exposure_ = 1.0F;  ///< of the last frame
};

}  // namespace reflet
#endif

#endif
