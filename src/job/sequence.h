// Renders sequences: one file per frame, resumable, and divisible among several processes.
#pragma once

#include "capture/pictures.h"
#include "capture/timings.h"
#include "device/device.h"
#include "job/render_options.h"
#include "renderer/renderer.h"

namespace reflet {

/// Everything needed to render images.
struct RenderJob {
    const RenderOptions& options;
    const Scene& scene;
    const View& view;
    const Settings& settings;
    uvec2 size;
    gpu::Device& device;
    Renderer& renderer;
    Pictures& pictures;
    Timings& timings;
};

/// Renders the frames of this share whose files are missing. Throws Error when interrupted. Returns whether there was
/// anything to do.
bool renderSequence(const RenderJob& job);

}  // namespace reflet
