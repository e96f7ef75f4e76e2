// Steps of lighting that the camera's view and planar reflections share.
#pragma once

#include "renderer/blend/blend_layers.h"
#include "renderer/trace_lobe.h"

namespace reflet {

/// Which rays read the radiance of a view's screen-space hits.
enum class ScreenReaders : uint8_t {
    own,     ///< those of the view itself, if any do
    others,  ///< rays of another view
};

/// Lights the blended surfaces, and sets the light that reflections read at hits: all light so far, with blended
/// surfaces in front; and its mips for cones. layers: the parts of the blended surfaces' light, too.
BlendedSurfaces lightForReflections(gpu::PassList& f, const ViewInputs& in, const Settings& settings,
                                    const LobeLight& diffuse, TracedView& seen, ScreenReaders readers, bool layers);

/// Sets the light that reflections read at hits to that of this frame with the glass in front, if they read this
/// frame's at all: the last frame's has it already.
void addGlassForReflections(gpu::PassList& f, const ViewInputs& in, const Settings& settings, TracedView& seen);

}  // namespace reflet
