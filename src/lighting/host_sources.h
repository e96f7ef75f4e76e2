// A host's own light as ray sources: probes, images of light, planar reflections.
#pragma once

#include "effects/lobe/answer_image.h"
#include "effects/probe/answer_probes.h"
#include "effects/probe/import_probes.h"
#include "lighting/indirect.h"

#include <vector>

namespace reflet::lighting {

/// A host's fallbacks for one lobe, for rays that miss the screen.
struct HostLight {
    LobeImage image;   ///< first fallback; its image may be none
    ProbeMaps probes;  ///< may be none
    std::vector<PlanarView> mirrors;
    bool mirrorsFirst = true;
};

/// The ray sources of `light`; their `mirrors` refer to it, everything else is copied.
RaySources sourcesOf(const HostLight& light);

/// A host's planar reflection: its images, as in importSurfaces and importLight.
struct HostPlanarView {
    gpu::Image color;
    gpu::Image depth;
    bool reversed = true;
    ViewParams view{};
    vec4 plane{0.0F};  ///< as in MirrorParams
    float tolerance = 0.0F;
};

/// Imports the planar reflection for ray marching.
PlanarView importPlanarView(gpu::PassList& f, const LightingSettings& settings, const HostPlanarView& host,
                            float maxRadiance);

using reflet::importProbes;

}  // namespace reflet::lighting
