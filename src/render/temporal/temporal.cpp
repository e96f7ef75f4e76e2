// Records temporal antialiasing.
#include "render/temporal/temporal.h"

namespace reflet {

namespace {

// Exactly the identity for a still camera, and for orthographic ones, which have one view direction.
mat4 skyToPrevious(const ViewParams& view) {
    const bool moves = view.eye.w != 0.0F && view.worldToClip != view.previousWorldToClip;
    return moves ? mat4(glm::dmat4(view.previousWorldToClip) * glm::dmat4(view.clipToWorld)) : mat4(1.0F);
}

}  // namespace

gpu::Image temporal(gpu::Frame& f, const GBuffer& g, gpu::Image radiance, const TemporalSettings& settings,
                    const ViewParams& view) {
    const uvec2 size = radiance.size;
    const gpu::History mean = f.history("temporal", VK_FORMAT_R16G16B16A16_SFLOAT, size);
    // Of frames at rest, deviation of the tone-compressed luma from the history: variance, and mean over the last few
    // frames.
    const gpu::History deviations = f.history("temporal_deviations", VK_FORMAT_R16G16_SFLOAT, size);
    f.compute("temporal", "temporal.comp")
        .read("radiance", radiance)
        .read("depth", g.depth)
        .read("motion", g.motion)
        .read("previousMean", mean.previous)
        .read("previousDeviations", deviations.previous)
        .write("mean", mean.next)
        .write("deviations", deviations.next)
        .params(TemporalParams{skyToPrevious(view), settings, size, view.frame, mean.valid ? 1U : 0U})
        .dispatch(size.x, (size.y + temporalColumn - 1) / temporalColumn);
    return mean.next;
}

}  // namespace reflet
