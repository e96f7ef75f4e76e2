// Records lists of rays, and the averaging of their results into pixels.
#include "effects/lobe/rays.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>

namespace reflet {

uint32_t raysPerBatch(gpu::PassList& f, uvec2 size, uint32_t most) {
    const VkDeviceSize layer = VkDeviceSize(size.x) * size.y * sizeof(RayItem);
    const VkDeviceSize fit = (f.context().limits().maxStorageBufferRange - rayListHeader) / layer;
    if (fit == 0 || std::max(size.x, size.y) > maxFrameSize) {
        fail("this device cannot trace rays at {}x{} pixels; render at a smaller size", size.x, size.y);
    }
    return static_cast<uint32_t>(std::min<VkDeviceSize>(fit, most));
}

bool raysSpread(uint32_t lobe, const DiffuseSettings& diffuse, const SpecularSettings& specular) {
    return lobe == lobeDiffuse ? diffuse.distribution == RayDistribution::normal
                               : specular.roughFallback == RoughFallback::mips && specular.maxRoughness < 1.0F;
}

void clearRayList(gpu::PassList& f, gpu::BufferView list) {
    constexpr uint32_t empty[] = {0, 1, 1, 0};
    f.update(list, std::as_bytes(std::span(empty)));
}

gpu::BufferView makeRayList(gpu::PassList& f, const Rays& rays) {
    const uvec2 size = rays.direction.size;
    const VkDeviceSize items = VkDeviceSize(size.x) * size.y * rays.direction.layers;
    const gpu::BufferView list = f.buffer("rays", rayListHeader + items * sizeof(RayItem));
    clearRayList(f, list);
    return list;
}

LobeLight lobeImages(gpu::PassList& f, const RaySurfaces& from, bool countSteps, bool directional) {
    const uvec2 size = from.g.depth.size;
    LobeLight light{.from = from,
                    .radiance = f.image("radiance", VK_FORMAT_R16G16B16A16_SFLOAT, size),
                    .source = f.image("source", VK_FORMAT_R16G16B16A16_SFLOAT, size),
                    .steps = {},
                    .hits = {},
                    .tiles = {},
                    .imageMotion = {},
                    .directional = {}};
    if (directional) {
        light.directional = f.image("directional", VK_FORMAT_R16G16B16A16_SFLOAT, size);
    }
    if (countSteps) {
        light.steps = f.image("steps", VK_FORMAT_R32_SFLOAT, size);
    }
    return light;
}

LobeLight blackLobe(gpu::PassList& f, const RaySurfaces& from, bool countSteps) {
    LobeLight light = lobeImages(f, from, countSteps, false);
    light.dark = true;
    f.clear(light.radiance);
    f.clear(light.source);
    if (countSteps) {
        f.clear(light.steps);
    }
    return light;
}

gpu::ComputePass& bindMeans(gpu::PassList& f, gpu::ComputePass& pass, const LobeLight& light, uint32_t firstRay) {
    return pass.constant("hasDirectional", light.directional ? 1U : 0U)
        .constant("adds", firstRay > 0 ? 1U : 0U)
        .write("radiance", light.radiance)
        .write("meanSource", light.source)
        .write("meanSteps", light.steps ? light.steps : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .write("directional", light.directional ? light.directional : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT));
}

gpu::ComputePass& bindRayOrigins(gpu::PassList& f, gpu::ComputePass& pass, const Rays& rays) {
    const gpu::Image& origins = rays.from.origins;
    return pass.constant("startsElsewhere", origins ? 1U : 0U)
        .read("origins", origins ? origins : f.placeholder(VK_FORMAT_R32G32B32A32_SFLOAT, gpu::ViewKind::array));
}

void sumHits(gpu::PassList& f, const LobeLight& light, const Rays& rays) {
    const uvec2 size = rays.direction.size;
    f.compute("sum_hits", "sum_hits.comp")
        .constant("adds", rays.firstRay > 0 ? 1U : 0U)
        .read("tiles", rays.tiles.tiles)
        .read("answer", rays.answer)
        .read("source", rays.source)
        .write("hits", light.hits)
        .params(ResolveRaysParams{rays.firstRay, rays.count, rays.from.view.frame, size})
        .dispatch(size);
}

void resolveRays(gpu::PassList& f, const LobeLight& light, const Rays& rays) {
    const uvec2 size = rays.direction.size;
    gpu::ComputePass pass = f.compute("resolve_rays", "resolve_rays.comp");
    bindMeans(f, pass, light, rays.firstRay)
        .constant("countSteps", rays.countSteps ? 1U : 0U)
        .constant("adaptive", rays.tiles.meanRays > 0 ? 1U : 0U)
        .constant("hasTurning", rays.turning ? 1U : 0U)
        .read("tiles", rays.tiles.tiles)
        .read("direction", rays.direction)
        .read("answer", rays.answer)
        .read("source", rays.source)
        .read("steps", rays.steps)
        .read("turning",
              rays.turning ? rays.turning : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT, gpu::ViewKind::array))
        .read("normal", rays.from.g.normal)
        .params(ResolveRaysParams{rays.firstRay, rays.count, rays.from.view.frame, size})
        .dispatch(size);
}

}  // namespace reflet
