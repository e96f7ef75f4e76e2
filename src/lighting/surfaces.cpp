// Records what stages derive from surfaces alone.
#include "lighting/surfaces.h"

#include "effects/direct/direct.h"
#include "effects/pyramid/pyramid.h"
#include "lighting/settings.h"

#include <algorithm>

namespace reflet::lighting {

namespace {

// Half of the frames at rest: the first of them have less light, as it takes a frame for each bounce, and a mean of all
// would keep their error as 1/n. In this one it falls as 1/n², and noise is 15 % above that of the mean of all.
void growHistories(LightingSettings& settings, uint32_t rest, float scale) {
    constexpr uint32_t longest = 2048;  // half floats, which hold the lengths, have all integers up to here
    const uint32_t frames = std::min(rest / 2, longest);
    const auto grow = [](uint32_t& history, uint32_t to) { history = history > 0 ? std::max(history, to) : 0; };
    grow(settings.denoise.history, frames);
    grow(settings.shadow.history, frames);
    // Pixels of an upscaled picture count the samples that they have had.
    grow(settings.temporal.frames, static_cast<uint32_t>(static_cast<float>(frames) * scale * scale));
    if (rest >= framesUntilSettled) {
        settings.denoise.clip = 0.0F;
        settings.temporal.clip = 0.0F;
    }
}

void shrinkHistories(LightingSettings& settings, float changed) {
    const float frames = std::max((1.0F - changed) / changed, 1.0F);
    const auto shrink = [&](uint32_t& history, float to) {
        history = std::min(history, static_cast<uint32_t>(std::min(to, 4096.0F)));
    };
    shrink(settings.denoise.history, frames);
    shrink(settings.shadow.history, frames);
    // It sees direct light change by itself, and antialiases.
    constexpr float fewest = 4.0F;
    shrink(settings.temporal.frames, std::max(frames, fewest));
    shrink(settings.temporal.framesInMotion, std::max(frames, fewest));
}

}  // namespace

bool tracesRays(const LightingSettings& settings) {
    return settings.diffuse.rays > 0 || settings.specular.rays > 0;
}

void countRenderedPixels(LightingSettings& settings, float renderedHeight, float outputHeight) {
    settings.denoise.radius *= renderedHeight / outputHeight;
}

void fitHistories(LightingSettings& settings, const Change& change, float scale) {
    growHistories(settings, change.rest, scale);
    if (change.light > 0.0F) {
        shrinkHistories(settings, change.light);
    }
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
