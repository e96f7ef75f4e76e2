// Ray generation, which may also trace the screen in the same pass.
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
    ScreenSource screen;
    EnvironmentSource environment;
};

/// Generates rays firstRay .. firstRay + rayCount for every pixel of `from` with a surface (and the lobe), up to its
/// tile's rays per pixel. With a screen, these have its answers, and only its misses wait. The images live as long as
/// `scratch`.
Rays generateRays(gpu::Recorder& f, gpu::Scratch& scratch, const RayGeneration& in);

/// The same for rays that only screen and environment answer, averaged into the lobe's images as resolveRays does: no ray
/// is written to memory. The mean is that of the separate passes up to their rounding to half floats and of directions.
LobeLight traceAtOnce(gpu::Recorder& f, LobeLightStore& own, const RayGeneration& in);

}  // namespace reflet
