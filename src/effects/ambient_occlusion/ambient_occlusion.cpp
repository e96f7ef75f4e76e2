// Records ambient occlusion: slices, denoising, upsampling.
#include "effects/ambient_occlusion/ambient_occlusion.h"

#include "effects/lobe/trace_slices.h"

namespace reflet {

namespace {

// More do not help, as slices leave little noise: in four scenes the error after 2 and after 24 frames is within 5 %
// with 1, 2 or 3.
constexpr uint32_t mostBlurs = 1;

SliceTracing slicesOf(const AoInputs& in) {
    const AoSettings& s = in.settings;
    SliceTracing slices{.slice = {s.steps, s.radius, s.falloff, s.thickness},
                        .horizon = s.method == AoMethod::horizon,
                        .backDepth = in.backDepth};
    if (s.thicknessMode == AoThickness::growing) {
        slices.thickness = sliceThicknessGrowing;
    } else if (s.thicknessMode == AoThickness::secondLayer && in.backDepth) {
        slices.thickness = sliceThicknessLayer;
    }
    return slices;
}

}  // namespace

gpu::Image ambientOcclusion(gpu::PassList& f, DenoiseStore* own, const AoInputs& in) {
    const AoSettings& s = in.settings;
    if (s.method == AoMethod::none) {
        return {};
    }
    const auto scope = f.scope("ao");
    const RaySurfaces from = pickSurfaces(f, in.g, in.view, s.downsample);
    const RayGeneration generation{.from = from,
                                   .tiles = classifyTiles(f, from, lobeDiffuse, {s.slices, s.slices, 1.0F}),
                                   .ggxTable = in.ggxTable,
                                   .blueNoise = in.blueNoise,
                                   .params = {{}, {}, {}, 0, s.slices, 0.0F},
                                   .directional = true};
    LobeLight light = ambientSlices(f, generation, slicesOf(in));
    if (in.denoise.enabled != 0) {
        DenoiseSettings settings = in.denoise;
        settings.passes = std::min(settings.passes, mostBlurs);
        light = denoise(f, own, light, lobeDiffuse, in.view, settings);
    }
    const gpu::Image result = f.image("ambient_occlusion", VK_FORMAT_R16G16B16A16_SFLOAT, in.g.depth.size);
    f.compute("finish_ao", "finish_ao.comp")
        .constant("scale", from.scale)
        .constant("multiBounce", s.multiBounce)
        .read("depth", in.g.depth)
        .read("normal", in.g.normal)
        .read("geometricNormal", in.g.geometricNormal)
        .read("baseColor", in.g.baseColor)
        .read("light", light.radiance)
        .read("directional", light.directional)
        .read("lightDepth", from.scale > 1 ? from.g.depth : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .read("lightNormal", from.scale > 1 ? from.g.normal : f.placeholder(VK_FORMAT_R32_UINT))
        .write("result", result)
        .params(FinishAoParams{in.view, blockPixelOffset(from.scale), light.shift})
        .dispatch(result.size);
    return result;
}

gpu::ComputePass& bindAmbientOcclusion(gpu::PassList& f, gpu::ComputePass& pass, gpu::Image result, uint32_t scale) {
    return pass.constant("ambientOcclusionScale", result ? scale : 0U)
        .read("ambientOcclusion", result ? result : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT));
}

}  // namespace reflet
