// Ray tracing as a source of the frame: passes the frame's view, lights and settings to trace_scene.
#pragma once

#include "effects/lobe/rays.h"
#include "lighting/indirect.h"
#include "renderer/direct_view.h"

namespace reflet {

/// Traces the remaining rays against the BVH, if enabled and there is one. seen: the camera's images of this frame;
/// screen: the inputs of screen-space tracing for this lobe.
void traceSceneFallback(gpu::PassList& f, Rays& rays, const ViewInputs& in, const Settings& settings,
                        const ViewImages& seen, const ScreenImages& screen);

/// Whether paths through the scene are refracted by glass, also those of view rays, instead of the layers' screen-space
/// refraction: with settings whose rays are for the scene alone and bring all bounces. Not for a camera in a medium.
bool refractsPaths(const Settings& settings, const ViewInputs& in);

}  // namespace reflet
