// Records lists of rays, and the averaging of their results into pixels.
#include "effects/lobe/rays.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>

namespace reflet {

uint32_t raysPerBatch(gpu::Recorder& f, uvec2 size, uint32_t most) {
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

gpu::BufferView makeRayList(gpu::Recorder& f, const Rays& rays) {
    const uvec2 size = rays.direction.size;
    const VkDeviceSize items = VkDeviceSize(size.x) * size.y * rays.direction.layers;
    const gpu::BufferView list = rays.scratch->buffer(rayListHeader + items * sizeof(RayItem));
    constexpr uint32_t empty[] = {0, 1, 1, 0};
    f.update(list, std::as_bytes(std::span(empty)));
    return list;
}

LobeLight lobeImages(gpu::Recorder& f, LobeLightStore& own, const RaySurfaces& from, bool countSteps) {
    const uvec2 size = from.g.depth.size;
    LobeLight light{.from = from,
                    .radiance = own.radiance.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, size),
                    .source = own.source.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, size),
                    .steps = {},
                    .tiles = {},
                    .imageMotion = {},
                    .directional = {}};
    if (countSteps) {
        light.steps = own.steps.storage(f, VK_FORMAT_R32_SFLOAT, size);
    }
    return light;
}

LobeLight blackLobe(gpu::Recorder& f, LobeLightStore& own, const RaySurfaces& from, bool countSteps) {
    LobeLight light = lobeImages(f, own, from, countSteps);
    light.dark = true;
    f.clear(light.radiance);
    f.clear(light.source);
    if (countSteps) {
        f.clear(light.steps);
    }
    return light;
}

gpu::Image directionalImage(gpu::Recorder& f, LobeLightStore& own, const Rays& rays) {
    return rays.directional ? own.directional.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, rays.from.g.depth.size)
                            : gpu::Image{};
}

gpu::Pass& bindMeans(gpu::Recorder& f, gpu::Pass& pass, const LobeLight& light, uint32_t firstRay) {
    return pass.constant("hasDirectional", light.directional ? 1U : 0U)
        .constant("adds", firstRay > 0 ? 1U : 0U)
        .write("radiance", light.radiance)
        .write("meanSource", light.source)
        .write("meanSteps", light.steps ? light.steps : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .write("directional", light.directional ? light.directional : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT));
}

gpu::Pass& bindRayOrigins(gpu::Recorder& f, gpu::Pass& pass, const Rays& rays) {
    const gpu::Image& origins = rays.from.origins;
    return pass.constant("startsElsewhere", origins ? 1U : 0U)
        .read("origins", origins ? origins : f.placeholder(VK_FORMAT_R32G32B32A32_SFLOAT, gpu::ViewKind::array));
}

LobeLight resolveRays(gpu::Recorder& f, LobeLightStore& own, const Rays& rays) {
    const uvec2 size = rays.direction.size;
    LobeLight light = lobeImages(f, own, rays.from, rays.countSteps);
    light.tiles = rays.tiles;
    light.directional = directionalImage(f, own, rays);
    gpu::Pass pass = f.compute("resolve_rays", "resolve_rays.comp");
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
    return light;
}

}  // namespace reflet
