// Indirect light (SSGI and SSR): two lobes of rays, diffuse and specular, and the light that they read at screen hits.
#pragma once

#include "effects/lobe/lobe.h"
#include "effects/lobe/missed_rays.h"
#include "effects/planar/planar.h"
#include "lighting/settings.h"
#include "lighting/surfaces.h"

#include <span>
#include <vector>

namespace reflet::lighting {

/// Ray sources besides the screen and the environment, which the stages know.
struct RaySources {
    std::span<const PlanarView> mirrors;  ///< planar reflections, only for reflection rays
    bool mirrorsFirst = true;             ///< mirrors are tried before the screen, not after it
    std::vector<RaySource> others;        ///< fallbacks after both, the most exact first
    size_t certainOthers = 0;             ///< number of leading `others` that find the actual hit
    bool random = false;                  ///< some `others` are stochastic: the same ray may get different results
    bool readScreen = false;              ///< some `others` read the light of the screen at their hits
};

/// The screen for ray marching, with direct light. lit: this and the last frame's image of all light; may be none.
ScreenImages screenOf(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, Surfaces& surfaces,
                      gpu::Image direct, const gpu::History& lit);

/// Whether rays march through Surfaces::pyramid.
bool marchesPyramid(const LightingSettings& settings);

/// Adds the depth pyramid to the screen of a planar view: rays from mirrors march through it even if the main view's
/// screen is not traced.
void addPyramidOfPlanarView(gpu::PassList& f, const LightingSettings& settings, Surfaces& surfaces,
                            ScreenImages& screen);
/// Whether any rays read ScreenImages::light.
bool readsScreenLight(const LightingSettings& settings, const RaySources& sources);

/// The light of one lobe, for rays that start at the surfaces. seen: the screen that they march through; it may be
/// another view's. history: none: only this frame. Reflections that would read the last frame's light are traced twice
/// in a frame without one: surfaces lit only by reflections, such as metal, would be black in mirrors.
LobeLight traceLobe(gpu::PassList& f, LobeStore* history, const ViewContext& in, const LightingSettings& settings,
                    uint32_t lobe, const Surfaces& surfaces, const ScreenImages& seen, const RaySources& sources);

/// A lobe whose screen misses are answered by a host.
struct PendingLobe {
    uint32_t lobe = lobeDiffuse;
    LightingSettings settings;  ///< for both halves
    BegunLobe begun;
    MissedRays missed;
};

/// The first half of traceLobe with a host's own source: traces rays on the screen, and collects the misses for the
/// host. Throws UsageError if the settings have no rays, or more than fit.
PendingLobe beginLobe(gpu::PassList& f, LobeStore* history, const ViewContext& in, const LightingSettings& settings,
                      uint32_t lobe, const Surfaces& surfaces, const ScreenImages& seen, const RaySources& sources);

/// The second half of traceLobe: the host has written pending.missed.answers. others: fallbacks for rays that it also
/// misses. Everything else is as for beginLobe; the passes may be in a later list of the frame. Once that is recorded,
/// releaseMissed frees the memory.
LobeLight finishLobe(gpu::PassList& f, LobeStore* history, const ViewContext& in, const Surfaces& surfaces,
                     const PendingLobe& pending, std::span<const RaySource> others);

/// Denoises a lobe that a host has traced. noisy: from importLight; radiance; alpha: hit distance [m].
LobeLight denoiseLobe(gpu::PassList& f, LobeStore& history, const ViewContext& in, const LightingSettings& settings,
                      uint32_t lobe, const Surfaces& surfaces, gpu::Image noisy);

/// Resolves rays that start in front of the screen, such as refracted ones, by the screen first, then by the sources.
void answerRays(gpu::PassList& f, Rays& rays, const ViewContext& in, const LightingSettings& settings,
                const ScreenImages& screen, const RaySources& sources);

/// The light so far, which reflections (and rays of surfaces in front) read at hits: the screen's, plus the diffuse
/// lobe's if the settings ask for it, or if they would read the last frame's light and there is none.
gpu::Image lightSoFar(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings,
                      const ScreenImages& screen, const LobeLight& diffuse);

/// Prefilters the light that reflection rays read at hits, if some of them are replaced by cones.
void prefilterLight(gpu::PassList& f, const LightingSettings& settings, ScreenImages& screen);

/// lightSoFar() and prefilterLight(), for views with nothing in front of the surfaces that rays hit: the screen that
/// rays of the lobe read. diffuse: none: it is not traced.
ScreenImages lightAtHits(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, uint32_t lobe,
                         ScreenImages screen, const LobeLight* diffuse);

/// Prefilters the screen's own light, for cones or for blurred lookups.
void prefilterOwnLight(gpu::PassList& f, ScreenImages& screen);

}  // namespace reflet::lighting
