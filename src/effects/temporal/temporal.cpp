// Records temporal antialiasing.
#include "effects/temporal/temporal.h"

namespace reflet {

namespace {

// Exactly the identity for a still camera, and for orthographic ones, which have one view direction.
mat4 skyToPrevious(const ViewParams& view) {
    const bool moves = view.eye.w != 0.0F && view.worldToClip != view.previousWorldToClip;
    return moves ? mat4(glm::dmat4(view.previousWorldToClip) * glm::dmat4(view.clipToWorld)) : mat4(1.0F);
}

}  // namespace

TemporalImages temporal(gpu::Recorder& f, TemporalStore& own, const TemporalInputs& in,
                        const TemporalSettings& settings) {
    const uvec2 size = in.radiance.size;
    const gpu::History mean = own.mean.swap(f, VK_FORMAT_R16G16B16A16_SFLOAT, size);
    // Of frames at rest, deviation of the tone-compressed luma from the history: variance, and mean over the last few
    // frames.
    const gpu::History deviations = own.deviations.swap(f, VK_FORMAT_R16G16_SFLOAT, size);
    bool valid = mean.valid;
    TemporalImages out{mean.next, {}};
    gpu::Pass pass = f.compute("temporal", in.coverage ? "temporal_coverage.comp" : "temporal.comp");
    if (in.coverage) {
        const gpu::History coverage = own.coverage.swap(f, VK_FORMAT_R32_SFLOAT, size);
        pass.read("coverage", in.coverage).read("previousCoverage", coverage.previous);
        pass.write("meanCoverage", coverage.next);
        valid = valid && coverage.valid;
        out.coverage = coverage.next;
    }
    pass.read("radiance", in.radiance)
        .read("depth", in.g.depth)
        .read("motion", in.g.motion)
        .read("previousMean", mean.previous)
        .read("previousDeviations", deviations.previous)
        .write("mean", mean.next)
        .write("deviations", deviations.next)
        .params(TemporalParams{skyToPrevious(in.view), settings, size, in.view.frame, valid ? 1U : 0U})
        .dispatch(size.x, (size.y + temporalColumn - 1) / temporalColumn);
    return out;
}

}  // namespace reflet
