// A camera of a host that is not the program: a G-buffer that nobody drew, and every stage on it.
#pragma once

#include "effects/lobe/record_ray.h"
#include "effects/view.h"
#include "lighting/direct.h"
#include "lighting/environment.h"
#include "lighting/host_images.h"
#include "lighting/host_sources.h"
#include "lighting/indirect.h"
#include "lighting/picture.h"
#include "noise/blue_noise.h"
#include "renderer/view_params.h"

#include <glm/gtc/packing.hpp>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace reflet::test::effects_host_test {

inline constexpr uvec2 size{48, 27};
inline constexpr float wallDistance = 4.0F;
inline constexpr uint32_t environmentSide = 64;
inline constexpr VkFormat colorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

// What the host owns for its one camera.
struct Stores {
    gpu::KeptImage depth{"host.depth"};
    gpu::KeptImage normal{"host.normal"};
    gpu::KeptImage color{"host.base_color"};
    gpu::KeptImage material{"host.material"};
    gpu::KeptImage emissive{"host.emissive"};
    gpu::KeptImage motion{"host.motion"};
    gpu::KeptImage shadowMap{"host.shadow_map"};
    gpu::KeptImage sky{"host.sky"};
    gpu::KeptBuffer blueNoise{"host.blue_noise"};
    gpu::KeptImage ggx{"ggx_table"};
    CubeMap cube;
    gpu::Texture hostCube;
    HostProbeStore probes;
    RadianceCache remembered;
    gpu::HistoryImage sunVisibility{"shadow_clean.history"};
    gpu::HistoryImage lit{"lit"};
    DenoiseStore ao;
    LobeStore diffuse;
    LobeStore specular;
    lighting::AccumulateHistory means;
    TemporalStore temporal;
    TemporalStore upscaling;
    lighting::DofHistory lens;
    gpu::HistoryImage exposure{"exposure"};
    gpu::KeptImage blockDepth{"host.block_depth"};
    gpu::KeptImage blockLight{"host.block_light"};
};

struct Results {
    gpu::Readback lit;
    gpu::Readback accumulated;
    gpu::Readback temporal;
    gpu::Readback upscaled;
    gpu::Readback display;
};

struct LobeReadbacks {
    gpu::Readback radiance;
    gpu::Readback source;
    gpu::Readback steps;
};

// A wall across the view, half of it a mirror, with sky above.
class HostCamera {
public:
    explicit HostCamera(gpu::Context& context) {
        stores_.cube = CubeMap(context, environmentSide, 1, "host.environment");
        constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        stores_.hostCube =
            gpu::Texture(context, {colorFormat, uvec2(16), 1, 6, usage, gpu::ViewKind::cube}, "host.cube");
    }

    /// spoiled: with infinity, NaN, the largest half float and negative values in every image of floats.
    void makeInputs(gpu::PassList& f, const ViewParams& view, bool spoiled) {
        const vec4 onWall = view.worldToClip * vec4(0.0F, 0.0F, -wallDistance, 1.0F);
        const size_t count = size_t(size.x) * size.y;
        std::vector<float> depth(count, onWall.z / onWall.w);
        std::vector<uint32_t> material(count,
                                       0x00FF0080U);  // roughness, metallic, occlusion, flags from the lowest byte
        for (size_t i = 0; i < count; ++i) {
            depth[i] = i < 4 * size.x ? 0.0F : depth[i];
            material[i] = i % size.x < size.x / 2 ? 0x00FFFF00U : material[i];
        }
        std::vector<float> shadowMap(count, 0.0F);
        std::vector<uint64_t> emissive(count, 0);
        std::vector<uint64_t> motion(count, 0);
        std::vector<uint64_t> sky(count, 0x3C003C003C003C00U);  // white
        if (spoiled) {
            constexpr std::array<float, 4> floats{NAN, INFINITY, 65504.0F, -2.0F};
            constexpr std::array<uint64_t, 4> halves{0x7E00U, 0x7C00U, 0x7BFFU, 0xC000U};
            for (size_t i = 0; i < count; i += 7) {
                const size_t which = i / 7 % 4;
                const uint64_t texel = halves[which] * 0x0001000100010001U;
                depth[i] = floats[which];
                shadowMap[count - 1 - i] = floats[which];
                emissive[(i + 1) % count] = texel;
                motion[(i + 2) % count] = texel;
                sky[(i + 3) % count] = texel;
            }
        }
        upload(f, stores_.depth, VK_FORMAT_R32_SFLOAT, depth);
        upload(f, stores_.normal, VK_FORMAT_R32_UINT, std::vector<uint32_t>(count, 0));
        upload(f, stores_.color, VK_FORMAT_R8G8B8A8_UNORM, std::vector<uint32_t>(count, 0xFF80A0C0U));
        upload(f, stores_.material, VK_FORMAT_R8G8B8A8_UNORM, material);
        upload(f, stores_.emissive, colorFormat, emissive);
        upload(f, stores_.motion, colorFormat, motion);
        upload(f, stores_.shadowMap, VK_FORMAT_R32_SFLOAT, shadowMap);
        upload(f, stores_.sky, colorFormat, sky);
        f.update(stores_.blueNoise.get(f, blueNoise().size_bytes()), std::as_bytes(blueNoise()));
        f.clear(stores_.hostCube.image(), {{1.0F, 2.0F, 3.0F, 1.0F}});
        lighting::ggxTable(f, stores_.ggx);
        lighting::prefilterEnvironment(f, stores_.cube, stores_.sky.last(), 4 * environmentSide);
    }

    Results record(gpu::PassList& f, const ViewParams& view) {
        lighting::ViewContext context = contextOf(f, view);
        context.cache = stores_.remembered.update(f, {}, 0.0F, 1.0F);
        lighting::Surfaces surfaces = surfacesOf();
        // What no pass reads is kept, so that it is recorded.
        const HostSurfaces given{.depth = surfaces.g.depth, .normal = stores_.color.last()};
        f.keep(lighting::importSurfaces(f, given, {view, mat4(1.0F)}).g.normal);
        f.keep(lighting::importLight(f, stores_.sky.last()));
        f.keep(lighting::keptDepth(f, view, {.format = DepthBuffer::standard16}, surfaces.g.depth));
        keepLampShadows(f, context, surfaces);
        const gpu::Image smaller = f.image("host.smaller", colorFormat, uvec2(8));
        lighting::rescaleHistory(f, stores_.sky.last(), smaller, gpu::Resample::linear);
        f.keep(smaller);
        const LightingSettings settings = settingsOfHost();
        const gpu::Image direct = lightDirectly(f, context, settings, surfaces);
        surfaces.ambientOcclusion = lighting::ambientOcclusion(f, &stores_.ao, context, settings, surfaces);
        f.keep(surfaces.ambientOcclusion);
        const gpu::History lit = stores_.lit.swap(f, colorFormat, size);
        const lighting::LightParts parts = lightIndirectly(f, context, settings, surfaces, direct, lit);
        const lighting::Light light = lighting::compose(f, context, settings, surfaces, parts, true, lit.next);
        const lighting::Reflecting reflecting{surfaces, &parts.specular, light.lit};
        const lighting::Light mean =
            lighting::antialias(f, stores_.temporal, context, settings, reflecting, light, {size, vec2(0.0F)});
        const lighting::Light upscaled = lighting::antialias(f, stores_.upscaling, context, settings, reflecting, light,
                                                             {2U * size, vec2(0.1F, -0.2F)});
        const Lens lens{.apertureRadius = 0.05F, .focusDistance = 2.0F};
        const lighting::Light defocused = lighting::defocus(f, stores_.lens, context, settings, lens, reflecting, mean);
        f.keep(lighting::blurMotion(f, context, settings, defocused).lit);
        const lighting::Light means = lighting::accumulate(f, stores_.means, light, 0);
        const gpu::Image stops = lighting::exposure(f, stores_.exposure, settings, surfaces, mean, 0.0F);
        const gpu::Image display = lighting::display(f, settings, mean.lit, stops);
        const gpu::Image factor = lighting::exposureFactor(f, stops);
        for (const VkFormat format :
             {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_A2B10G10R10_UNORM_PACK32, VK_FORMAT_R16G16B16A16_SFLOAT}) {
            f.keep(lighting::displayFor(f, mean.lit, settings.tonemap, factor,
                                        {.format = format, .transfer = transferPq}));
        }
        const RecordRayInputs traced{surfaces.g, {}, surfaces.pyramid};
        recordRay(f, traced, view, {}, size / 2U);
        recordHemisphere(f, traced, view, {}, size / 2U);
        return {f.readback(light.lit), f.readback(means.lit), f.readback(mean.lit), f.readback(upscaled.lit),
                f.readback(display)};
    }

    /// A lobe's light on the wall with a block before it: traced at once, and by lists, which a source that answers
    /// nothing asks for.
    std::array<LobeReadbacks, 2> traceBothWays(gpu::PassList& f, const ViewParams& view, uint32_t lobe) {
        const size_t count = size_t(size.x) * size.y;
        const auto depthAt = [&](float distance) {
            const vec4 clip = view.worldToClip * vec4(0.0F, 0.0F, -distance, 1.0F);
            return clip.z / clip.w;
        };
        std::vector<float> depth(count);
        std::vector<uint64_t> light(count);
        for (size_t i = 0; i < count; ++i) {
            const size_t x = i % size.x;
            const size_t y = i / size.x;
            const bool block = x >= 18 && x < 30 && y >= 10 && y < 24;
            depth[i] = y < 4 ? 0.0F : depthAt(block ? wallDistance - 0.2F : wallDistance);
            light[i] = glm::packHalf4x16(vec4(0.5F + 0.1F * static_cast<float>(x), block ? 8.0F : 1.0F, 0.5F, 1.0F));
        }
        upload(f, stores_.blockDepth, VK_FORMAT_R32_SFLOAT, depth);
        upload(f, stores_.blockLight, colorFormat, light);
        lighting::Surfaces surfaces = surfacesOf();
        surfaces.g.depth = stores_.blockDepth.last();
        LightingSettings settings;
        settings.diffuse.rays = 10;
        settings.specular.rays = 10;
        settings.traceScreen.countSteps = 1;
        settings.traceScreen.rejectBackfaces = 0;  // the buffer has one normal for all
        const lighting::ViewContext context = contextOf(f, view);
        const ScreenImages screen = lighting::screenOf(f, context, settings, surfaces, stores_.blockLight.last(), {});
        std::array<LobeReadbacks, 2> read;
        for (size_t i = 0; i < 2; ++i) {
            lighting::RaySources sources;
            if (i == 1) {
                sources.others.emplace_back([](gpu::PassList&, Rays&) {});
            }
            const LobeLight traced =
                lighting::traceLobe(f, nullptr, context, settings, lobe, surfaces, screen, sources);
            read[i] = {f.readback(traced.radiance), f.readback(traced.source), f.readback(traced.steps)};
        }
        return read;
    }

private:
    template <class T>
    static void upload(gpu::PassList& f, gpu::KeptImage& image, VkFormat format, const std::vector<T>& texels) {
        f.upload(image.storage(f, format, size), std::as_bytes(std::span(texels)));
    }

    static LightingSettings settingsOfHost() {
        LightingSettings settings;
        settings.shadow.history = 8;
        settings.contact.distance = 0.2F;
        settings.traceScreen.light = HitLight::previous;
        settings.ao.method = AoMethod::bitmask;
        settings.ao.downsample = 2;
        settings.diffuse.rays = 1;
        settings.diffuse.downsample = 2;
        settings.specular.rays = 2;
        settings.specular.adaptive = 1;
        settings.specular.maxRoughness = 0.4F;
        settings.specular.roughFallback = RoughFallback::mips;
        settings.denoise.enabled = 1;
        settings.motionBlur.enabled = 1;
        return settings;
    }

    lighting::ViewContext contextOf(gpu::PassList& f, const ViewParams& view) {
        return {.view = view,
                .environment = {stores_.sky.last(), stores_.cube.lobes.image(), stores_.cube.irradiance.image(),
                                lighting::environmentParams(vec3(1.0F), 0.0F)},
                .ggxTable = stores_.ggx.last(),
                .blueNoise = stores_.blueNoise.get(f, blueNoise().size_bytes())};
    }

    lighting::Surfaces surfacesOf() const {
        lighting::Surfaces surfaces;
        surfaces.g = {.depth = stores_.depth.last(),
                      .normal = stores_.normal.last(),
                      .geometricNormal = stores_.normal.last(),
                      .baseColor = stores_.color.last(),
                      .material = stores_.material.last(),
                      .emissive = stores_.emissive.last(),
                      .motion = stores_.motion.last()};
        return surfaces;
    }

    gpu::Image lightDirectly(gpu::PassList& f, const lighting::ViewContext& context, const LightingSettings& settings,
                             lighting::Surfaces& surfaces) {
        const vec3 toSun = glm::normalize(vec3(0.3F, 0.5F, 1.0F));
        lighting::SunMaps sun{
            .map = {stores_.shadowMap.last(), true, false}, .toSun = toSun, .slope = 0.005F, .contact = true};
        sun.sun.count = 1;
        sun.sun.maps[0] = {glm::scale(mat4(1.0F), vec3(0.05F)), toSun, 0.1F, 40.0F};
        const lighting::SunShadow seen =
            lighting::sunShadow(f, &stores_.sunVisibility, context, settings, surfaces, sun);
        LampBlock lamps{};
        lamps.count = 1;
        lamps.lamps[0] = {.position = vec3(0.0F, 0.0F, -2.0F),
                          .type = lampPoint,
                          .toLamp = vec3(0.0F, 0.0F, 1.0F),
                          .inverseRange = 0.0F,
                          .intensity = vec3(5.0F),
                          .shadow = 0};
        LampShadows shadows{};
        shadows.count = 1;
        shadows.tileSize = size.y;
        shadows.columns = 1;
        shadows.lamps[0] = {
            .lamp = lamps.lamps[0], .worldToTile = mat3(1.0F), .halfTangent = 1.0F, .near = 0.01F, .tiles = 6};
        const LampTiles tiles = lighting::lampTiles(f, context, {}, surfaces, lamps);
        const gpu::Image lampsSeen =
            lighting::lampShadow(f, context, settings, surfaces, tiles, shadows, stores_.shadowMap.last());
        return lighting::directLight(f, context, surfaces,
                                     {toSun, vec3(3.0F), sun.slope, lamps, {seen.visibility, lampsSeen, tiles.masks}})
            .all;
    }

    lighting::LightParts lightIndirectly(gpu::PassList& f, const lighting::ViewContext& context,
                                         const LightingSettings& settings, lighting::Surfaces& surfaces,
                                         gpu::Image direct, const gpu::History& lit) {
        const ScreenImages screen = lighting::screenOf(f, context, settings, surfaces, direct, lit);
        const LobeLight diffuse =
            lighting::traceLobe(f, &stores_.diffuse, context, settings, lobeDiffuse, surfaces, screen, {});
        const ScreenImages reflected = lighting::lightAtHits(f, context, settings, lobeSpecular, screen, &diffuse);
        const LobeLight specular =
            lighting::traceLobe(f, &stores_.specular, context, settings, lobeSpecular, surfaces, reflected,
                                lighting::sourcesOf(ownLight(f, context, settings, surfaces)));
        return {direct, diffuse, specular};
    }

    // A probe, an image of light and a planar view.
    const lighting::HostLight& ownLight(gpu::PassList& f, const lighting::ViewContext& context,
                                        const LightingSettings& settings, const lighting::Surfaces& surfaces) {
        HostProbe probe{};
        probe.params = {.blend = 1.0F,
                        .boxMin = vec3(-9.0F),
                        .parallax = static_cast<uint32_t>(ProbeParallax::depth),
                        .boxMax = vec3(9.0F),
                        .parallaxMin = vec3(-9.0F),
                        .parallaxMax = vec3(9.0F)};
        probe.radiance = probe.distance = probe.irradiance = stores_.hostCube.image();
        HostProbe other = probe;
        other.irradiance = {};
        other.harmonics.emplace();
        other.levels = 2;
        const std::array probes{probe, other};
        light_ = {.image = {stores_.sky.last()}, .probes = lighting::importProbes(f, stores_.probes, probes, true)};
        const lighting::HostPlanarView planar{.color = stores_.sky.last(),
                                              .depth = surfaces.g.depth,
                                              .view = context.view,
                                              .plane = vec4(0.0F, 0.0F, 1.0F, wallDistance),
                                              .tolerance = 0.01F};
        light_.mirrors = {lighting::importPlanarView(f, settings, planar, 100.0F)};
        return light_;
    }

    // By a 2D map and a cube map.
    void keepLampShadows(gpu::PassList& f, const lighting::ViewContext& context, const lighting::Surfaces& surfaces) {
        std::array<lighting::HostLamp, 2> lamps;
        for (lighting::HostLamp& lamp : lamps) {
            lamp.isCube = &lamp != lamps.data();
            lamp.map = lamp.isCube ? stores_.hostCube.image() : stores_.shadowMap.last();
            lamp.shadow = {.lamp = {.type = lampPoint, .intensity = vec3(1.0F), .radius = 0.1F},
                           .worldToTile = mat3(1.0F),
                           .halfTangent = 1.0F,
                           .near = 0.1F,
                           .tiles = lamp.isCube ? 6U : 1U,
                           .side = 16};
            lamp.import.depth = lampDistance;
            lamp.import.distanceScale = 1.0F;
            lamp.import.hostFaces = 1;
            lamp.import.worldToClip[0] = mat4(1.0F);
            lamp.import.tiles[0] = vec4(0.0F, 0.0F, 16.0F, 16.0F);
        }
        f.keep(lighting::lampShadow(f, context, settingsOfHost(), surfaces, lamps));
    }

    Stores stores_;
    lighting::HostLight light_;
};

}  // namespace reflet::test::effects_host_test
