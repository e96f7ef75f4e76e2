// The frame, top to bottom: values in, values out. Start reading here.
//
//     direct view (G-buffer → depth pyramid → sun and lamp visibility → direct light) → diffuse rays, specular rays
//     → answer chain → composite → tone map
//
// renderFrame, at the end, is all of it; its parts stand above it, and in direct_view.cpp what other views need, too.
// There is no graph compiler: an `if` in these two files is the only culling.
#include "render/frame.h"

#include "render/accumulate/accumulate.h"
#include "render/bounce/answer_environment.h"
#include "render/bounce/trace_screen.h"
#include "render/light_mips/light_mips.h"
#include "render/scene_source.h"
#include "render/tonemap/tonemap.h"

#include <algorithm>

namespace reflet {

namespace {

// One chain for both lobes: rays, then sources that answer in order of trust, each taking what is left over.
LobeLight traceLobe(gpu::Frame& f, const FrameInputs& in, const Settings& settings, const ViewImages& seen,
                    const ScreenImages& screen, uint32_t lobe) {
    const bool diffuse = lobe == lobeDiffuse;
    const auto scope = f.scope(diffuse ? "diffuse" : "specular");
    const uvec2 size = screen.g.depth.size;
    const bool counted = settings.traceScreen.countSteps != 0;
    const uint32_t perPixel = diffuse ? settings.diffuse.rays : settings.specular.rays;
    const float longest = diffuse ? settings.diffuse.radius : settings.traceScreen.maxDistance;
    if (perPixel == 0) {
        return noLight(f, lobe, size, counted);
    }
    const uint32_t batch = raysPerBatch(f, size);
    LobeLight light;
    for (uint32_t first = 0; first < perPixel; first += batch) {
        const uint32_t count = std::min(perPixel - first, batch);
        Rays rays = generateRays(f, screen.g, {in.ggxTable, in.blueNoise}, lobe,
                                 {in.view, settings.diffuse, settings.specular, first, count}, counted);
        if (settings.traceScreen.enabled != 0) {
            traceScreen(f, rays, screen, in.view, settings.traceScreen, longest);
        }
        answerFromScene(f, rays, in, settings, seen, screen);
        answerEnvironment(f, rays, screen.g, in.environment, settings.environment);
        light = resolveRays(f, rays, perPixel);
    }
    return light;
}

// What reflections show: direct light, or what is lit so far; and its mips for those that are too rough for rays.
void lightForReflections(gpu::Frame& f, const FrameInputs& in, const Settings& settings, const FrameImages& out,
                         ScreenImages& screen) {
    const auto scope = f.scope("specular");
    const SpecularSettings& s = settings.specular;
    const HitLight light = settings.traceScreen.light;
    if (light == HitLight::lit && s.rays > 0 && settings.diffuse.rays > 0) {
        const LobeLight none = noLight(f, lobeSpecular, out.g.depth.size, settings.traceScreen.countSteps != 0);
        const gpu::Image soFar = f.image("lit_so_far", VK_FORMAT_R16G16B16A16_SFLOAT, out.g.depth.size);
        screen.light =
            composite(f, out.g, out.direct, out.diffuse, none, in.ggxTable, soFar, {in.view, settings.diffuse.gain})
                .lit;
    }
    if (s.rougher == RougherSurfaces::mips && s.maxRoughness < 1.0F && s.rays > 0) {
        screen.lightMips =
            makeLightMips(f, light == HitLight::previous && screen.lit.valid ? screen.lit.previous : screen.light);
    }
}

}  // namespace

FrameImages renderFrame(gpu::Frame& f, const FrameInputs& in, const Settings& settings) {
    FrameImages out{directView(f, in, settings)};

    const gpu::History lit = f.history("lit", VK_FORMAT_R16G16B16A16_SFLOAT, out.g.depth.size);
    ScreenImages screen{
        .g = out.g, .backDepth = out.backDepth, .pyramid = out.pyramid, .light = out.direct, .lit = lit};
    out.diffuse = traceLobe(f, in, settings, out, screen, lobeDiffuse);
    lightForReflections(f, in, settings, out, screen);
    out.specular = traceLobe(f, in, settings, out, screen, lobeSpecular);

    out.light = composite(f, out.g, out.direct, out.diffuse, out.specular, in.ggxTable, lit.next,
                          {in.view, settings.diffuse.gain});
    if (settings.accumulate.enabled != 0) {
        const LightLayers means = accumulate(f, {out.direct, out.light}, in.framesBefore);
        out.direct = means.direct;
        out.light = means.light;
    }
    out.display = tonemap(f, out.light.lit, settings.tonemap);
    return out;
}

}  // namespace reflet
