// Light that a host has itself, as sources of rays: probes, images of light, planar views.
#pragma once

#include "effects/lobe/answer_image.h"
#include "effects/probe/answer_probes.h"
#include "effects/probe/import_probes.h"
#include "lighting/indirect.h"

#include <vector>

namespace reflet::lighting {

/// What a host has for one lobe, behind the screen.
struct HostLight {
    LobeImage image;   ///< asked first; its image may be none
    ProbeMaps probes;  ///< may be none
    std::vector<PlanarView> mirrors;
    bool mirrorsFirst = true;
};

/// Copies what it needs; `mirrors` of the result refers to `light`.
RaySources sourcesOf(const HostLight& light);

/// A planar view of a host: its images, as importSurfaces and importLight take them.
struct HostPlanarView {
    gpu::Image color;
    gpu::Image depth;
    bool reversed = true;
    ViewParams view{};
    vec4 plane{0.0F};  ///< of MirrorParams
    float tolerance = 0.0F;
};

/// The view as rays march through it.
PlanarView importPlanarView(gpu::PassList& f, const LightingSettings& settings, const HostPlanarView& host,
                            float maxRadiance);

using reflet::importProbes;

}  // namespace reflet::lighting
