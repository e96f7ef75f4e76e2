// Records temporal antialiasing and upscaling.
#include "effects/temporal/temporal.h"

#include "effects/to_previous.h"

namespace reflet {

namespace {

// The histories of this frame.
struct Histories {
    gpu::History mean;
    gpu::History deviations;
    gpu::History coverage;
    gpu::History seen;
    gpu::History left;
    gpu::History changes;
    bool valid = false;
};

Histories swapHistories(gpu::PassList& f, TemporalStore& own, uvec2 size, uvec2 output, bool covers) {
    // Of frames at rest, deviation of the tone-compressed luma from the history: variance, and mean over the last few
    // frames.
    Histories h{own.mean.swap(f, VK_FORMAT_R16G16B16A16_SFLOAT, output),
                own.deviations.swap(f, VK_FORMAT_R16G16_SFLOAT, output),
                {},
                own.seen.swap(f, VK_FORMAT_R16G16B16A16_SFLOAT, size, gpu::Resample::nearest),
                own.left.swap(f, VK_FORMAT_R8_UNORM, size, gpu::Resample::nearest),
                own.changes.swap(f, VK_FORMAT_R16G16B16A16_SFLOAT, size, gpu::Resample::nearest),
                false};
    h.valid = h.mean.valid && h.seen.valid && h.left.valid && h.changes.valid;
    f.clear(h.left.next);
    if (covers) {
        h.coverage = own.coverage.swap(f, VK_FORMAT_R32_SFLOAT, output);
        h.valid = h.valid && h.coverage.valid;
    }
    return h;
}

void bindHistories(gpu::ComputePass& pass, const Histories& h, const TemporalInputs& in) {
    pass.read("radiance", in.radiance)
        .read("previousMean", h.mean.previous)
        .read("previousDeviations", h.deviations.previous)
        .write("mean", h.mean.next)
        .write("deviations", h.deviations.next);
    if (in.coverage) {
        pass.read("coverage", in.coverage).read("previousCoverage", h.coverage.previous);
        pass.write("meanCoverage", h.coverage.next);
    }
}

void bindSurfaces(gpu::PassList& f, gpu::ComputePass& pass, const Histories& h, const TemporalInputs& in) {
    pass.constant("isReactive", in.reactive ? 1U : 0U)
        .constant("hasBaseColor", in.baseColor ? 1U : 0U)
        .read("reactive", in.reactive ? in.reactive : f.placeholder(VK_FORMAT_R8_UNORM))
        .read("baseColor", in.baseColor ? in.baseColor : f.placeholder(VK_FORMAT_A2B10G10R10_UNORM_PACK32));
    pass.read("previousSeen", h.seen.previous)
        .write("seen", h.seen.next)
        .read("previousLeft", h.left.previous)
        .write("left", h.left.next)
        .read("previousChanges", h.changes.previous)
        .write("changes", h.changes.next);
}

uvec2 columns(uvec2 size) {
    return {size.x, (size.y + temporalColumn - 1) / temporalColumn};
}

void upscale(gpu::PassList& f, const Histories& h, const TemporalInputs& in, const TemporalParams& params) {
    const uvec2 output = h.mean.next.size;
    const gpu::Image around = f.image("temporal.around", VK_FORMAT_R16G16B16A16_SFLOAT, params.size);
    const gpu::Image changed = f.image("temporal.changed", VK_FORMAT_R16G16B16A16_SFLOAT, params.size);
    const gpu::Image spread = f.image("temporal.spread", VK_FORMAT_R16G16B16A16_SFLOAT, params.size);
    gpu::ComputePass near =
        f.compute("temporal.around", in.coverage ? "temporal_around_coverage.comp" : "temporal_around.comp");
    gpu::ComputePass add =
        f.compute("temporal.upscale", in.coverage ? "temporal_upscale_coverage.comp" : "temporal_upscale.comp");
    if (in.coverage) {
        const gpu::Image covered = f.image("temporal.covered", VK_FORMAT_R16G16_SFLOAT, params.size);
        near.read("coverage", in.coverage).write("coveredAround", covered);
        add.read("coveredAround", covered);
    }
    bindSurfaces(f, near, h, in);
    near.read("radiance", in.radiance)
        .read("depth", in.depth)
        .read("motion", in.motion)
        .write("around", around)
        .write("spread", spread)
        .write("changed", changed)
        .params(params)
        .dispatch(columns(params.size));
    bindHistories(add, h, in);
    add.read("around", around)
        .read("spread", spread)
        .read("changed", changed)
        .params(TemporalUpscaleParams{params.settings, params.size, vec2(params.size) / vec2(output), in.jitter,
                                      params.frame, params.exposureChange})
        .dispatch(output);
}

void resolveSky(gpu::PassList& f, const Histories& h, const TemporalInputs& in, const TemporalSettings& settings) {
    gpu::ComputePass pass = f.compute("temporal.sky", "temporal_sky.comp");
    bindEnvironment(pass, *in.sky);
    pass.read("depth", in.depth)
        .write("mean", h.mean.next)
        .params(TemporalSkyParams{in.view, vec2(in.radiance.size) / vec2(h.mean.next.size), in.jitter,
                                  static_cast<float>(settings.framesInMotion)})
        .dispatch(h.mean.next.size);
}

// The history is clipped to the 3x3 pixels around. Frames that have fewer, of which each shows a large part of the
// scene by one sample, would lose all that other frames saw.
TemporalSettings fitted(TemporalSettings settings, uvec2 size) {
    settings.clip = size.x * size.y < 9U ? 0.0F : settings.clip;
    return settings;
}

}  // namespace

TemporalImages temporal(gpu::PassList& f, TemporalStore& own, const TemporalInputs& in,
                        const TemporalSettings& settings) {
    const uvec2 size = in.radiance.size;
    const uvec2 output = in.outputSize.x > 0 ? in.outputSize : size;
    const Histories h = swapHistories(f, own, size, output, static_cast<bool>(in.coverage));
    const TemporalParams params{toPreviousClip(in.view),
                                fitted(settings, size),
                                size,
                                in.jitter,
                                in.view.jitterChange,
                                in.view.frame,
                                h.valid ? 1U : 0U,
                                in.view.rest < framesThatFollow ? 1U : 0U,
                                in.sky != nullptr ? 1U : 0U,
                                f.sizes().before != f.sizes().now ? 1U : 0U,
                                in.view.exposureChange};
    if (size != output || in.mixesSizes) {
        upscale(f, h, in, params);
    } else {
        gpu::ComputePass pass = f.compute("temporal", in.coverage ? "temporal_coverage.comp" : "temporal.comp");
        bindHistories(pass, h, in);
        bindSurfaces(f, pass, h, in);
        pass.read("depth", in.depth).read("motion", in.motion).params(params).dispatch(columns(size));
    }
    if (in.sky != nullptr && movesSky(in.view)) {
        resolveSky(f, h, in, settings);
    }
    return {h.mean.next, h.coverage.next};
}

}  // namespace reflet
