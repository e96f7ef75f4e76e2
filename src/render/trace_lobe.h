// One lobe of indirect light: rays, the chain of sources, denoising. For every view and layer of a frame.
#pragma once

#include "render/bounce/rays.h"
#include "render/denoise/denoise.h"
#include "render/direct_view.h"
#include "render/planar/mirrors.h"
#include "render/planar/planar_view.h"
#include "render/settings.h"

#include <vector>

namespace reflet {

/// Surfaces that rays start from, and the views that these are traced in.
struct TracedView {
    ViewImages images;  ///< of the screen itself, or a layer of blended surfaces in front of it
    ScreenImages screen;
    std::vector<PlanarView> mirrors;
};

/// Owns the images of a lobe in one view.
struct LobeStore {
    RaySurfacesStore surfaces;
    gpu::KeptImage tiles{"tiles"};
    gpu::HistoryImage adaptiveTiles{"adaptive_tiles"};
    LobeLightStore light;
    DenoiseStore denoise;
};

/// The chain of both lobes: rays, then sources in order of accuracy, each for the misses of the previous one.
LobeLight traceLobe(gpu::Recorder& f, LobeStore& own, const ViewInputs& in, const Settings& settings,
                    const TracedView& seen, uint32_t lobe);

}  // namespace reflet
