// Records direct light.
#include "render/direct/direct.h"

#include "device/frame.h"
#include "gpu/context.h"

namespace reflet {

gpu::Texture makeGgxTable(gpu::Frame& f) {
    constexpr uint32_t side = 32;  // ggxTableSize in ggx.glsl
    gpu::Texture table(
        f.context(),
        {VK_FORMAT_R16G16_SFLOAT, uvec2(side), 1, 1, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT},
        "ggx_table");
    f.begin();
    f.compute("ggx_table", "ggx_table.comp").write("table", table.image()).dispatch(uvec2(side));
    f.submit();
    f.wait();
    return table;
}

gpu::Image directLight(gpu::Recorder& f, const GBuffer& g, const LightVisibility& visibility, gpu::Image ggxTable,
                       const DirectParams& params, const DirectLights& lights) {
    const gpu::Image direct = f.image("direct", VK_FORMAT_R16G16B16A16_SFLOAT, g.depth.size);
    // Always bound, but not read if no lamp casts a shadow.
    const gpu::Image lampVisibility =
        visibility.lamps ? visibility.lamps
                         : f.image("no_lamp_visibility", VK_FORMAT_R8G8B8A8_UNORM, uvec2(1), 1, /*array=*/true);
    const VkSampler linear = f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR});
    gpu::Pass pass = f.compute("direct", "direct.comp");
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
        .constant("anyLamps", lights.lamps.count > 0 ? 1U : 0U)
        .params(params)
        .params(lights.lamps, "lampBlock")
        .dispatch(direct.size);
    return direct;
}

}  // namespace reflet
