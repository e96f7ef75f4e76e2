// Records the import of a host's probes.
#include "effects/probe/import_probes.h"

#include "gpu/context.h"

#include <algorithm>
#include <bit>

namespace reflet {

namespace {

constexpr uint32_t irradianceSide = 16;

// With linear filtering they cover eight texels of the host to each side.
constexpr uint32_t placesOfLarger = 4;

VkSampler linearSampler(gpu::PassList& f) {
    return f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR, VK_SAMPLER_MIPMAP_MODE_LINEAR});
}

void importFaces(gpu::PassList& f, gpu::Image cube, gpu::Image faces, ImportProbeParams params) {
    params.places = cube.size.x == faces.size.x ? 1 : placesOfLarger;
    f.compute("import_probe", "import_probe.comp")
        .read("hostCube", cube, linearSampler(f))
        .write("faces", faces)
        .params(params)
        .dispatch(faces.size.x, faces.size.y, 6);
}

void makeMaps(gpu::Context& context, HostProbeStore& own, std::span<const HostProbe> probes) {
    const auto count = static_cast<uint32_t>(probes.size());
    const uint32_t side = probeSide(probes);
    if (own.map.sharp.info().size.x != side || own.map.sharp.info().layers != 6 * count) {
        own.map = CubeMap(context, side, count, "host_probes");
    }
    const bool cubes = std::ranges::any_of(probes, [](const HostProbe& p) { return static_cast<bool>(p.irradiance); });
    if (cubes && own.irradiance.sharp.info().layers != 6 * count) {
        own.irradiance = CubeMap(context, irradianceSide, count, "host_probes.irradiance");
    }
    constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    const gpu::ImageInfo distance{VK_FORMAT_R32_SFLOAT, uvec2(side), 1, 6 * count, usage, gpu::ViewKind::cubeArray};
    const bool distances =
        std::ranges::any_of(probes, [](const HostProbe& p) { return static_cast<bool>(p.distance); });
    if (distances && own.distance.info() != distance) {
        own.distance = gpu::Texture(context, distance, "host_probes.distance");
    }
    if (!distances) {
        own.distance = {};
    }
}

void writeIrradiance(gpu::PassList& f, const HostProbeStore& own, const HostProbe& probe, uint32_t cube) {
    if (probe.harmonics) {
        ImportHarmonicsParams params{{}, cube};
        std::ranges::copy(*probe.harmonics, params.coefficients);
        f.compute("import_harmonics", "import_harmonics.comp")
            .write("irradiance", own.map.irradiance.image())
            .params(params)
            .dispatch(irradianceCoefficients);
        return;
    }
    if (!probe.irradiance) {
        projectCubeIrradiance(f, own.map, cube, 1);
        return;
    }
    importFaces(f, probe.irradiance, own.irradiance.sharp.mip(0), {6 * cube, 0.0F, 0, 0});
    projectCube(f, {own.irradiance.sharp.mip(0), own.map.irradiance.image(), cube, 1, probe.irradianceScale});
}

void writeProbe(gpu::PassList& f, const HostProbeStore& own, const HostProbe& probe, uint32_t cube) {
    const CubeFaces faces{6 * cube, 6};
    const uint32_t coverage = probe.hasCoverage ? 1 : 0;
    importFaces(f, probe.radiance, own.map.sharp.mip(0), {faces.first, 0.0F, 0, coverage});
    makeCubeMips(f, own.map, faces);
    if (probe.levels > 1) {
        const uint32_t levels = own.map.lobes.info().mips;
        for (uint32_t level = 0; level < levels; ++level) {
            const float share = static_cast<float>(level) / static_cast<float>(std::max(levels - 1, 1U));
            importFaces(f, probe.radiance, own.map.lobes.mip(level),
                        {faces.first, share * static_cast<float>(probe.levels - 1), 0, coverage});
        }
    } else {
        filterCubeLobes(f, own.map, faces);
    }
    writeIrradiance(f, own, probe, cube);
    if (probe.distance) {
        const gpu::Image distance = own.distance.mip(0);
        f.compute("import_probe_distance", "import_probe_distance.comp")
            .read("hostCube", probe.distance, linearSampler(f))
            .write("faces", distance)
            .params(ImportProbeParams{faces.first, 0.0F, 1, 0})
            .dispatch(distance.size.x, distance.size.y, 6);
    }
}

}  // namespace

uint32_t probeSide(std::span<const HostProbe> probes) {
    uint32_t largest = 16;
    for (const HostProbe& probe : probes) {
        largest = std::max(largest, std::bit_floor(probe.radiance.size.x));
    }
    return std::min(largest, 256U);
}

ProbeMaps importProbes(gpu::PassList& f, HostProbeStore& own, std::span<const HostProbe> probes, bool write) {
    ProbeMaps maps;
    maps.block.count = static_cast<uint32_t>(std::min<size_t>(probes.size(), maxProbes));
    if (maps.block.count == 0) {
        return maps;
    }
    makeMaps(f.context(), own, probes);
    uint32_t parallax = 0;
    for (uint32_t i = 0; i < maps.block.count; ++i) {
        maps.block.probes[i] = probes[i].params;
        parallax = std::max(parallax, probes[i].params.parallax);
        if (write) {
            const auto scope = f.scope("probe");
            writeProbe(f, own, probes[i], i);
        }
    }
    maps.parallax = static_cast<ProbeParallax>(parallax);
    for (uint32_t i = 0; i < maps.block.count; ++i) {  // those without a limit of their own are as captured probes
        uint32_t& limit = maps.block.probes[i].parallax;
        limit = limit == parallax ? static_cast<uint32_t>(ProbeParallax::depth) : limit;
    }
    maps.lobes = own.map.lobes.image();
    maps.diffuse = maps.lobes;
    maps.irradiance = own.map.irradiance.image();
    maps.distance = own.distance.info().size.x > 0 ? own.distance.image() : gpu::Image{};
    return maps;
}

}  // namespace reflet
