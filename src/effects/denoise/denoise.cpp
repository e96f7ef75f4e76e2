// Records the denoiser of indirect light.
#include "effects/denoise/denoise.h"

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

gpu::Image tileLimits(gpu::PassList& f, const LobeLight& light, uint32_t lobe, const DenoiseSettings& settings) {
    const uvec2 size = light.radiance.size;
    const uvec2 tiles = (size + denoiseTileSide - 1U) / denoiseTileSide;
    const gpu::Image limits = f.image("denoise.limits", VK_FORMAT_R32G32_SFLOAT, tiles);
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

Gathered gather(gpu::PassList& f, DenoiseStore* own, const LobeLight& light, uint32_t lobe, const ViewParams& picture,
                const DenoiseSettings& settings) {
    const uvec2 size = light.radiance.size;
    const DenoiseHistory past = denoiseHistory(f, own, lobe, size, settings);
    const gpu::Image limits = tileLimits(f, light, lobe, settings);
    const bool turns = static_cast<bool>(light.directional);
    const Gathered out{
        .light = f.image("denoise.gathered", lightFormat, size),
        .surface = past.surface.next,
        .moments = past.moments.next,
        .nextLight = past.light.next,
        .directional = turns ? f.image("denoise.gathered_directional", lightFormat, size) : f.placeholder(lightFormat),
        .nextDirectional = past.directional.next};
    f.compute("denoise_gather", "denoise_gather.comp")
        .constant("lobe", lobe)
        .constant("hasImageMotion", light.imageMotion ? 1U : 0U)
        .constant("meanRays", light.tiles.meanRays)
        .constant("hasDirectional", turns ? 1U : 0U)
        .constant("hasRemembered", light.remembered ? 1U : 0U)
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
        .read("remembered", light.remembered ? light.remembered : light.radiance)
        .read("previousDirectional", past.directional.previous)
        .write("nextDirectional", past.directional.next)
        .write("gatheredDirectional", out.directional)
        .params(DenoiseGatherParams{light.from.view, settings, picture.size / static_cast<float>(light.from.scale),
                                    picture.pixelAngle * static_cast<float>(light.from.scale), past.valid ? 1U : 0U})
        .dispatch(size);
    return out;
}

}  // namespace

DenoiseHistory denoiseHistory(gpu::PassList& f, DenoiseStore* own, uint32_t lobe, uvec2 size,
                              const DenoiseSettings& settings) {
    if (own == nullptr || settings.history == 0) {  // what only the next frame would read is not written
        const auto unread = [&](VkFormat format) { return gpu::History{f.placeholder(format), f.placeholder(format)}; };
        const auto written = [&](const char* name, VkFormat format) {
            return gpu::History{f.placeholder(format), f.image(name, format, size)};
        };
        return {unread(lightFormat), written("denoise.surface", surfaceFormat),
                written("denoise.moments", momentsFormat), unread(lightFormat)};
    }
    const bool turns = lobe == lobeDiffuse && settings.directional != 0;
    DenoiseHistory past{own->light.swap(f, lightFormat, size, gpu::Resample::linear),
                        own->surface.swap(f, surfaceFormat, size, gpu::Resample::depthInRed),
                        own->moments.swap(f, momentsFormat, size, gpu::Resample::linear),
                        own->directional.swap(f, lightFormat, turns ? size : uvec2(1),
                                              turns ? gpu::Resample::linear : gpu::Resample::never)};
    past.valid = past.light.valid && past.surface.valid && past.directional.valid;
    return past;
}

LobeLight denoise(gpu::PassList& f, DenoiseStore* own, const LobeLight& light, uint32_t lobe, const ViewParams& picture,
                  DenoiseSettings settings) {
    settings.history = own != nullptr ? settings.history : 0;
    const uvec2 size = light.radiance.size;
    const Gathered gathered = gather(f, own, light, lobe, picture, settings);
    const auto scale = static_cast<float>(light.from.scale);
    DenoiseBlurParams params{light.from.view, settings.radius / scale, picture.pixelAngle * scale, 0};
    gpu::Image from = gathered.light;
    gpu::Image directional = gathered.directional;
    const bool turns = static_cast<bool>(light.directional);
    for (; params.pass < settings.passes; ++params.pass) {
        const gpu::Image to = f.image("denoised", lightFormat, size);
        const gpu::Image toDirectional =
            turns ? f.image("denoised_directional", lightFormat, size) : f.placeholder(lightFormat);
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
        from = to;
        directional = toDirectional;
        params.radius *= 0.5F;
    }
    LobeLight clean = light;
    clean.radiance = from;
    clean.shift = settings.history > 0 ? picture.jitter : vec2(0.0F);
    clean.directional = turns ? directional : gpu::Image{};
    return clean;
}

}  // namespace reflet
