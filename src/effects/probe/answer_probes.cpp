// Records reflection probes as a ray source.
#include "effects/probe/answer_probes.h"

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "gpu/context.h"

namespace reflet {

void answerProbes(gpu::PassList& f, Rays& rays, const ProbeMaps& probes) {
    const gpu::BufferView missed = makeRayList(f, rays);
    const VkSampler trilinear =
        f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR, VK_SAMPLER_MIPMAP_MODE_LINEAR});
    gpu::ComputePass pass = f.compute("answer_probes", "answer_probes.comp");
    bindRayOrigins(f, pass, rays);
    bindAmbientOcclusion(f, pass, rays.from.ambientOcclusion, rays.from.scale)
        .constant("lobe", rays.lobe)
        .constant("spreads", rays.spreads ? 1U : 0U)
        .constant("highlights", rays.highlights ? 1U : 0U)
        .constant("parallax", static_cast<uint32_t>(probes.parallax))
        .read("depth", rays.from.g.depth)
        .read("material", rays.from.g.material)
        .read("probeLobes", rays.lobe == lobeDiffuse ? probes.diffuse : probes.lobes, trilinear)
        .read("probeMatte", probes.diffuse)
        .read("probeIrradiance", probes.irradiance)
        .read("probeDistance", probes.distance ? probes.distance : probes.lobes)
        .read("direction", rays.direction)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("missed", missed)
        .params(AnswerProbesParams{rays.from.view, probes.block, rays.firstRay})
        .dispatchIndirect(rays.waiting, 0);
    rays.waiting = missed;
}

}  // namespace reflet
