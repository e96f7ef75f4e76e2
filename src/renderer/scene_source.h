// Ray tracing as a fallback source: passes the frame's view, lights and settings to trace_scene.
#pragma once

#include "effects/lobe/rays.h"
#include "lighting/indirect.h"
#include "renderer/direct_view.h"

namespace reflet {

/// Traces the remaining rays against the BVH, if enabled and built. seen: the camera's images of this frame; screen:
/// the inputs of screen-space tracing for this lobe.
void traceSceneFallback(gpu::PassList& f, Rays& rays, const ViewInputs& in, const Settings& settings,
                        const ViewImages& seen, const ScreenImages& screen);

/// Whether ray-traced paths, including view rays, are refracted by glass, instead of screen-space refraction in layers:
/// with settings that trace all rays against the BVH, for all bounces. Not for a camera in a medium.
bool refractsPaths(const Settings& settings, const ViewInputs& in);

}  // namespace reflet
