// Records the composite.
#include "effects/composite/composite.h"

#include "effects/lobe/upsample.h"
#include "gpu/context.h"

namespace reflet {

LightLayers composite(gpu::PassList& f, const CompositeInputs& in, gpu::Image lit, CompositeParams params) {
    const uvec2 size = in.g.depth.size;
    const auto layer = [&](const char* name) {
        return in.layers ? f.image(name, VK_FORMAT_R16G16B16A16_SFLOAT, size) : gpu::Image{};
    };
    const bool splits = in.layers && in.fromEmitters;
    const LightLayers result{.direct = splits ? layer("direct_alone") : in.direct,
                             .indirectDiffuse = layer("indirect_diffuse"),
                             .indirectSpecular = layer("indirect_specular"),
                             .lit = lit};
    const gpu::Image unwritten = in.layers ? lit : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT);
    params.diffuseBlockOffset = blockPixelOffset(in.diffuse.from.scale);
    params.specularBlockOffset = blockPixelOffset(in.specular.from.scale);
    params.diffuseShift = in.diffuse.shift;
    params.specularShift = in.specular.shift;
    gpu::ComputePass pass = f.compute("composite", "composite.comp");
    bindUpsampledSpecular(f, pass, in.specular);
    bindSurfaces(f, pass, in.g)
        .constant("diffuseScale", upsampledScale(in.diffuse))
        .constant("lambertOnly", in.lambertOnly ? 1U : 0U)
        .constant("layers", in.layers ? 1U : 0U)
        .constant("splits", splits ? 1U : 0U)
        .constant("bounded", in.limits ? 1U : 0U)
        .read("limits", in.limits ? in.limits : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .constant("hasDirectional", in.diffuse.directional ? 1U : 0U)
        .read("depth", in.g.depth)
        .read("normal", in.g.normal)
        .read("baseColor", in.g.baseColor)
        .read("material", in.g.material)
        .read("ggxTable", in.ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .read("geometricNormal", in.g.geometricNormal)
        .read("diffuseDepth", surfacesToUpsample(f, in.diffuse, in.diffuse.from.g.depth, VK_FORMAT_R32_SFLOAT))
        .read("diffuseNormal", surfacesToUpsample(f, in.diffuse, in.diffuse.from.g.normal, VK_FORMAT_R32_UINT))
        .read("direct", in.direct)
        .constant("highlights", splits && in.highlights ? 1U : 0U)
        .read("fromEmitters", splits ? in.fromEmitters : in.direct)
        .read("emitterHighlights", splits && in.highlights ? in.highlights : in.direct)
        .write("directAlone", splits ? result.direct : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT))
        .read("diffuse", in.diffuse.radiance)
        .read("diffuseDirectional", in.diffuse.directional ? in.diffuse.directional : in.diffuse.radiance)
        .write("indirectDiffuse", in.layers ? result.indirectDiffuse : unwritten)
        .write("indirectSpecular", in.layers ? result.indirectSpecular : unwritten)
        .write("lit", result.lit)
        .params(params)
        .dispatch(size);
    return result;
}

gpu::Image withoutDirect(gpu::PassList& f, gpu::Image lit, gpu::Image direct) {
    const gpu::Image remaining = f.image("without_direct", VK_FORMAT_R16G16B16A16_SFLOAT, lit.size);
    f.compute("without_direct", "without_direct.comp")
        .read("lit", lit)
        .read("direct", direct)
        .write("remaining", remaining)
        .dispatch(lit.size);
    return remaining;
}

}  // namespace reflet
