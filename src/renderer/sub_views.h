// Settings of the secondary views and layers that a frame renders, one function for each kind.
#pragma once

#include "renderer/settings.h"

namespace reflet {

struct DrawList;

/// Layers of translucent surfaces in front of a view. They have no depth pyramid for contact shadows.
Settings layerSettings(Settings settings);
/// Layers of glass: rays read this frame's light, with the glass behind.
Settings glassSettings(const Settings& settings, const DrawList& draws);
/// Rays refracted by a layer of glass: the screen first, even if other rays are traced only against the BVH, because
/// only the screen has the glass behind (for a camera in a medium; otherwise see refractsPaths).
Settings refractedSettings(Settings settings);
/// Clear coats, which have no diffuse base.
Settings coatSettings(const Settings& settings);

/// The far side of surfaces that transmit diffuse light, which is not on the screen.
Settings otherSideSettings(const Settings& settings);

/// Planar reflections, which rays of the frame read. They have no history: trace_screen.light `previous` acts as `lit`,
/// and probes add further bounces.
Settings planarSettings(Settings settings);
/// The same for a mirrored copy of the scene, whose triangles are not mirrored for rays.
Settings duplicateSettings(const Settings& settings);
/// Only prefiltered diffuse light of probes.
Settings probeLightSettings(Settings settings);

/// Live camera images: direct light, translucent surfaces drawn opaque.
Settings liveSettings(Settings settings);
/// Faces of probes: only settings that affect captures.
Settings captureSettings(Settings settings);

}  // namespace reflet
