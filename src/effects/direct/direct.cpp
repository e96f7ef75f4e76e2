// Records direct light.
#include "effects/direct/direct.h"

#include "gpu/context.h"

namespace reflet {

gpu::Image ggxTable(gpu::PassList& f, gpu::KeptImage& own) {
    constexpr uint32_t side = 32;  // ggxTableSize in ggx.glsl
    const gpu::Image table = own.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, uvec2(side));
    if (!own.holds(f, side)) {
        f.compute("ggx_table", "ggx_table.comp").write("table", table).dispatch(uvec2(side));
    }
    return table;
}

DirectLight directLight(gpu::PassList& f, const GBuffer& g, const LightVisibility& visibility, gpu::Image ggxTable,
                        const DirectParams& params, const DirectLights& lights) {
    const gpu::Image direct = f.image("direct", VK_FORMAT_R16G16B16A16_SFLOAT, g.depth.size);
    const bool emitters = anyEmitters(lights.lamps);
    const bool apart = emitters || anyReflected(lights.lamps);
    const gpu::Image fromEmitters = apart ? f.image("from_emitters", direct.format, g.depth.size) : gpu::Image{};
    const bool shine = emitters && params.roughestHighlight > 0.0F;
    const gpu::Image highlights = shine ? f.image("emitter_highlights", direct.format, g.depth.size) : gpu::Image{};
    // Always bound, but not read if no lamp casts a shadow.
    const gpu::Image lampVisibility =
        visibility.lamps ? visibility.lamps : f.placeholder(VK_FORMAT_R8G8B8A8_UNORM, gpu::ViewKind::array);
    const VkSampler linear = f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR});
    gpu::ComputePass pass = f.compute("direct", "direct.comp");
    bindEnvironment(pass, lights.environment);
    bindSurfaces(f, pass, g);
    pass.read("depth", g.depth)
        .read("normal", g.normal)
        .read("baseColor", g.baseColor)
        .read("material", g.material)
        .read("emissive", g.emissive)
        .read("sunVisibility", visibility.sun)
        .read("lampVisibility", lampVisibility)
        .read("ggxTable", ggxTable, linear)
        .read("lampMasks", visibility.lampMasks)
        .write("direct", direct)
        .constant("lambertOnly", lights.lambertOnly ? 1U : 0U)
        .write("fromEmitters", apart ? fromEmitters : f.placeholder(direct.format))
        .write("emitterHighlights", shine ? highlights : f.placeholder(direct.format))
        .constant("highlights", shine ? 1U : 0U)
        .constant("anyEmitters", emitters ? 1U : 0U)
        .constant("anyReflected", anyReflected(lights.lamps) ? 1U : 0U)
        .constant("hidesSunInMirrors", lights.hidesSunInMirrors ? 1U : 0U)
        .constant("coloredSun", visibility.sun.format == VK_FORMAT_R8G8B8A8_UNORM ? 1U : 0U)
        .constant("anyLamps", lights.lamps.count > 0 ? 1U : 0U)
        .params(params)
        .params(lights.lamps, "lampBlock")
        .dispatch(direct.size);
    return {direct, fromEmitters, highlights};
}

}  // namespace reflet
