// Ray generation: for lists of rays that sources answer in turn, or with tracing and averaging in the same pass.
#pragma once

#include "effects/environment/environment_light.h"
#include "effects/lobe/answer_environment.h"
#include "effects/lobe/rays.h"
#include "effects/lobe/trace_screen.h"

namespace reflet {

/// The screen as the first source of rays.
struct ScreenSource {
    const ScreenImages* images = nullptr;  ///< none: the screen is not traced
    TraceScreenSettings settings;
    float longest = 0.0F;  ///< maximum ray length [m]
};

/// The environment as the last source of rays.
struct EnvironmentSource {
    const EnvironmentLight& light;
    EnvironmentSettings settings;
};

struct RayGeneration {
    RaySurfaces from;
    RayTiles tiles;             ///< of classifyTiles
    gpu::Image ggxTable;        ///< of ggxTable
    gpu::BufferView blueNoise;  ///< noise/blue_noise.h
    RayNoise noise = RayNoise::blue;
    uint32_t lobe = lobeDiffuse;
    GenerateRaysParams params;  ///< `view` is set from `from`
    gpu::Image imageMotion;     ///< of Rays
    bool countSteps = false;    ///< count the depth samples of each ray
    bool directional = false;   ///< of Rays
};

/// Binds what passes that include diffuse_ray.glsl read: noise, tiles, depth and normals of the surfaces.
gpu::ComputePass& bindDiffuseRays(gpu::ComputePass& pass, const RayGeneration& in);

/// The images and the empty list of the rays, not yet generated.
Rays raysOf(gpu::PassList& f, const RayGeneration& in);

/// Generates rays firstRay .. firstRay + rayCount for every pixel of `from` with a surface (and the lobe), up to its
/// tile's rays per pixel.
Rays generateRays(gpu::PassList& f, const RayGeneration& in);

/// Generates the same rays, has only screen and environment answer them, and averages them as resolveRays does, all in
/// one pass that writes no ray to memory. The result is that of the separate passes, up to their rounding of directions
/// and radiance. Not for tiles whose rays per pixel change from frame to frame (RayTiles::meanRays).
void traceAtOnce(gpu::PassList& f, const LobeLight& light, const RayGeneration& in, const ScreenSource& screen,
                 const EnvironmentSource& environment);

}  // namespace reflet
