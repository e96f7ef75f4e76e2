// Records ray tracing as a ray source.
#include "renderer/trace_scene/trace_scene.h"

#include "gpu/context.h"
#include "renderer/trace_scene/smooth_hits.h"

namespace reflet {

void traceScene(gpu::PassList& f, Rays& rays, const TraceSceneInputs& in, uint32_t sunShadows,
                const TraceSceneParams& params) {
    const GBuffer& g = in.screen.g;
    const gpu::BufferView missed = makeRayList(f, rays);
    const bool allBounces = params.fromPrevious != 0 || in.throughGlass == glassOfView;  // in the light on the screen
    const bool reuse =
        params.settings.reuseScreen != 0 && (params.settings.light == SceneHitLight::screen || allBounces);
    const bool tellsMotion = rays.imageMotion && rays.firstRay == 0;
    const CacheBuffers cache =
        in.cache ? in.cache
                 : CacheBuffers{f.buffer("no_keys", sizeof(uint32_t)), f.buffer("no_cells", sizeof(CacheCell))};
    const bool splits = in.hitRadius >= 1.0F && rays.lobe == lobeSpecular;
    const SplitHits hits = splitHits(f, rays, splits);
    gpu::ComputePass pass = f.compute("trace_scene", in.scene.rays.shader("trace_scene"));
    bindRayOrigins(f, pass, rays);
    in.scene.rays.bind(pass);
    in.scene.surfaces.bind(pass);
    bindEnvironment(pass, in.environment);
    bindEnvironmentLobes(pass, f.context(), in.environment);
    const VkSampler linear = f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR, VK_SAMPLER_MIPMAP_MODE_LINEAR});
    pass.constant("lobe", rays.lobe)
        .constant("materialFeatures", g.features)
        .constant("sunShadows", sunShadows)
        .constant("throughGlass", in.throughGlass)
        .constant("reuseScreen", reuse ? 1U : 0U)
        .constant("tellsMotion", tellsMotion ? 1U : 0U)
        .constant("anyEmitters", anyEmitters(in.lamps) ? 1U : 0U)
        .constant("anyReflected", anyReflected(in.lamps) ? 1U : 0U)
        .constant("endsInProbes", in.probes ? 1U : 0U)
        .constant("endsInCache", in.cache ? 1U : 0U)
        .constant("splitsHits", splits ? 1U : 0U)
        .write("cacheKeys", cache.keys)
        .write("cacheCells", cache.cells)
        .read("probeLobes", in.probes ? in.probes.lobes : in.environment.lobes, linear)
        .read("probeIrradiance", in.probes ? in.probes.irradiance : in.environment.irradiance)
        .read("probeDistance", in.probes ? in.probes.distance : in.environment.lobes)
        .params(in.probes.block, "probeBlock")
        .read("ownDepth", rays.from.g.depth)
        .read("ownGeometricNormal", rays.from.g.geometricNormal)
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("material", rays.from.g.material)
        .read("motion", g.motion)
        .read("light", in.screen.light)
        .read("previousLit", in.screen.lit.previous ? in.screen.lit.previous : in.screen.light)
        .read("shadowMap", in.shadowMap ? in.shadowMap : g.depth)
        .read("ggxTable", in.ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .read("blueNoise", in.blueNoise)
        .read("direction", rays.direction)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("hitLight", hits.light)
        .write("hitFactor", hits.factor)
        .write("hitNormal", hits.normal)
        .write("imageMotion", tellsMotion ? rays.imageMotion : f.placeholder(VK_FORMAT_R16G16_SFLOAT))
        .write("missed", missed)
        .params(params)
        .params(in.lamps, "lampBlock")
        .dispatchIndirect(rays.waiting, 0);
    rays.waiting = missed;
    if (splits) {
        smoothHits(f, rays, hits, in.hitRadius);
    }
}

}  // namespace reflet
