// Records what stages derive from surfaces alone.
#include "lighting/surfaces.h"

#include "effects/direct/direct.h"
#include "effects/pyramid/pyramid.h"
#include "lighting/settings.h"

namespace reflet::lighting {

bool tracesRays(const LightingSettings& settings) {
    return settings.diffuse.rays > 0 || settings.specular.rays > 0;
}

void countRenderedPixels(LightingSettings& settings, float renderedHeight, float outputHeight) {
    settings.denoise.radius *= renderedHeight / outputHeight;
}

gpu::Image depthPyramid(gpu::PassList& f, Surfaces& surfaces) {
    if (!surfaces.pyramid) {
        surfaces.pyramid = makePyramid(f, surfaces.g.depth, surfaces.backDepth);
    }
    return surfaces.pyramid;
}

gpu::Image keptDepth(gpu::PassList& f, const ViewParams& view, const DepthSettings& settings, gpu::Image depth) {
    return reflet::keptDepth(f, depth, view, settings);
}

gpu::Image ggxTable(gpu::PassList& f, gpu::KeptImage& own) {
    return reflet::ggxTable(f, own);
}

gpu::Image ambientOcclusion(gpu::PassList& f, DenoiseStore* own, const ViewContext& in,
                            const LightingSettings& settings, const Surfaces& surfaces) {
    return reflet::ambientOcclusion(f, own,
                                    {.g = surfaces.g,
                                     .view = in.view,
                                     .backDepth = surfaces.backDepth,
                                     .settings = settings.ao,
                                     .denoise = settings.denoise,
                                     .ggxTable = in.ggxTable,
                                     .blueNoise = in.blueNoise});
}

bool readsBackDepth(const LightingSettings& settings) {
    const bool occlusion =
        settings.ao.method == AoMethod::bitmask && settings.ao.thicknessMode == AoThickness::secondLayer;
    return occlusion || settings.traceScreen.thicknessMode == ThicknessMode::secondLayer;
}

}  // namespace reflet::lighting
