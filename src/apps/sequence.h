// Sequences: one file per frame, resumed where they stopped, and dealt to several processes.
#pragma once

#include "apps/pictures.h"
#include "apps/render_options.h"
#include "apps/timings.h"
#include "gpu/device.h"
#include "render/renderer.h"

namespace reflet {

/// What renders a picture.
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

/// Whether the outputs are sequences. Throws UsageError where some are and some are not, or for options that do not go
/// together.
bool isSequence(const RenderOptions& options);

/// Renders the frames of this share whose files are not there. Throws Error when it was interrupted.
/// Returns whether there was anything to do.
bool renderSequence(const RenderJob& job);

}  // namespace reflet
