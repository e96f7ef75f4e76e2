// Records direct light with ray-traced shadows.
#include "renderer/trace_scene/direct_rays.h"

#include "gpu/context.h"

namespace reflet {

DirectRays directByRays(gpu::PassList& f, const GBuffer& g, const DirectRaysInputs& in,
                        const DirectRaysParams& params) {
    const uvec2 size = g.depth.size;
    const DirectRays out{.direct = f.image("direct", VK_FORMAT_R16G16B16A16_SFLOAT, size),
                         .sunVisibility = f.image("sun_visibility", VK_FORMAT_R8_UNORM, size)};
    gpu::ComputePass pass = f.compute("direct_rays", in.scene.rays.shader("direct_rays"));
    in.scene.rays.bind(pass);
    in.scene.surfaces.bind(pass);
    bindEnvironment(pass, in.environment);
    bindSurfaces(f, pass, g);
    pass.constant("anyEmitters", anyEmitters(in.lamps) ? 1U : 0U)
        .constant("anyReflected", anyReflected(in.lamps) ? 1U : 0U)
        .read("depth", g.depth)
        .read("normal", g.normal)
        .read("geometricNormal", g.geometricNormal)
        .read("baseColor", g.baseColor)
        .read("material", g.material)
        .read("emissive", g.emissive)
        .read("ggxTable", in.ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .write("direct", out.direct)
        .write("sunVisibility", out.sunVisibility)
        .params(params)
        .params(in.lamps, "lampBlock")
        .dispatch(size);
    return out;
}

}  // namespace reflet
