// Records slices as the first source of diffuse rays, and ambient visibility by slices.
#include "effects/lobe/trace_slices.h"

#include <algorithm>

namespace reflet {

namespace {

gpu::ComputePass& bindSlices(gpu::ComputePass& pass, const RayGeneration& in, const SliceTracing& slices) {
    return bindDiffuseRays(pass, in)
        .constant("countSteps", in.countSteps ? 1U : 0U)
        .constant("sliceHorizon", slices.horizon ? 1U : 0U)
        .constant("sliceThickness", slices.thickness)
        .read("backDepth", slices.backDepth ? slices.backDepth : in.from.g.depth)
        .params(TraceSlicesParams{slices.slice, in.from.scale, blockPixelOffset(in.from.scale)});
}

// What slices of light read, of the grid that they start from.
gpu::Image packSlices(gpu::PassList& f, const RaySurfaces& from, const ScreenSource& screen) {
    const uvec2 size = from.g.depth.size;
    const gpu::Image packed = f.image("slices", VK_FORMAT_R32G32B32A32_UINT, size);
    gpu::ComputePass pass = f.compute("pack_slices", "pack_slices.comp");
    bindScreenLight(f, pass, *screen.images, {.own = from.view, .settings = screen.settings, .longest = screen.longest})
        .read("ownDepth", from.g.depth)
        .read("ownGeometricNormal", from.g.geometricNormal)
        .write("packed", packed)
        .params(PickSurfacesParams{uvec2(screen.images->view.size), size, from.scale, blockPixelOffset(from.scale)},
                "picks")
        .dispatch(size);
    return packed;
}

SliceTracing slicesOf(const ScreenSource& screen, uint32_t steps) {
    const TraceScreenSettings& s = screen.settings;
    return {.slice = {steps, std::min(screen.longest, s.maxDistance), 0.0F, s.thickness},
            .thickness = screen.images->backDepth ? sliceThicknessLayer : sliceThicknessConstant};
}

// packed: none for ambient visibility.
void atOnce(gpu::PassList& f, const LobeLight& light, const RayGeneration& in, const SliceTracing& slices,
            gpu::Image packed, bool rejectsBackfaces, const EnvironmentSource& environment) {
    const uvec2 size = in.from.g.depth.size;
    gpu::ComputePass pass = f.compute("slices_at_once", "slices_at_once.comp");
    bindSlices(pass, in, slices);
    bindEnvironment(pass, environment.light);
    bindEnvironmentLobes(pass, f.context(), environment.light);
    bindMeans(f, pass, light, in.params.firstRay)
        .constant("spreads", 0U)
        .read("ownMaterial", in.from.g.material)
        .constant("ambient", packed ? 0U : 1U)
        .constant("sliceLight", packed ? 1U : 0U)
        .constant("rejectsBackfaces", rejectsBackfaces ? 1U : 0U)
        .constant("environmentLights", environment.settings.enabled)
        .read("packed", packed ? packed : f.placeholder(VK_FORMAT_R32G32B32A32_UINT))
        .params(AnswerEnvironmentParams{environment.settings}, "environmentAnswer")
        .dispatchStrips(size);
}

}  // namespace

Rays startSlices(gpu::PassList& f, const RayGeneration& in, const ScreenSource& screen, uint32_t steps) {
    Rays rays = raysOf(f, in);
    gpu::Image turning = f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT, gpu::ViewKind::array);
    if (in.directional) {
        turning = f.image("ray_turning", VK_FORMAT_R16G16B16A16_SFLOAT, in.from.g.depth.size, in.params.rayCount, true);
        rays.turning = turning;
    }
    const gpu::Image packed = packSlices(f, in.from, screen);
    gpu::ComputePass pass = f.compute("start_slices", "start_slices.comp");
    bindSlices(pass, in, slicesOf(screen, steps))
        .constant("hasDirectional", in.directional ? 1U : 0U)
        .constant("rejectsBackfaces", screen.settings.rejectBackfaces)
        .read("packed", packed)
        .write("direction", rays.direction)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .write("turning", turning)
        .write("steps", rays.steps)
        .write("missed", rays.waiting)
        .dispatchStrips(in.from.g.depth.size);
    return rays;
}

void slicesAtOnce(gpu::PassList& f, const LobeLight& light, const RayGeneration& in, const ScreenSource& screen,
                  uint32_t steps, const EnvironmentSource& environment) {
    const gpu::Image packed = packSlices(f, in.from, screen);
    atOnce(f, light, in, slicesOf(screen, steps), packed, screen.settings.rejectBackfaces != 0, environment);
}

LobeLight ambientSlices(gpu::PassList& f, const RayGeneration& in, const SliceTracing& slices) {
    const gpu::Image unread = f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT);
    const gpu::Image unreadCube = f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT, gpu::ViewKind::cubeArray);
    const EnvironmentLight white{unread, unreadCube, unread, {}};
    LobeLight light = lobeImages(f, in.from, in.countSteps, in.directional);
    light.tiles = in.tiles;
    atOnce(f, light, in, slices, {}, false, {white, {}});
    return light;
}

}  // namespace reflet
