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

}  // namespace reflet
