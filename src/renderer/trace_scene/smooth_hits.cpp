// Records the smoothing of light at hits.
#include "renderer/trace_scene/smooth_hits.h"

namespace reflet {

SplitHits splitHits(gpu::PassList& f, const Rays& rays, bool splits) {
    const uvec2 size = splits ? rays.answer.size : uvec2(1);
    const uint32_t layers = splits ? rays.answer.layers : 1;
    const SplitHits hits{f.image("hits.light", VK_FORMAT_R16G16B16A16_SFLOAT, size, layers, true),
                         f.image("hits.factor", VK_FORMAT_R16G16B16A16_SFLOAT, size, layers, true),
                         f.image("hits.normal", VK_FORMAT_R32_UINT, size, layers, true)};
    if (splits) {
        f.clear(hits.light);
    }
    return hits;
}

void smoothHits(gpu::PassList& f, const Rays& rays, const SplitHits& hits, float radius) {
    f.compute("smooth_hits", "smooth_hits.comp")
        .read("hitLight", hits.light)
        .read("hitFactor", hits.factor)
        .read("hitNormal", hits.normal)
        .write("answer", rays.answer)
        .params(SmoothHitsParams{rays.answer.size, radius, rays.from.view.frame})
        .dispatch(rays.answer.size.x, rays.answer.size.y, rays.count);
}

}  // namespace reflet
