// Records the import of a host's images.
#include "effects/import/import.h"

#include <iterator>

namespace reflet {

namespace {

void setOrigins(const HostSurfaces& host, ImportParams& params) {
    const gpu::Image images[] = {host.depth,     host.normal,  host.geometricNormal, host.roughness, host.metallic,
                                 host.baseColor, host.f0,      host.motion,          host.backDepth, host.excluded,
                                 host.unlit,     host.reactive};
    static_assert(std::size(images) == hostImageReactive + 1);
    for (int i = 0; i < int(std::size(images)); ++i) {
        const uvec2 origin = images[i] ? images[i].state->origin : uvec2(0);
        params.origins[i] = origin.x | origin.y << 16U;
    }
}

}  // namespace

ImportedSurfaces importSurfaces(gpu::PassList& f, const HostSurfaces& host, ImportParams params) {
    const uvec2 size = host.depth.size;
    ImportedSurfaces out;
    const gpu::Image placeholder = f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT);
    const auto given = [&](gpu::Image image) { return image ? image : placeholder; };
    const auto has = [](gpu::Image image) { return image ? 1U : 0U; };
    GBuffer& g = out.g;
    g.depth = f.image("depth", VK_FORMAT_R32_SFLOAT, size);
    g.normal = f.image("normal", VK_FORMAT_R32_UINT, size);
    g.geometricNormal = f.image("geometric_normal", VK_FORMAT_R32_UINT, size);
    g.baseColor = f.image("base_color", VK_FORMAT_A2B10G10R10_UNORM_PACK32, size);
    g.material = f.image("material", VK_FORMAT_R8G8B8A8_UNORM, size);
    g.motion = f.image("motion", VK_FORMAT_R16G16B16A16_SFLOAT, size);
    if (host.f0) {
        g.reflectance = f.image("reflectance", VK_FORMAT_R16G16B16A16_SFLOAT, size);
        g.features = materialFeatureReflectance;
    }
    if (host.backDepth) {
        out.backDepth = f.image("back_depth", VK_FORMAT_R32_SFLOAT, size);
    }
    if (host.excluded) {
        out.shownDepth = f.image("shown_depth", VK_FORMAT_R32_SFLOAT, size);
    }
    if (host.reactive) {
        out.reactive = f.image("reactive", VK_FORMAT_R8_UNORM, size);
    }
    if (host.unlit) {
        g.features |= materialFeatureUnlit;
    }
    params.roughnessChannel = host.roughnessChannel;
    params.metallicChannel = host.metallicChannel;
    params.excludedChannel = host.excludedChannel;
    params.unlitChannel = host.unlitChannel;
    params.reactiveChannel = host.reactiveChannel;
    setOrigins(host, params);
    f.compute("import.surfaces", "import_surfaces.comp")
        .constant("reversed", host.reversed ? 1 : 0)
        .constant("normalKind", host.normalKind)
        .constant("hasGeometricNormal", has(host.geometricNormal))
        .constant("hasRoughness", has(host.roughness))
        .constant("roughnessKind", host.roughnessKind)
        .constant("hasMetallic", has(host.metallic))
        .constant("hasBaseColor", has(host.baseColor))
        .constant("baseColorIsSrgb", host.baseColorIsSrgb ? 1 : 0)
        .constant("hasF0", has(host.f0))
        .constant("hasMotion", has(host.motion))
        .constant("hasBackDepth", has(host.backDepth))
        .constant("hasExcluded", has(host.excluded))
        .constant("hasUnlit", has(host.unlit))
        .constant("hasReactive", has(host.reactive))
        .constant("hasNormal", has(host.normal))
        .read("hostDepth", host.depth)
        .read("hostNormal", given(host.normal))
        .read("hostGeometricNormal", given(host.geometricNormal))
        .read("hostRoughness", given(host.roughness))
        .read("hostMetallic", given(host.metallic))
        .read("hostBaseColor", given(host.baseColor))
        .read("hostF0", given(host.f0))
        .read("hostMotion", given(host.motion))
        .read("hostBackDepth", given(host.backDepth))
        .read("hostExcluded", given(host.excluded))
        .read("hostUnlit", given(host.unlit))
        .read("hostReactive", given(host.reactive))
        .write("depth", g.depth)
        .write("normal", g.normal)
        .write("geometricNormal", g.geometricNormal)
        .write("baseColor", g.baseColor)
        .write("material", g.material)
        .write("motion", g.motion)
        .write("reflectance", g.reflectance ? g.reflectance : placeholder)
        .write("backDepth", out.backDepth ? out.backDepth : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .write("shownDepth", out.shownDepth ? out.shownDepth : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .write("reactive", out.reactive ? out.reactive : f.placeholder(VK_FORMAT_R8_UNORM))
        .params(params)
        .dispatch(size);
    return out;
}

gpu::Image importLight(gpu::PassList& f, gpu::Image light, const LightImport& how) {
    const gpu::Image out = how.into ? how.into : f.image("light", VK_FORMAT_R16G16B16A16_SFLOAT, light.size);
    f.compute("import.light", "import_light.comp")
        .constant("keepAlpha", how.keepAlpha ? 1 : 0)
        .constant("bounded", how.limits ? 1 : 0)
        .read("hostLight", light)
        .read("limits", how.limits ? how.limits : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .write("light", out)
        .params(ImportLightParams{light.size, light.state->origin, how.maxRadiance})
        .dispatch(light.size);
    return out;
}

}  // namespace reflet
