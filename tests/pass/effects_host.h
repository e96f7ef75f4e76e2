// A camera of a host that is not the program: a G-buffer that nobody drew, and every effect on it.
#pragma once

#include "effects/accumulate/accumulate.h"
#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/composite/composite.h"
#include "effects/contact/contact.h"
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/direct/direct.h"
#include "effects/direct/lamp_tiles.h"
#include "effects/exposure/exposure.h"
#include "effects/gbuffer/kept_depth.h"
#include "effects/import/import.h"
#include "effects/light_mips/light_mips.h"
#include "effects/lobe/lobe.h"
#include "effects/lobe/record_ray.h"
#include "effects/lobe/trace_screen.h"
#include "effects/pyramid/pyramid.h"
#include "effects/shadow/lamp_shadow.h"
#include "effects/shadow/shadow.h"
#include "effects/shadow/shadow_clean.h"
#include "effects/temporal/temporal.h"
#include "effects/tonemap/tonemap.h"
#include "noise/blue_noise.h"
#include "renderer/view_params.h"

#include <glm/gtc/packing.hpp>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace reflet::test::effects_host_test {

inline constexpr uvec2 size{48, 32};
inline constexpr float wallDistance = 4.0F;
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
    gpu::HistoryImage sunVisibility{"shadow_clean.history"};
    gpu::HistoryImage lit{"lit"};
    DenoiseStore ao;
    gpu::HistoryImage coc{"circle_of_confusion"};
    LobeStore diffuse;
    LobeStore specular;
    AccumulateStore accumulate;
    TemporalStore temporal;
    TemporalStore upscaling;
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
    explicit HostCamera(gpu::Context& context) { stores_.cube = CubeMap(context, 64, 1, "host.environment"); }

    /// spoiled: with infinity, NaN, the largest half float and negative values in every image of floats.
    void makeInputs(gpu::Recorder& f, const ViewParams& view, bool spoiled) {
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
        ggxTable(f, stores_.ggx);
        prefilterEnvironment(f, stores_.cube, stores_.sky.last());
    }

    Results record(gpu::Recorder& f, const ViewParams& view) {
        g_ = {.depth = stores_.depth.last(),
              .normal = stores_.normal.last(),
              .geometricNormal = stores_.normal.last(),
              .baseColor = stores_.color.last(),
              .material = stores_.material.last(),
              .emissive = stores_.emissive.last(),
              .motion = stores_.motion.last()};
        environment_ = {stores_.sky.last(),
                        stores_.cube.lobes.image(),
                        stores_.cube.irradiance.image(),
                        {vec3(1.0F), vec2(1.0F, 0.0F)}};
        importSurfaces(f, {.depth = g_.depth, .normal = stores_.color.last()}, {view, mat4(1.0F)});
        importLight(f, stores_.sky.last());
        importShadowMap(f, stores_.shadowMap.last(), 1, true);
        const gpu::Image pyramid = makePyramid(f, g_.depth);
        keptDepth(f, g_.depth, view, {.format = DepthBuffer::standard16});
        const gpu::Image direct = lightDirectly(f, view, pyramid);
        const gpu::History lit = stores_.lit.swap(f, colorFormat, size);
        const Composite light = lightIndirectly(f, view, {pyramid, direct, lit});
        const TemporalImages mean = temporal(f, stores_.temporal, {g_, light.lit, {}, view}, {});
        const TemporalInputs smaller{g_, light.lit, {}, view, 2U * size, vec2(0.1F, -0.2F)};
        const Lens lens{.apertureRadius = 0.05F, .focusDistance = 2.0F};
        depthOfField(f, stores_.coc, {mean.mean, g_.depth, g_.motion, view, lens, {}});
        const TemporalImages upscaled = temporal(f, stores_.upscaling, smaller, {});
        const LightLayers means = accumulate(f, stores_.accumulate, {direct, light}, 0);
        const gpu::Image stops = measureExposure(f, stores_.exposure, mean.mean, g_.depth, 0.0F, 0.5F);
        const gpu::Image display = tonemap(f, mean.mean, {}, stops);
        recordRay(f, {g_, {}, pyramid}, view, {}, size / 2U);
        recordHemisphere(f, {g_, {}, pyramid}, view, {}, size / 2U);
        return {f.readback(light.lit), f.readback(means.light.lit), f.readback(mean.mean), f.readback(upscaled.mean),
                f.readback(display)};
    }

    /// A lobe's light on the wall with a block before it: traced at once, and by lists, which a source that answers
    /// nothing asks for.
    std::array<LobeReadbacks, 2> traceBothWays(gpu::Recorder& f, const ViewParams& view, uint32_t lobe) {
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
        g_.depth = stores_.blockDepth.last();
        const ScreenImages screen{g_, view, {}, makePyramid(f, g_.depth), stores_.blockLight.last(), {}, {}};
        TraceScreenSettings trace;
        trace.rejectBackfaces = 0;  // the buffer has one normal for all
        const std::vector<RaySource> silent{[](gpu::Recorder&, Rays&) {}};
        std::array<LobeReadbacks, 2> read;
        for (size_t i = 0; i < 2; ++i) {
            const LobeLight traced = traceLobe(f, nullptr,
                                               {.lobe = lobe,
                                                .g = g_,
                                                .view = view,
                                                .settings = {.rays = 10},
                                                .diffuse = {},
                                                .specular = {},
                                                .denoise = {.enabled = 0},
                                                .environmentSettings = {},
                                                .environment = environment_,
                                                .ggxTable = stores_.ggx.last(),
                                                .blueNoise = stores_.blueNoise.get(f, blueNoise().size_bytes()),
                                                .screen = {&screen, trace, 100.0F},
                                                .sources = i == 0 ? std::span<const RaySource>() : silent,
                                                .lit = {},
                                                .countSteps = true});
            read[i] = {f.readback(traced.radiance), f.readback(traced.source), f.readback(traced.steps)};
        }
        return read;
    }

private:
    struct Indirect {
        gpu::Image pyramid;
        gpu::Image direct;
        gpu::History lit;
    };

    template <class T>
    static void upload(gpu::Recorder& f, gpu::KeptImage& image, VkFormat format, const std::vector<T>& texels) {
        f.upload(image.storage(f, format, size), std::as_bytes(std::span(texels)));
    }

    gpu::Image lightDirectly(gpu::Recorder& f, const ViewParams& view, gpu::Image pyramid) {
        const gpu::BufferView noise = stores_.blueNoise.get(f, blueNoise().size_bytes());
        const vec3 toSun = glm::normalize(vec3(0.3F, 0.5F, 1.0F));
        SunShadowParams sun{};
        sun.count = 1;
        sun.maps[0] = {glm::scale(mat4(1.0F), vec3(0.05F)), toSun, 0.1F, 40.0F};
        ShadowSettings shadow;
        shadow.earlyOut = 0;
        const SunVisibility seen =
            sunVisibility(f, g_, {stores_.shadowMap.last(), {}, noise}, {view, sun, shadow, 0.005F});
        gpu::Image visible = denoiseShadow(f, &stores_.sunVisibility, g_, seen.visibility, seen.penumbra,
                                           {view, toSun, 8, shadow.samples, 0});
        visible = contactShadow(f, g_, pyramid, visible, {view, {.distance = 0.2F}, toSun});
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
        const LampTiles tiles = findLampTiles(f, g_.depth, lamps, view, {});
        const gpu::Image lampsSeen =
            lampVisibility(f, g_, {stores_.shadowMap.last(), tiles.masks, noise}, shadows, {view, {}});
        return directLight(f, g_, {visible, lampsSeen, tiles.masks}, stores_.ggx.last(), {view, toSun, vec3(3.0F)},
                           {lamps, environment_});
    }

    Composite lightIndirectly(gpu::Recorder& f, const ViewParams& view, const Indirect& in) {
        ScreenImages screen{g_, view, {}, in.pyramid, in.direct, in.lit, {}};
        screen.lightMips = makeLightMips(f, in.direct);
        TraceScreenSettings trace;
        trace.light = HitLight::previous;
        const DenoiseSettings denoise{.enabled = 1};
        const gpu::BufferView noise = stores_.blueNoise.get(f, blueNoise().size_bytes());
        const AoSettings ao{.method = AoMethod::bitmask, .downsample = 2};
        const gpu::Image occlusion =
            ambientOcclusion(f, &stores_.ao, {g_, view, {}, ao, denoise, stores_.ggx.last(), noise});
        LobeInputs lobe{.lobe = lobeDiffuse,
                        .g = g_,
                        .view = view,
                        .settings = {.rays = 1, .downsample = 2},
                        .diffuse = {},
                        .specular = {},
                        .denoise = denoise,
                        .environmentSettings = {},
                        .environment = environment_,
                        .ggxTable = stores_.ggx.last(),
                        .blueNoise = noise,
                        .screen = {&screen, trace, 100.0F},
                        .sources = {},
                        .ambientOcclusion = occlusion,
                        .lit = in.lit};
        const LobeLight diffuse = traceLobe(f, &stores_.diffuse, lobe);
        lobe.lobe = lobeSpecular;
        lobe.settings = {.rays = 2, .adaptive = true};
        const LobeLight specular = traceLobe(f, &stores_.specular, lobe);
        return composite(f, {g_, in.direct, diffuse, specular, stores_.ggx.last()}, in.lit.next, {view, 1.0F});
    }

    Stores stores_;
    GBuffer g_;
    EnvironmentLight environment_;
};

}  // namespace reflet::test::effects_host_test
