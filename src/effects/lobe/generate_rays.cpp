// Records ray generation.
#include "effects/lobe/generate_rays.h"

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "gpu/context.h"

namespace reflet {

namespace {

bool leavesOutHighlights(const RayGeneration& in) {
    return in.lobe == lobeSpecular && in.params.roughestHighlight > 0.0F;
}

// What make_ray.glsl reads.
gpu::ComputePass& bindGeneration(gpu::PassList& f, gpu::ComputePass& pass, const RayGeneration& in) {
    const GBuffer& g = in.from.g;
    bindDiffuseRays(pass, in);
    return bindSurfaces(f, pass, g)
        .constant("spreads", raysSpread(in.lobe, in.params.diffuse, in.params.specular) ? 1U : 0U)
        .constant("highlights", leavesOutHighlights(in) ? 1U : 0U)
        .read("ownMaterial", g.material)
        .read("ownBaseColor", g.baseColor)
        .read("ggxTable", in.ggxTable, f.context().sampler({VK_FILTER_LINEAR, VK_FILTER_LINEAR}));
}

// A phase of traceAtOnce.
void tracePhase(gpu::PassList& f, const LobeLight& light, const RayGeneration& in, const ScreenSource& screen,
                const EnvironmentSource& environment, const MarchPhase& phase) {
    const uvec2 size = in.from.g.depth.size;
    const bool traced = screen.images != nullptr;
    const ScreenImages nothing{.g = in.from.g, .view = in.from.view};
    gpu::ComputePass pass = f.compute("trace_at_once" + nameOf(phase), "trace_at_once.comp");
    bindGeneration(f, pass, in);
    bindScreen(f, pass, traced ? *screen.images : nothing,
               {.own = in.from.view,
                .settings = screen.settings,
                .longest = screen.longest,
                .firstStep = phase.first,
                .endStep = phase.end,
                .firstRay = in.params.firstRay},
               in.imageMotion);
    bindMarchPhase(pass, phase, in.tiles.list, f.buffer("no_list", rayListHeader));
    bindAmbientOcclusion(f, pass, in.from.ambientOcclusion, in.from.scale);
    bindEnvironment(pass, environment.light);
    bindEnvironmentLobes(pass, f.context(), environment.light);
    bindMeans(f, pass, light, in.params.firstRay)
        .constant("screen", traced ? 1U : 0U)
        .constant("countSteps", in.countSteps ? 1U : 0U)
        .constant("environmentLights", environment.settings.enabled)
        .params(AnswerEnvironmentParams{environment.settings}, "environmentAnswer");
    if (phase.unfinished) {
        pass.dispatchIndirect(phase.unfinished, 0);
    } else {
        pass.dispatchStrips(size);
    }
}

}  // namespace

gpu::ComputePass& bindDiffuseRays(gpu::ComputePass& pass, const RayGeneration& in) {
    GenerateRaysParams params = in.params;
    params.view = in.from.view;
    return pass.constant("lobe", in.lobe)
        .constant("noise", static_cast<uint32_t>(in.noise))
        .constant("distribution", static_cast<uint32_t>(params.diffuse.distribution))
        .read("ownDepth", in.from.g.depth)
        .read("ownNormal", in.from.g.normal)
        .read("ownGeometricNormal", in.from.g.geometricNormal)
        .read("blueNoise", in.blueNoise)
        .read("tiles", in.tiles.tiles)
        .params(params, "rayParams");
}

Rays raysOf(gpu::PassList& f, const RayGeneration& in) {
    const uvec2 size = in.from.g.depth.size;
    const uint32_t layers = in.params.rayCount;
    Rays rays{.from = in.from,
              .tiles = in.tiles,
              .direction = f.image("ray_direction", VK_FORMAT_R32G32_UINT, size, layers, true),
              .answer = f.image("ray_answer", VK_FORMAT_R16G16B16A16_SFLOAT, size, layers, true),
              .source = f.image("ray_source", VK_FORMAT_R8G8B8A8_UNORM, size, layers, true),
              .steps = in.countSteps ? f.image("ray_steps", VK_FORMAT_R32_SFLOAT, size, layers, true)
                                     : f.placeholder(VK_FORMAT_R32_SFLOAT, gpu::ViewKind::array),
              .imageMotion = in.imageMotion,
              .waiting = {},
              .firstRay = in.params.firstRay,
              .count = layers,
              .lobe = in.lobe,
              .highlights = leavesOutHighlights(in),
              .spreads = raysSpread(in.lobe, in.params.diffuse, in.params.specular),
              .countSteps = in.countSteps,
              .directional = in.directional};
    if (in.countSteps) {
        f.clear(rays.steps);  // pixels without rays have 0 steps
    }
    rays.waiting = makeRayList(f, rays);
    return rays;
}

Rays generateRays(gpu::PassList& f, const RayGeneration& in) {
    Rays rays = raysOf(f, in);
    gpu::ComputePass pass = f.compute("generate_rays", "generate_rays.comp");
    bindGeneration(f, pass, in)
        .read("list", in.tiles.list)
        .write("direction", rays.direction)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("missed", rays.waiting)
        .dispatchIndirect(in.tiles.list, 0);
    return rays;
}

void traceAtOnce(gpu::PassList& f, const LobeLight& light, const RayGeneration& in, const ScreenSource& screen,
                 const EnvironmentSource& environment) {
    const uvec2 size = in.from.g.depth.size;
    std::vector<MarchPhase> phases{{.end = screen.settings.maxSteps}};
    // The sum of several rays of a pixel is made in one pass.
    if (screen.images != nullptr && in.params.rayCount == 1) {
        phases = marchPhases(f, screen.settings, VkDeviceSize(size.x) * size.y);
    }
    for (const MarchPhase& phase : phases) {
        tracePhase(f, light, in, screen, environment, phase);
    }
}

}  // namespace reflet
