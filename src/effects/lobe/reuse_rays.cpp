// Records ray reuse between neighbouring pixels.
#include "effects/lobe/reuse_rays.h"

namespace reflet {

void reuseRays(gpu::PassList& f, const LobeLight& light, const Rays& rays, const ViewParams& picture,
               uint32_t neighbours) {
    const GBuffer& g = rays.from.g;
    const uvec2 size = rays.direction.size;
    f.compute("reuse_rays", "reuse_rays.comp")
        .constant("lobe", rays.lobe)
        .constant("countSteps", rays.countSteps ? 1U : 0U)
        .constant("hasDirectional", light.directional ? 1U : 0U)
        .read("depth", g.depth)
        .read("normal", g.normal)
        .read("geometricNormal", g.geometricNormal)
        .read("material", g.material)
        .read("direction", rays.direction)
        .read("answer", rays.answer)
        .read("raySource", rays.source)
        .read("raySteps", rays.steps)
        .write("radiance", light.radiance)
        .write("source", light.source)
        .write("steps", light.steps ? light.steps : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .write("directional", light.directional ? light.directional : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT))
        .params(ReuseRaysParams{rays.from.view, rays.count, neighbours,
                                picture.pixelAngle * static_cast<float>(rays.from.scale)})
        .dispatch(size);
}

}  // namespace reflet
