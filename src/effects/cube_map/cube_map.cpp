// Records the prefiltering of cube maps.
#include "effects/cube_map/cube_map.h"

#include "base/error.h"
#include "gpu/context.h"

#include <algorithm>
#include <bit>

namespace reflet {

namespace {

constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

// Irradiance varies slowly with direction: texels of 3 degrees suffice.
constexpr uint32_t irradianceSide = 32;

constexpr uint32_t projectionThreads = 64;  // cube_irradiance.comp

// Narrow lobes need fewer samples, and their levels have more texels.
constexpr uint32_t fewestSamples = 64;
constexpr uint32_t mostSamples = 512;
constexpr uint32_t fewSamples = 16;  // CubeLobeSamples

// Down to 4x4 texels per face for the widest lobe.
uint32_t lobeLevels(uint32_t side) {
    return std::max(static_cast<uint32_t>(std::bit_width(side)), 3U) - 2U;
}

}  // namespace

CubeMap::CubeMap(gpu::Context& context, uint32_t side, uint32_t cubes, const std::string& name)
    : sharp(context,
            {VK_FORMAT_R16G16B16A16_SFLOAT, uvec2(side), static_cast<uint32_t>(std::bit_width(side)), 6 * cubes, usage,
             gpu::ViewKind::cubeArray},
            name + ".sharp"),
      lobes(context,
            {VK_FORMAT_R16G16B16A16_SFLOAT, uvec2(side), lobeLevels(side), 6 * cubes, usage, gpu::ViewKind::cubeArray},
            name + ".lobes"),
      irradiance(context, {VK_FORMAT_R32G32B32A32_SFLOAT, uvec2(irradianceCoefficients, cubes), 1, 1, usage},
                 name + ".irradiance") {
    REFLET_CHECK(std::has_single_bit(side), "{} pixels", side);
}

void makeCubeMips(gpu::PassList& f, const CubeMap& map, const CubeFaces& faces) {
    for (uint32_t level = 1; level < map.sharp.info().mips; ++level) {
        const gpu::Image coarser = map.sharp.mip(level);
        f.compute("cube_mips", "cube_mips.comp")
            .read("finer", map.sharp.mip(level - 1))
            .write("coarser", coarser)
            .params(CubeMipParams{faces.first})
            .dispatch(coarser.size.x, coarser.size.y, faces.count);
    }
}

void filterCubeLobes(gpu::PassList& f, const CubeMap& map, const CubeFaces& faces, CubeLobeSamples samples) {
    const VkSampler linear = f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR, VK_SAMPLER_MIPMAP_MODE_LINEAR});
    const uint32_t levels = map.lobes.info().mips;
    for (uint32_t level = 0; level < levels; ++level) {
        const gpu::Image lobes = map.lobes.mip(level);
        const float roughness = static_cast<float>(level) / static_cast<float>(std::max(levels - 1, 1U));
        const uint32_t most = samples == CubeLobeSamples::few ? fewSamples : mostSamples;
        f.compute("cube_lobes", "cube_lobes.comp")
            .read("sharp", map.sharp.image(), linear)
            .write("lobes", lobes)
            .params(CubeLobesParams{roughness, faces.first, std::min(fewestSamples << level >> 1U, most)})
            .dispatch(lobes.size.x, lobes.size.y, faces.count);
    }
}

void projectCubeIrradiance(gpu::PassList& f, const CubeMap& map, uint32_t firstCube, uint32_t count) {
    uint32_t level = 0;
    while (map.sharp.info().size.x >> level > irradianceSide) {
        ++level;
    }
    f.compute("cube_irradiance", "cube_irradiance.comp")
        .read("sharp", map.sharp.mip(level))
        .write("irradiance", map.irradiance.image())
        .params(CubeIrradianceParams{firstCube, 0, 1.0F})
        .dispatch(projectionThreads * count);
}

void projectCube(gpu::PassList& f, const CubeProjection& in) {
    f.compute("cube_irradiance", "cube_irradiance.comp")
        .read("sharp", in.faces)
        .write("irradiance", in.irradiance)
        .params(CubeIrradianceParams{in.firstCube, 1, in.scale})
        .dispatch(projectionThreads * in.count);
}

void filterCubeMap(gpu::PassList& f, const CubeMap& map, uint32_t firstCube, uint32_t count, CubeLobeSamples samples) {
    const CubeFaces faces{6 * firstCube, 6 * count};
    makeCubeMips(f, map, faces);
    filterCubeLobes(f, map, faces, samples);
    projectCubeIrradiance(f, map, firstCube, count);
}

}  // namespace reflet
