// Indirect light: two lobes of rays, diffuse and specular, and the light that these read where they hit the screen.
#pragma once

#include "effects/lobe/lobe.h"
#include "effects/lobe/missed_rays.h"
#include "effects/planar/planar.h"
#include "lighting/settings.h"
#include "lighting/surfaces.h"

#include <span>
#include <vector>

namespace reflet::lighting {

/// Sources of light for rays besides the screen and the environment, which the stages know.
struct RaySources {
    std::span<const PlanarView> mirrors;  ///< planar reflections; only reflection rays ask them
    bool mirrorsFirst = true;             ///< before the screen, not after it
    std::vector<RaySource> others;        ///< after both, the most exact first
    size_t certainOthers = 0;             ///< how many of these, at their start, find the actual hit
    bool random = false;                  ///< some of these may answer the same ray differently the next time
    bool readScreen = false;              ///< some of these read the light of the screen at their hits
};

/// The screen as rays see it, with direct light. lit: this frame's and the last one's image of all light; may be none.
ScreenImages screenOf(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, Surfaces& surfaces,
                      gpu::Image direct, const gpu::History& lit);

/// Whether rays march through Surfaces::pyramid.
bool marchesPyramid(const LightingSettings& settings);

/// Gives the screen of a planar view the pyramid: rays from mirrors march through it also if the picture's own screen
/// is not traced.
void addPyramidOfPlanarView(gpu::PassList& f, const LightingSettings& settings, Surfaces& surfaces,
                            ScreenImages& screen);
/// Whether any rays read ScreenImages::light.
bool readsScreenLight(const LightingSettings& settings, const RaySources& sources);

/// The light of one lobe, for rays that start at the surfaces. seen: the screen that they are marched through; it may
/// be another view's. history: none: this frame alone. Reflections that would read the last picture are traced twice in
/// a frame without one: what is lit by reflections alone, such as metal, would be black in mirrors.
LobeLight traceLobe(gpu::PassList& f, LobeStore* history, const ViewContext& in, const LightingSettings& settings,
                    uint32_t lobe, const Surfaces& surfaces, const ScreenImages& seen, const RaySources& sources);

/// A lobe whose rays a host answers behind the screen.
struct PendingLobe {
    uint32_t lobe = lobeDiffuse;
    LightingSettings settings;  ///< of both halves
    BegunLobe begun;
    MissedRays missed;
};

/// The first half of traceLobe with a host's own source: rays, answered by the screen, and what is left of them for the
/// host. Throws UsageError if the settings have no rays, or more than fit.
PendingLobe beginLobe(gpu::PassList& f, LobeStore* history, const ViewContext& in, const LightingSettings& settings,
                      uint32_t lobe, const Surfaces& surfaces, const ScreenImages& seen, const RaySources& sources);

/// The second half: the host has written pending.missed.answers; others: sources for what it leaves. Everything else is
/// as for beginLobe; the passes may be in a later list of the frame. Once that is recorded, releaseMissed gives the
/// memory back.
LobeLight finishLobe(gpu::PassList& f, LobeStore* history, const ViewContext& in, const Surfaces& surfaces,
                     const PendingLobe& pending, std::span<const RaySource> others);

/// A lobe that a host has traced, denoised. noisy: of importLight; radiance; alpha: hit distance [m].
LobeLight denoiseLobe(gpu::PassList& f, LobeStore& history, const ViewContext& in, const LightingSettings& settings,
                      uint32_t lobe, const Surfaces& surfaces, gpu::Image noisy);

/// Has the sources answer rays that start in front of the screen, such as refracted ones: the screen first.
void answerRays(gpu::PassList& f, Rays& rays, const ViewContext& in, const LightingSettings& settings,
                const ScreenImages& screen, const RaySources& sources);

/// All light so far, which reflections (and rays of surfaces in front) read at hits: the screen's, with the diffuse
/// lobe's if they are to read it, or would read the last picture and there is none.
gpu::Image lightSoFar(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings,
                      const ScreenImages& screen, const LobeLight& diffuse);

/// Prefilters the light that reflection rays read at hits, if cones stand for some of them.
void prefilterLight(gpu::PassList& f, const LightingSettings& settings, ScreenImages& screen);

/// Both, for views with nothing in front of the surfaces that rays hit: the screen as rays of the lobe read it.
/// diffuse: none: it is not traced.
ScreenImages lightAtHits(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, uint32_t lobe,
                         ScreenImages screen, const LobeLight* diffuse);

/// Prefilters the screen's own light, for cones or for blurred lookups.
void prefilterOwnLight(gpu::PassList& f, ScreenImages& screen);

}  // namespace reflet::lighting
