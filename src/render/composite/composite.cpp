// Records the composite.
#include "render/composite/composite.h"

#include "gpu/device.h"

namespace reflet {

Composite composite(gpu::Frame& f, const GBuffer& g, gpu::Image direct, const LobeLight& diffuse,
                    const LobeLight& specular, gpu::Image ggxTable, gpu::Image lit, CompositeParams params) {
    constexpr VkFormat radiance = VK_FORMAT_R16G16B16A16_SFLOAT;
    const uvec2 size = g.depth.size;
    const Composite result{.indirectDiffuse = f.image("indirect_diffuse", radiance, size),
                           .indirectSpecular = f.image("indirect_specular", radiance, size),
                           .lit = lit};
    params.diffusePlace = placeInBlock(diffuse.from.scale);
    params.specularPlace = placeInBlock(specular.from.scale);
    f.compute("composite", "composite.comp")
        .constant("diffuseScale", diffuse.from.scale)
        .constant("specularScale", specular.from.scale)
        .read("depth", g.depth)
        .read("normal", g.normal)
        .read("baseColor", g.baseColor)
        .read("material", g.material)
        .read("ggxTable", ggxTable, f.device().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .read("geometricNormal", g.geometricNormal)
        .read("diffuseDepth", diffuse.from.g.depth)
        .read("diffuseNormal", diffuse.from.g.normal)
        .read("specularDepth", specular.from.g.depth)
        .read("specularNormal", specular.from.g.normal)
        .read("direct", direct)
        .read("diffuse", diffuse.radiance)
        .read("specular", specular.radiance)
        .write("indirectDiffuse", result.indirectDiffuse)
        .write("indirectSpecular", result.indirectSpecular)
        .write("lit", result.lit)
        .params(params)
        .dispatch(size);
    return result;
}

}  // namespace reflet
