// One lobe of indirect light, diffuse or specular, for any camera's surfaces: rays, the chain of sources, denoising.
#pragma once

#include "effects/denoise/denoise.h"
#include "effects/lobe/generate_rays.h"
#include "effects/lobe/rays.h"

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
    std::span<const RaySource> sources;  ///< asked in turn, the most exact first; the environment answers what is left
    gpu::Image ambientOcclusion;         ///< of ambientOcclusion(); may be none
    gpu::History lit;                    ///< the view's lit image, for adaptive sampling; may be none
    bool randomTracing = false;          ///< a source may answer the same ray differently the next time
    bool countSteps = false;             ///< count the depth samples of each ray
    float coneShare = 0.0F;              ///< of GenerateRaysParams
};

/// Owns the histories of a lobe in one view.
struct LobeStore {
    gpu::HistoryImage adaptiveTiles{"adaptive_tiles"};
    DenoiseStore denoise;
};

/// The light of the lobe; black with no rays. own: none: without history, whatever the settings are.
LobeLight traceLobe(gpu::PassList& f, LobeStore* own, const LobeInputs& in);

}  // namespace reflet
