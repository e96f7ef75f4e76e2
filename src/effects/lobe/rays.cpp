// Records both ends of the chain: ray generation, and averaging of results into pixels.
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

gpu::BufferView makeRayList(gpu::Recorder& f, const Rays& rays) {
    const uvec2 size = rays.direction.size;
    const VkDeviceSize items = VkDeviceSize(size.x) * size.y * rays.direction.layers;
    const gpu::BufferView list = rays.scratch->buffer(rayListHeader + items * sizeof(RayItem));
    constexpr uint32_t empty[] = {0, 1, 1, 0};
    f.update(list, std::as_bytes(std::span(empty)));
    return list;
}

Rays generateRays(gpu::Recorder& f, gpu::Scratch& scratch, const RaySurfaces& from, const RayTables& tables,
                  uint32_t lobe, GenerateRaysParams params, bool countSteps) {
    const GBuffer& g = from.g;
    const uvec2 size = g.depth.size;
    params.view = from.view;
    const uint32_t layers = params.rayCount;
    Rays rays{.from = from,
              .tiles = tables.tiles,
              .direction = scratch.storage(VK_FORMAT_R32G32_UINT, size, layers, true),
              .answer = scratch.storage(VK_FORMAT_R16G16B16A16_SFLOAT, size, layers, true),
              .source = scratch.storage(VK_FORMAT_R8G8B8A8_UNORM, size, layers, true),
              .steps = countSteps ? scratch.storage(VK_FORMAT_R32_SFLOAT, size, layers, true)
                                  : f.placeholder(VK_FORMAT_R32_SFLOAT, /*array=*/true),
              .imageMotion = {},
              .waiting = {},
              .scratch = &scratch,
              .firstRay = params.firstRay,
              .count = params.rayCount,
              .lobe = lobe,
              .countSteps = countSteps,
              .directional = false};
    if (countSteps) {
        f.clear(rays.steps);  // pixels without rays have 0 steps
    }
    rays.waiting = makeRayList(f, rays);
    gpu::Pass pass = f.compute("generate_rays", "generate_rays.comp");
    bindSurfaces(f, pass, g)
        .constant("lobe", lobe)
        .constant("noise", static_cast<uint32_t>(tables.noise))
        .constant("distribution", static_cast<uint32_t>(params.diffuse.distribution))
        .constant("adaptive", tables.tiles.meanRays > 0 ? 1U : 0U)
        .read("depth", g.depth)
        .read("normal", g.normal)
        .read("geometricNormal", g.geometricNormal)
        .read("material", g.material)
        .read("baseColor", g.baseColor)
        .read("ggxTable", tables.ggx, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .read("blueNoise", tables.blueNoise)
        .read("tiles", tables.tiles.tiles)
        .read("list", tables.tiles.list)
        .write("direction", rays.direction)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("missed", rays.waiting)
        .params(params)
        .dispatchIndirect(tables.tiles.list, 0);
    return rays;
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
    return rays.directional ? own.directional.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, rays.direction.size)
                            : gpu::Image{};
}

LobeLight resolveRays(gpu::Recorder& f, LobeLightStore& own, const Rays& rays) {
    const uvec2 size = rays.direction.size;
    LobeLight light = lobeImages(f, own, rays.from, rays.countSteps);
    light.tiles = rays.tiles;
    light.directional = directionalImage(f, own, rays);
    f.compute("resolve_rays", "resolve_rays.comp")
        .constant("countSteps", rays.countSteps ? 1U : 0U)
        .constant("hasDirectional", light.directional ? 1U : 0U)
        .constant("adaptive", rays.tiles.meanRays > 0 ? 1U : 0U)
        .read("tiles", rays.tiles.tiles)
        .read("direction", rays.direction)
        .read("answer", rays.answer)
        .read("raySource", rays.source)
        .read("raySteps", rays.steps)
        .write("radiance", light.radiance)
        .write("source", light.source)
        .write("steps", light.steps ? light.steps : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .read("normal", rays.from.g.normal)
        .write("directional", light.directional ? light.directional : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT))
        .params(ResolveRaysParams{rays.firstRay, rays.count, rays.from.view.frame, size})
        .dispatch(size);
    return light;
}

}  // namespace reflet
