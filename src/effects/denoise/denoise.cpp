// Records the denoiser of indirect light.
#include "effects/denoise/denoise.h"

#include <utility>

namespace reflet {

namespace {

constexpr VkFormat lightFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat surfaceFormat = VK_FORMAT_R32G32_UINT;
constexpr VkFormat momentsFormat = VK_FORMAT_R16G16_SFLOAT;

// Outputs of the gather pass.
struct Gathered {
    gpu::Image light;
    gpu::Image surface;
    gpu::Image moments;
    gpu::Image nextLight;  // history for the next frame
    gpu::Image directional;
    gpu::Image nextDirectional;
};

gpu::Image tileLimits(gpu::Recorder& f, gpu::Scratch& scratch, const LobeLight& light, uint32_t lobe,
                      const DenoiseSettings& settings) {
    const uvec2 size = light.radiance.size;
    const uvec2 tiles = (size + denoiseTileSide - 1U) / denoiseTileSide;
    const gpu::Image limits = scratch.storage(VK_FORMAT_R32G32_SFLOAT, tiles);
    f.compute("denoise_tiles", "denoise_tiles.comp")
        .constant("lobe", lobe)
        .constant("meanRays", light.tiles.meanRays)
        .read("material", light.from.g.material)
        .read("depth", light.from.g.depth)
        .read("radiance", light.radiance)
        .write("limits", limits)
        .params(DenoiseTilesParams{size, settings.fireflies})
        .dispatch(tiles);
    return limits;
}

Gathered gather(gpu::Recorder& f, gpu::Scratch& scratch, DenoiseStore& own, const LobeLight& light, uint32_t lobe,
                const ViewParams& picture, const DenoiseSettings& settings) {
    const uvec2 size = light.radiance.size;
    const DenoiseHistory past = denoiseHistory(f, own, lobe, size, settings);
    const gpu::Image limits = tileLimits(f, scratch, light, lobe, settings);
    const auto image = [&](gpu::KeptImage& result) {  // without blur passes this is the result
        return settings.passes == 0 ? result.storage(f, lightFormat, size) : scratch.storage(lightFormat, size);
    };
    const bool turns = static_cast<bool>(light.directional);
    const Gathered out{.light = image(own.denoised),
                       .surface = past.surface.next,
                       .moments = past.moments.next,
                       .nextLight = past.light.next,
                       .directional = turns ? image(own.denoisedDirectional) : f.placeholder(lightFormat),
                       .nextDirectional = past.directional.next};
    f.compute("denoise_gather", "denoise_gather.comp")
        .constant("lobe", lobe)
        .constant("hasImageMotion", light.imageMotion ? 1U : 0U)
        .constant("meanRays", light.tiles.meanRays)
        .constant("hasDirectional", turns ? 1U : 0U)
        .read("limits", limits)
        .read("tiles", light.tiles.meanRays > 0 ? light.tiles.tiles : limits)
        .read("depth", light.from.g.depth)
        .read("normal", light.from.g.normal)
        .read("geometricNormal", light.from.g.geometricNormal)
        .read("material", light.from.g.material)
        .read("motion", light.from.g.motion)
        .read("radiance", light.radiance)
        .read("imageMotion", light.imageMotion ? light.imageMotion : f.placeholder(VK_FORMAT_R16G16_SFLOAT))
        .read("previousLight", past.light.previous)
        .read("previousSurface", past.surface.previous)
        .read("previousMoments", past.moments.previous)
        .write("nextLight", past.light.next)
        .write("surface", past.surface.next)
        .write("moments", past.moments.next)
        .write("gathered", out.light)
        .read("directional", turns ? light.directional : light.radiance)
        .read("previousDirectional", past.directional.previous)
        .write("nextDirectional", past.directional.next)
        .write("gatheredDirectional", out.directional)
        .params(DenoiseGatherParams{light.from.view, settings, picture.size / static_cast<float>(light.from.scale),
                                    past.valid ? 1U : 0U})
        .dispatch(size);
    return out;
}

}  // namespace

DenoiseHistory denoiseHistory(gpu::Recorder& f, DenoiseStore& own, uint32_t lobe, uvec2 size,
                              const DenoiseSettings& settings) {
    const uvec2 kept = settings.history > 0 ? size : uvec2(1);
    const bool turns = lobe == lobeDiffuse && settings.directional != 0;
    DenoiseHistory past{own.light.swap(f, lightFormat, kept), own.surface.swap(f, surfaceFormat, size),
                        own.moments.swap(f, momentsFormat, size),
                        own.directional.swap(f, lightFormat, turns ? kept : uvec2(1))};
    past.valid = settings.history > 0 && past.light.valid && past.surface.valid && past.directional.valid;
    return past;
}

LobeLight denoise(gpu::Recorder& f, DenoiseStore& own, const LobeLight& light, uint32_t lobe, const ViewParams& picture,
                  const DenoiseSettings& settings) {
    gpu::Scratch scratch(f);
    const uvec2 size = light.radiance.size;
    const Gathered gathered = gather(f, scratch, own, light, lobe, picture, settings);
    const auto scale = static_cast<float>(light.from.scale);
    DenoiseBlurParams params{light.from.view, settings.radius / scale, picture.pixelAngle * scale, 0};
    gpu::Image from = gathered.light;
    gpu::Image directional = gathered.directional;
    const bool turns = static_cast<bool>(light.directional);
    gpu::Image spare;  // of an earlier pass, no longer read
    gpu::Image spareDirectional;
    for (; params.pass < settings.passes; ++params.pass) {
        const bool last = params.pass + 1 == settings.passes;
        const auto image = [&](gpu::KeptImage& result, gpu::Image free) {
            return last ? result.storage(f, lightFormat, size) : free ? free : scratch.storage(lightFormat, size);
        };
        const gpu::Image to = image(own.denoised, spare);
        const gpu::Image toDirectional =
            turns ? image(own.denoisedDirectional, spareDirectional) : f.placeholder(lightFormat);
        f.compute("denoise_blur", "denoise_blur.comp")
            .constant("lobe", lobe)
            .constant("feedsBack", params.pass == 0 && settings.history > 0 ? 1U : 0U)
            .constant("hasDirectional", turns ? 1U : 0U)
            .read("from", from)
            .read("surface", gathered.surface)
            .read("moments", gathered.moments)
            .read("geometricNormal", light.from.g.geometricNormal)
            .write("nextLight", gathered.nextLight)
            .write("blurred", to)
            .read("directional", turns ? directional : from)
            .write("nextDirectional", gathered.nextDirectional)
            .write("blurredDirectional", toDirectional)
            .params(params)
            .dispatch(size);
        spare = std::exchange(from, to);
        spareDirectional = std::exchange(directional, toDirectional);
        params.radius *= 0.5F;
    }
    LobeLight clean = light;
    clean.radiance = from;
    clean.directional = turns ? directional : gpu::Image{};
    return clean;
}

}  // namespace reflet
