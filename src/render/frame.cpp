// The frame, top to bottom: values in, values out. Start reading here.
//
//     G-buffer → sun visibility → direct light → diffuse rays, specular rays → answer chain → composite → tone map
//
// There is no graph compiler: an `if` in this file is the only culling.
#include "render/frame.h"

#include "render/bounce/answer_environment.h"
#include "render/bounce/trace_screen.h"
#include "render/gbuffer/back_depth.h"
#include "render/light_mips/light_mips.h"
#include "render/pyramid/pyramid.h"
#include "render/shadow/shadow.h"
#include "render/tonemap/tonemap.h"

#include <algorithm>

namespace reflet {

FrameImages renderFrame(gpu::Frame& f, const FrameInputs& in, const Settings& settings) {
    FrameImages out;
    out.g = drawGBuffer(f, in.draws, in.view, settings.materials);
    if (settings.traceScreen.thicknessFrom == ThicknessFrom::secondLayer) {
        const gpu::Image back = drawBackDepth(f, in.draws, out.g.depth, in.view);
        out.backDepth = keptDepth(f, "kept_back_depth", back, in.view, settings.depth);
    }
    out.g.depth = keptDepth(f, "kept_depth", out.g.depth, in.view, settings.depth);

    ShadowSettings shadow = settings.shadow;
    if (in.sunIrradiance == vec3(0.0F)) {
        shadow.filter = ShadowFilter::none;
    }
    const ShadowMapParams sunMap =
        shadow.extent > 0.0F ? centredSunShadow(in.draws.boundsW, in.sunDirection, shadow.extent, shadow.resolution)
                             : fitSunShadow(in.view.clipToWorld, in.draws.boundsW, in.sunDirection, shadow.resolution);
    if (shadow.filter != ShadowFilter::none) {
        out.shadowMap = drawShadowMap(f, in.draws, sunMap, shadow);
    }
    out.sunVisibility = sunVisibility(f, out.g, out.shadowMap, sunMap, in.view, shadow);
    out.direct = directLight(f, out.g, out.sunVisibility, in.ggxTable,
                             {in.view, -in.sunDirection, in.sunIrradiance, in.environment}, in.lamps);

    // One chain for both lobes: rays, then sources that answer in order of trust, each taking what is left over.
    const gpu::History lit = f.history("lit", VK_FORMAT_R16G16B16A16_SFLOAT, out.g.depth.size);
    const uint32_t batch = raysPerBatch(f, out.g.depth.size);
    const TraceScreenSettings& trace = settings.traceScreen;
    const bool counted = trace.countSteps != 0;
    ScreenImages screen{.g = out.g, .backDepth = out.backDepth, .light = out.direct, .lit = lit};
    if (trace.method == TraceMethod::hiz) {
        screen.pyramid = makePyramid(f, out.g.depth, screen.backDepth);
    }
    const auto traceLobe = [&](uint32_t lobe, uint32_t perPixel, float longest) {
        LobeLight light;
        for (uint32_t first = 0; first < perPixel; first += batch) {
            const uint32_t count = std::min(perPixel - first, batch);
            Rays rays = generateRays(f, out.g, {in.ggxTable, in.blueNoise}, lobe,
                                     {in.view, settings.diffuse, settings.specular, first, count}, counted);
            traceScreen(f, rays, screen, in.view, trace, longest);
            answerEnvironment(f, rays, out.g, in.environment, settings.environment);
            light = resolveRays(f, rays, perPixel);
        }
        return perPixel > 0 ? light : noLight(f, lobe, out.g.depth.size, counted);
    };
    {
        const auto scope = f.scope("diffuse");
        out.diffuse = traceLobe(lobeDiffuse, settings.diffuse.rays, settings.diffuse.radius);
    }
    {
        const auto scope = f.scope("specular");
        if (trace.light == HitLight::lit && settings.specular.rays > 0 && settings.diffuse.rays > 0) {
            const LobeLight none = noLight(f, lobeSpecular, out.g.depth.size, counted);
            const gpu::Image soFar = f.image("lit_so_far", VK_FORMAT_R16G16B16A16_SFLOAT, out.g.depth.size);
            screen.light =
                composite(f, out.g, out.direct, out.diffuse, none, in.ggxTable, soFar, {in.view, settings.diffuse.gain})
                    .lit;
        }
        const SpecularSettings& s = settings.specular;
        if (s.rougher == RougherSurfaces::mips && s.maxRoughness < 1.0F && s.rays > 0) {
            screen.coneRoughness = s.maxRoughness;
            screen.lightMips =
                makeLightMips(f, trace.light == HitLight::previous && lit.valid ? lit.previous : screen.light);
        }
        out.specular = traceLobe(lobeSpecular, settings.specular.rays, trace.maxDistance);
    }

    out.light = composite(f, out.g, out.direct, out.diffuse, out.specular, in.ggxTable, lit.next,
                          {in.view, settings.diffuse.gain});
    out.display = tonemap(f, out.light.lit, settings.tonemap);
    return out;
}

}  // namespace reflet
