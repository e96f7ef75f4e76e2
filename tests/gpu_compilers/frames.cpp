// Records steady frames with all effects.
#include "gpu_compilers/frames.h"

#include "base/error.h"

#include <cstring>

namespace reflet::gpu_compilers {

namespace {

void check(RefletResult result) {
    if (result != REFLET_SUCCESS) {
        fail("{}", refletLastError());
    }
}

void store(float (&to)[16], const mat4& m) {
    std::memcpy(to, &m[0][0], sizeof to);
}

// What a host draws in each frame.
struct Inputs {
    explicit Inputs(uvec2 size, uint32_t cascades) {
        gbuffer.structSize = sizeof gbuffer;
        gbuffer.depthKind = REFLET_DEPTH_REVERSED;
        gbuffer.depth = makeHostImage(VK_FORMAT_D32_SFLOAT, size);
        gbuffer.normalKind = REFLET_NORMAL_OCTAHEDRAL_SNORM;
        gbuffer.normal = makeHostImage(VK_FORMAT_R16G16_SNORM, size);
        gbuffer.geometricNormal = makeHostImage(VK_FORMAT_R16G16_SNORM, size);
        gbuffer.roughness = makeHostImage(VK_FORMAT_R8G8B8A8_UNORM, size);
        gbuffer.metallic = gbuffer.roughness;
        gbuffer.metallicChannel = 1;
        gbuffer.baseColor = makeHostImage(VK_FORMAT_R8G8B8A8_SRGB, size);
        gbuffer.motion = makeHostImage(VK_FORMAT_R16G16_SFLOAT, size);
        gbuffer.backDepth = makeHostImage(VK_FORMAT_D32_SFLOAT, size);
        environment.structSize = sizeof environment;
        environment.image = makeHostImage(VK_FORMAT_R16G16B16A16_SFLOAT, {1024, 512});
        environment.revision = 1;
        light.structSize = sizeof light;
        light.light = makeHostImage(VK_FORMAT_R16G16B16A16_SFLOAT, size);
        light.environment = &environment;
        sun.structSize = sizeof sun;
        sun.map = makeHostImage(VK_FORMAT_D32_SFLOAT, {2048, 2048});
        sun.cascades = cascades;
        sun.toSun[1] = 1.0F;
        sun.angularDiameter = 0.03F;
        sun.contactShadows = cascades > 1 ? 1 : 0;
        for (uint32_t i = 0; i < cascades; ++i) {
            const float extent = 0.05F / static_cast<float>(1U << (2 * i));
            store(sun.worldToClip[i], glm::scale(mat4(1.0F), vec3(extent, extent, 0.02F)));
            sun.cascadeSplits[i] = 5.0F * static_cast<float>(1U << (2 * i));
        }
    }

    RefletGBuffer gbuffer{};
    RefletEnvironment environment{};
    RefletIndirectLight light{};
    RefletSunShadow sun{};
};

void recordFrame(RefletView view, RefletSettings settings, const Inputs& inputs, uint32_t index) {
    RefletFrameInfo info{};
    info.structSize = sizeof info;
    info.commandBuffer = reinterpret_cast<VkCommandBuffer>(&info);  // noted, never used
    info.frameIndex = index;
    info.gbuffer = &inputs.gbuffer;
    info.elapsed = 0.016F;
    mat4 toClip(0.0F);
    toClip[0][0] = 1.0F;
    toClip[1][1] = -16.0F / 9.0F;
    toClip[2][3] = -1.0F;
    toClip[3][2] = 0.1F;
    store(info.viewToClip, toClip);
    const vec3 eye(0.01F * static_cast<float>(index), 1.0F, 5.0F);
    store(info.worldToView, glm::lookAt(eye, vec3(0.0F), vec3(0.0F, 1.0F, 0.0F)));
    check(refletBeginFrame(view, &info));
    RefletImage image{};
    check(refletSunShadow(view, settings, &inputs.sun, &image));
    if (std::strcmp(refletGetSetting(settings, "ao.method"), "none") != 0) {
        check(refletAmbientOcclusion(view, settings, &image));
    }
    RefletLobe diffuse{};
    RefletLobe specular{};
    diffuse.structSize = specular.structSize = sizeof(RefletLobe);
    check(refletDiffuseGi(view, settings, &inputs.light, &diffuse));
    check(refletReflections(view, settings, &inputs.light, &specular));
    RefletComposite sum{};
    sum.structSize = sizeof sum;
    check(refletComposite(view, settings, nullptr, &sum));
    check(refletTemporal(view, settings, nullptr, &image));
    const RefletLens lens{sizeof lens, 0.02F, 3.0F, 6, 0.1F};
    check(refletDepthOfField(view, settings, &lens, nullptr, &image));
    check(refletMotionBlur(view, settings, nullptr, &image));
    check(refletToneMap(view, settings, nullptr, 1, &image));
    check(refletEndFrame(view));
}

}  // namespace

const std::vector<FrameCase>& frameCases() {
    constexpr uvec2 half{960, 540};
    constexpr uvec2 full{1920, 1080};
    static const std::vector<FrameCase> cases{
        {"fast", "fast", half, full, {}},
        {"balanced", "balanced", half, full, {}},
        {"quality", "quality", full, full, {}},
        {"horizon", "quality", full, full, {{"ao.method", "horizon"}}},
        {"options",
         "quality",
         full,
         full,
         {{"ao.method", "bitmask"}, {"diffuse.method", "slices"}, {"shadow.filter", "pcf"}},
         3},
    };
    return cases;
}

RecordedFrame recordSteadyFrame(RefletContext context, const FrameCase& wanted) {
    RefletViewInfo info{};
    info.structSize = sizeof info;
    info.width = wanted.size.x;
    info.height = wanted.size.y;
    info.framesInFlight = 2;
    RefletView view = nullptr;
    check(refletCreateView(context, &info, &view));
    if (wanted.output != wanted.size) {
        check(refletSetOutputSize(view, wanted.output.x, wanted.output.y));
    }
    RefletSettings settings = nullptr;
    check(refletCreateSettings(wanted.preset, &settings));
    for (const auto& [name, value] : wanted.settings) {
        check(refletSetSetting(settings, name, value));
    }
    Inputs inputs(wanted.size, wanted.cascades);
    if (std::strcmp(refletGetSetting(settings, "radiance_cache.enabled"), "true") == 0) {  // as the program has it
        check(refletCreateRadianceCache(context, &inputs.light.radianceCache));
    }
    RecordedFrame frame;
    for (uint32_t i = 0; i < 4; ++i) {
        frame = {};
        static_cast<void>(takeRecordedFrame());
        recordFrame(view, settings, inputs, i);
        frame = takeRecordedFrame();
    }
    refletDestroySettings(settings);
    refletDestroyView(view);
    refletDestroyRadianceCache(inputs.light.radianceCache);
    return frame;
}

}  // namespace reflet::gpu_compilers
