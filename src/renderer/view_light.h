// Lighting steps shared by the camera's view and planar reflections.
#pragma once

#include "renderer/blend/blend_layers.h"
#include "renderer/trace_lobe.h"

namespace reflet {

/// Which rays read the radiance of a view's screen-space hits.
enum class ScreenReaders : uint8_t {
    own,     ///< rays of the view itself, if any do
    others,  ///< rays of another view
};

/// Lights the blended surfaces, and sets the light that reflections read at hits: all light so far, with blended
/// surfaces in front; and its mips for cones. layers: also returns the parts of the blended surfaces' light.
BlendedSurfaces lightForReflections(gpu::PassList& f, const ViewInputs& in, const Settings& settings,
                                    const LobeLight& diffuse, TracedView& seen, ScreenReaders readers, bool layers);

/// Adds the glass in front to the light that reflections read at hits, if they read this frame's light: the last
/// frame's includes it already.
void addGlassForReflections(gpu::PassList& f, const ViewInputs& in, const Settings& settings, TracedView& seen);

}  // namespace reflet
