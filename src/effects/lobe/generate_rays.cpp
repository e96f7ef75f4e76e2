// Records ray generation.
#include "effects/lobe/generate_rays.h"

#include "gpu/context.h"

namespace reflet {

namespace {

constexpr VkFormat lightFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

// The pass; `rays`: its outputs, or none if `light` is what it writes.
gpu::Pass passOf(gpu::Recorder& f, const RayGeneration& in, const Rays* rays, const LobeLight& light) {
    const GBuffer& g = in.from.g;
    const bool screen = in.screen.images != nullptr;
    const ScreenImages nothing{.g = g, .view = in.from.view};
    gpu::Pass pass = f.compute(screen ? "trace_screen" : "generate_rays", "generate_rays.comp");
    bindSurfaces(f, pass, g);
    bindScreen(f, pass, screen ? *in.screen.images : nothing,
               {.own = in.from.view,
                .settings = in.screen.settings,
                .longest = in.screen.longest,
                .firstRay = in.params.firstRay},
               screen ? in.imageMotion : gpu::Image{});
    bindEnvironment(pass, in.environment.light);
    bindEnvironmentLobes(pass, f.context(), in.environment.light);
    bindMeans(f, pass, light, in.params.firstRay);
    GenerateRaysParams params = in.params;
    params.view = in.from.view;
    const auto array = [&](gpu::Image Rays::* image, VkFormat format) {
        return rays != nullptr ? rays->*image : f.placeholder(format, /*array=*/true);
    };
    pass.constant("lobe", in.lobe)
        .constant("environmentLights", in.environment.settings.enabled)
        .constant("spreads", raysSpread(in.lobe, params.diffuse, params.specular) ? 1U : 0U)
        .constant("noise", static_cast<uint32_t>(in.noise))
        .constant("distribution", static_cast<uint32_t>(params.diffuse.distribution))
        .constant("adaptive", in.tiles.meanRays > 0 ? 1U : 0U)
        .constant("screen", screen ? 1U : 0U)
        .constant("last", rays == nullptr ? 1U : 0U)
        .constant("countSteps", in.countSteps ? 1U : 0U)
        .read("ownDepth", g.depth)
        .read("ownNormal", g.normal)
        .read("ownGeometricNormal", g.geometricNormal)
        .read("ownMaterial", g.material)
        .read("ownBaseColor", g.baseColor)
        .read("ggxTable", in.ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}))
        .read("blueNoise", in.blueNoise)
        .read("tiles", in.tiles.tiles)
        .read("list", in.tiles.list)
        .write("direction", array(&Rays::direction, VK_FORMAT_R32G32_UINT))
        .write("answer", array(&Rays::answer, lightFormat))
        .write("source", array(&Rays::source, VK_FORMAT_R8G8B8A8_UNORM))
        .write("steps", array(&Rays::steps, VK_FORMAT_R32_SFLOAT))
        .params(params, "rayParams")
        .params(AnswerEnvironmentParams{in.environment.settings}, "environmentAnswer");
    return pass;
}

}  // namespace

Rays generateRays(gpu::Recorder& f, gpu::Scratch& scratch, const RayGeneration& in) {
    const uvec2 size = in.from.g.depth.size;
    const uint32_t layers = in.params.rayCount;
    Rays rays{.from = in.from,
              .tiles = in.tiles,
              .direction = scratch.storage(VK_FORMAT_R32G32_UINT, size, layers, true),
              .answer = scratch.storage(lightFormat, size, layers, true),
              .source = scratch.storage(VK_FORMAT_R8G8B8A8_UNORM, size, layers, true),
              .steps = in.countSteps ? scratch.storage(VK_FORMAT_R32_SFLOAT, size, layers, true)
                                     : f.placeholder(VK_FORMAT_R32_SFLOAT, /*array=*/true),
              .imageMotion = in.imageMotion,
              .waiting = {},
              .scratch = &scratch,
              .firstRay = in.params.firstRay,
              .count = layers,
              .lobe = in.lobe,
              .spreads = raysSpread(in.lobe, in.params.diffuse, in.params.specular),
              .countSteps = in.countSteps,
              .directional = in.directional};
    rays.waiting = makeRayList(f, rays);
    passOf(f, in, &rays, {}).write("missed", rays.waiting).dispatchIndirect(in.tiles.list, 0);
    return rays;
}

LobeLight traceAtOnce(gpu::Recorder& f, LobeLightStore& own, const RayGeneration& in) {
    LobeLight light = lobeImages(f, own, in.from, in.countSteps);
    light.tiles = in.tiles;
    light.directional =
        in.directional ? own.directional.storage(f, lightFormat, in.from.g.depth.size) : gpu::Image{};
    gpu::Scratch scratch(f);
    passOf(f, in, nullptr, light)
        .write("missed", scratch.buffer(rayListHeader + sizeof(RayItem)))
        .dispatch(in.from.g.depth.size);
    return light;
}

}  // namespace reflet
