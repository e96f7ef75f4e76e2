// Records the import of a host's own light, and names it as sources of rays.
#include "lighting/host_sources.h"

#include "lighting/host_images.h"

namespace reflet::lighting {

RaySources sourcesOf(const HostLight& light) {
    RaySources sources{.mirrors = light.mirrors, .mirrorsFirst = light.mirrorsFirst, .others = {}};
    if (light.image.light) {
        sources.others.emplace_back(
            [image = light.image](gpu::PassList& f, Rays& rays) { answerFromImage(f, rays, image); });
    }
    if (light.probes) {
        sources.others.emplace_back(
            [probes = light.probes](gpu::PassList& f, Rays& rays) { answerProbes(f, rays, probes); });
    }
    return sources;
}

PlanarView importPlanarView(gpu::PassList& f, const LightingSettings& settings, const HostPlanarView& host,
                            float maxRadiance) {
    const auto scope = f.scope("planar");
    ImportParams params{};
    params.view = host.view;
    params.normalToWorld = mat4(1.0F);
    const HostSurfaces seen{.depth = host.depth, .reversed = host.reversed, .normal = {}};
    Surfaces surfaces = lighting::importSurfaces(f, seen, params);
    const gpu::Image light = lighting::importLight(f, host.color, {.maxRadiance = maxRadiance});
    const ViewContext context{.view = host.view, .environment = {}, .ggxTable = {}, .blueNoise = {}};
    PlanarView view{};
    view.seen = screenOf(f, context, settings, surfaces, light, {});
    addPyramidOfPlanarView(f, settings, surfaces, view.seen);
    prefilterLight(f, settings, view.seen);
    view.mirror.plane = host.plane;
    view.mirror.tolerance = host.tolerance;
    return view;
}

}  // namespace reflet::lighting
