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

/// Renders the frames of this share whose files are missing. Throws Error when interrupted. Returns how many it wrote.
uint32_t renderSequence(const RenderJob& job);

}  // namespace reflet
