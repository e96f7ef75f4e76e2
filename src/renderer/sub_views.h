// Settings of the views and layers that a frame renders besides what the camera sees: one function for each kind.
#pragma once

#include "renderer/settings.h"

namespace reflet {

struct DrawList;

/// Layers of translucent surfaces in front of a view. They have no depth pyramid for contact shadows.
Settings layerSettings(Settings settings);
/// Layers of glass: rays read this frame's light, with the glass behind.
Settings glassSettings(const Settings& settings, const DrawList& draws);
/// Rays that a layer of glass has refracted on the screen: the screen first, which alone has the glass behind, also
/// where other rays are for the scene alone (from a camera in a medium; otherwise refractsPaths).
Settings refractedSettings(Settings settings);
/// Clear coats, which have no diffuse base.
Settings coatSettings(const Settings& settings);

/// The far side of surfaces that transmit diffuse light, which is not on the screen.
Settings otherSideSettings(const Settings& settings);

/// Planar reflections, which rays of the frame read. They have no history: `previous` acts as `lit`, and probes add
/// further bounces.
Settings planarSettings(Settings settings);
/// The same for a mirrored copy of the scene, whose triangles are not mirrored for rays.
Settings duplicateSettings(const Settings& settings);
/// Prefiltered diffuse light of probes alone.
Settings probeLightSettings(Settings settings);

/// Live camera images: direct light, translucent surfaces drawn opaque.
Settings liveSettings(Settings settings);
/// Faces of probes: what matters in captures.
Settings captureSettings(Settings settings);

}  // namespace reflet
