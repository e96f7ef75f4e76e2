// The scene as the frame's source of answers: what trace_scene is told of the frame's view, lights and settings.
#pragma once

#include "render/bounce/trace_screen.h"
#include "render/frame.h"

namespace reflet {

/// Answers what waits, where the settings say so and there is a scene to trace. seen: what the camera sees, of this
/// frame; screen: what the screen's source was given for this lobe.
void traceSceneFallback(gpu::Frame& f, Rays& rays, const ViewInputs& in, const Settings& settings,
                        const ViewImages& seen, const ScreenImages& screen);

}  // namespace reflet
