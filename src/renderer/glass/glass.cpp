// Records the passes of a layer of glass.
#include "renderer/glass/glass.h"

#include "effects/lobe/generate_rays.h"
#include "gpu/context.h"

namespace reflet {

bool drawsGlass(const DrawList& list, const TransmissionSettings& settings, const MaterialsSettings& materials) {
    return list.glass && settings.layers > 0 && materials.lambertOnly == 0;
}

GlassSurfaces glassSurfaces(gpu::PassList& f, const DrawList& list, const ViewParams& view, const GBuffer& g,
                            const std::optional<CameraMedium>& medium) {
    const uvec2 size = g.depth.size;
    const VkClearColorValue zero{};
    const GlassSurfaces out{f.target("glass.tint", VK_FORMAT_R16G16B16A16_SFLOAT, size),
                            f.target("glass.volume", VK_FORMAT_R16G16B16A16_SFLOAT, size),
                            f.target("glass.kind", VK_FORMAT_R32_UINT, size),
                            f.target("glass.exit_depth", VK_FORMAT_D32_SFLOAT, size),
                            f.target("glass.exit_normal", VK_FORMAT_R32_UINT, size)};
    const std::optional<uint32_t> bothSides = medium ? std::optional(medium->draw) : std::nullopt;
    const GlassDrawParams params{view, medium ? medium->kind : 0U};
    const auto record = [&](Cull cull) {
        return [&list, worldToClip = view.worldToClip, pixels = vec2(view.size), cull,
                bothSides](const gpu::DrawCommands& to) {
            const DrawFilter filter{
                [](const Draw& d) { return d.glass; }, cull, true, worldToClip, pixels, 0, bothSides};
            recordDraws(to, list, filter, false);
        };
    };
    f.raster("glass_front", {"glass.vert", "glass_front.frag"})
        .constant("usedSlots", list.textureSlots)
        .constant("fromInside", medium ? 1U : 0U)
        .read("layerDepth", g.depth)
        .color("outTint", out.tint, zero)
        .color("outVolume", out.volume, zero)
        .color("outKind", out.kind, zero)
        .vertices(vertexLayout(), list.materialLayout)
        .params(params)
        .draw(record(Cull::back));
    f.raster("glass_exit", {"glass.vert", "glass_exit.frag"})
        .read("layerDepth", g.depth)
        .read("kind", out.kind)
        .color("outNormal", out.exitNormal, zero)
        .depth(out.exitDepth, 0.0F)
        .vertices(vertexLayout(), list.materialLayout)
        .params(params)
        .draw(record(Cull::front));
    return out;
}

RefractedRays refractRays(gpu::PassList& f, const GBuffer& g, const GlassSurfaces& glass, gpu::Image ggxTable,
                          const Refraction& kinds, const RefractParams& params) {
    const bool disperses = kinds.disperses;
    const uvec2 size = g.depth.size;
    RaySurfaces from{.g = g, .view = params.view};
    from.origins = f.image("glass.origins", VK_FORMAT_R32G32B32A32_SFLOAT, size, disperses ? 3 : 1, true);
    from.g.geometricNormal = f.image("glass.leaving_normal", VK_FORMAT_R32_UINT, size);
    RayGeneration generation{.from = from, .tiles = {}, .ggxTable = ggxTable};
    generation.lobe = lobeSpecular;
    generation.params.rayCount = disperses ? 3 : 1;
    RefractedRays out{raysOf(f, generation), {}, f.image("glass.share", VK_FORMAT_R16G16B16A16_SFLOAT, size)};
    out.rays.spreads = params.frosted != 0;
    gpu::ComputePass pass = f.compute("refract_rays", "refract_rays.comp");
    bindSurfaces(f, pass, g)
        .constant("disperses", disperses ? 1U : 0U)
        .constant("fromInside", kinds.fromInside ? 1U : 0U)
        .read("depth", g.depth)
        .read("normal", g.normal)
        .read("geometricNormal", g.geometricNormal)
        .read("material", g.material)
        .read("tint", glass.tint)
        .read("volume", glass.volume)
        .read("kind", glass.kind)
        .read("exitDepth", glass.exitDepth)
        .read("exitNormal", glass.exitNormal)
        .read("ggxTable", ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .write("origins", from.origins)
        .write("leavingNormal", from.g.geometricNormal)
        .write("share", out.share)
        .write("direction", out.rays.direction)
        .write("answer", out.rays.answer)
        .write("source", out.rays.source)
        .write("missed", out.rays.waiting)
        .params(params)
        .dispatch(size);
    return out;
}

RefractedRays raysToGlass(gpu::PassList& f, const GBuffer& g, const GlassSurfaces& glass, const ViewParams& view) {
    const uvec2 size = g.depth.size;
    RayGeneration generation{.from = {.g = g, .view = view}, .tiles = {}, .ggxTable = {}};
    generation.lobe = lobeSpecular;
    generation.params.rayCount = 1;
    RefractedRays out{raysOf(f, generation), {}, f.image("glass.share", VK_FORMAT_R16G16B16A16_SFLOAT, size)};
    out.rays.ofView = true;
    f.compute("rays_to_glass", "rays_to_glass.comp")
        .read("depth", g.depth)
        .read("tint", glass.tint)
        .write("share", out.share)
        .write("direction", out.rays.direction)
        .write("answer", out.rays.answer)
        .write("source", out.rays.source)
        .write("missed", out.rays.waiting)
        .params(view)
        .dispatch(size);
    return out;
}

gpu::Image answersOf(gpu::PassList& f, const Rays& rays) {
    const uvec2 size = rays.from.g.depth.size;
    const gpu::Image light = f.image("glass.answers", VK_FORMAT_R16G16B16A16_SFLOAT, size);
    f.compute("glass_answers", "glass_answers.comp")
        .read("answer", rays.answer)
        .write("light", light)
        .params(GlassOverParams{size})
        .dispatch(size);
    return light;
}

void glassOver(gpu::PassList& f, const GBuffer& g, gpu::Image layer, const RefractedRays* transmitted,
               gpu::Image behind, gpu::Image over) {
    f.compute("glass_over", "glass_over.comp")
        .constant("transmits", transmitted != nullptr ? 1U : 0U)
        .constant("disperses", transmitted != nullptr && transmitted->rays.count > 1 ? 1U : 0U)
        .constant("denoises", transmitted != nullptr && transmitted->denoised ? 1U : 0U)
        .read("depth", g.depth)
        .read("motion", g.motion)
        .read("material", g.material)
        .read("denoised", transmitted != nullptr && transmitted->denoised ? transmitted->denoised : behind)
        .read("layer", layer)
        .read("behind", behind)
        .read("share", transmitted != nullptr ? transmitted->share : behind)
        .read("answer", transmitted != nullptr ? transmitted->rays.answer
                                               : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT, gpu::ViewKind::array))
        .write("over", over)
        .params(GlassOverParams{over.size})
        .dispatch(over.size);
}

}  // namespace reflet
