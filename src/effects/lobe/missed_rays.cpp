// Records the two ends of a host's own source of rays.
#include "effects/lobe/missed_rays.h"

#include "base/error.h"
#include "gpu/context.h"

namespace reflet {

namespace {

void keepRays(gpu::PassList& f, const BegunLobe& begun) {
    const Rays& rays = begun.rays;
    const GBuffer& g = begun.plan.from.g;
    for (const gpu::Image& image :
         {g.depth, g.normal, g.geometricNormal, g.baseColor, g.material, g.motion, g.reflectance, g.layers,
          begun.plan.tiles.tiles, begun.plan.imageMotion, begun.plan.from.ambientOcclusion, rays.direction, rays.answer,
          rays.source, rays.turning, rays.steps}) {
        f.keep(image);
    }
    f.keep(begun.plan.tiles.list);
    f.keep(rays.waiting);
}

}  // namespace

MissedRays listMissed(gpu::PassList& f, const BegunLobe& begun) {
    const Rays& rays = begun.rays;
    const uvec2 size = rays.direction.size;
    const VkDeviceSize capacity = VkDeviceSize(size.x) * size.y * rays.direction.layers;
    const VkDeviceSize bytes = rayListHeader + capacity * sizeof(MissedRay);
    const VkDeviceSize most = f.context().limits().maxStorageBufferRange;
    if (bytes > most) {
        const char* name = rays.lobe == lobeDiffuse ? "diffuse" : "specular";
        failUsage(
            "{0}.rays: {1} rays for each of {2}x{3} pixels take a buffer of {4} bytes, and this device binds {5}; "
            "set fewer, or a larger {0}.downsample",
            name, rays.direction.layers, size.x, size.y, bytes, most);
    }
    const MissedRays missed{f.buffer("missed_rays", bytes), f.buffer("host_answers", capacity * sizeof(HostAnswer)),
                            static_cast<uint32_t>(capacity)};
    constexpr uint32_t empty[] = {0, 1, 1, 0};
    f.update(missed.rays, std::as_bytes(std::span(empty)));
    gpu::ComputePass pass = f.compute("list_missed", "list_missed.comp");
    bindRayOrigins(f, pass, rays)
        .constant("lobe", rays.lobe)
        .read("ownDepth", rays.from.g.depth)
        .read("ownGeometricNormal", rays.from.g.geometricNormal)
        .read("ownMaterial", rays.from.g.material)
        .read("direction", rays.direction)
        .read("waiting", rays.waiting)
        .write("rays", missed.rays)
        .write("answers", missed.answers)
        .params(ListMissedParams{rays.from.view, rays.from.scale, blockPixelOffset(rays.from.scale)})
        .dispatchIndirect(rays.waiting, 0);
    f.keep(missed.rays);
    f.keep(missed.answers);
    keepRays(f, begun);
    return missed;
}

void takeAnswers(gpu::PassList& f, Rays& rays, gpu::BufferView answers) {
    const gpu::BufferView missed = makeRayList(f, rays);
    f.compute("take_answers", "take_answers.comp")
        .read("answers", answers)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("missed", missed)
        .dispatchIndirect(rays.waiting, 0);
    rays.waiting = missed;
}

void releaseMissed(gpu::PassList& f, const BegunLobe& begun, const MissedRays& missed) {
    const Rays& rays = begun.rays;
    for (const gpu::Image& image : {rays.direction, rays.answer, rays.source, rays.turning}) {
        f.release(image);
    }
    for (const gpu::BufferView& buffer : {rays.waiting, missed.rays, missed.answers}) {
        f.release(buffer);
    }
}

}  // namespace reflet
