// One lobe of indirect light, diffuse or specular, for any camera's surfaces: rays, the chain of sources, denoising.
#pragma once

#include "effects/denoise/denoise.h"
#include "effects/lobe/generate_rays.h"
#include "effects/lobe/rays.h"
#include "effects/radiance_cache/radiance_cache.h"

#include <span>

namespace reflet {

struct LobeInputs {
    uint32_t lobe = lobeDiffuse;
    const GBuffer& g;        ///< surfaces that rays start from
    const ViewParams& view;  ///< of `g`
    LobeSettings settings;
    DiffuseSettings diffuse;    ///< read for the diffuse lobe
    SpecularSettings specular;  ///< read for the specular lobe
    DenoiseSettings denoise;
    EnvironmentSettings environmentSettings;
    const EnvironmentLight& environment;
    gpu::Image ggxTable;                 ///< of ggxTable
    gpu::BufferView blueNoise;           ///< noise/blue_noise.h
    ScreenSource screen;                 ///< asked first; may be none
    std::span<const RaySource> sources;  ///< asked in turn after it, the most exact first: by beginLobe
    std::span<const RaySource> others;   ///< asked after these, by finishLobe; the environment answers what is left
    CacheBuffers cache;                  ///< of the diffuse lobe; may be none
    gpu::Image ambientOcclusion;         ///< of ambientOcclusion(); may be none
    gpu::History lit;                    ///< the view's lit image, for adaptive sampling; may be none
    bool randomTracing = false;          ///< a source may answer the same ray differently the next time
    bool followsImages = false;          ///< LobeLight::imageMotion is wanted; the denoiser's history asks for it, too
    bool countSteps = false;             ///< count the depth samples of each ray
    bool countHits = false;              ///< LobeLight::hits is wanted
    size_t certainOthers = 0;            ///< how many of `others`, at their start, find the actual hit
    float coneShare = 0.0F;              ///< of GenerateRaysParams
    float roughestHighlight = 0.0F;      ///< the same
};

/// Owns the histories of a lobe in one view.
struct LobeStore {
    gpu::HistoryImage adaptiveTiles{"adaptive_tiles"};
    DenoiseStore denoise;
};

/// How the rays of a lobe are traced.
struct LobePlan {
    RaySurfaces from;
    RayTiles tiles;
    gpu::Image imageMotion;    ///< of LobeLight
    uint32_t batch = 0;        ///< rays per pixel and batch, at most
    bool atOnce = false;       ///< one pass traces and averages: no ray is written to memory
    bool sliced = false;       ///< slices instead of rays on the screen
    bool reused = false;       ///< LobeSettings::reuse applies
    bool directional = false;  ///< LobeLight::directional is computed
};

/// A lobe whose rays wait for sources that are not available yet.
struct BegunLobe {
    LobePlan plan;
    Rays rays;  ///< all of the lobe's, in one batch
};

/// The light of the lobe; black with no rays: beginLobe and finishLobe for each batch of rays, or both in one pass.
/// own: none: without history, whatever the settings are.
LobeLight traceLobe(gpu::PassList& f, LobeStore* own, const LobeInputs& in);

/// Rays of the lobe, answered by in.screen and in.sources; in.settings.rays must not be 0. Throws UsageError if the
/// rays do not fit into one batch.
BegunLobe beginLobe(gpu::PassList& f, LobeStore* own, const LobeInputs& in);
/// Has in.others and the environment answer what is left, and resolves and denoises the rays. in: as for beginLobe, but
/// its screen and its sources are not read; the passes may be in a later list of the frame.
LobeLight finishLobe(gpu::PassList& f, LobeStore* own, const LobeInputs& in, const BegunLobe& begun);

}  // namespace reflet
