// Cameras and inputs for rendering planar reflections.
#pragma once

#include "renderer/direct_view.h"
#include "renderer/planar_views/mirrors.h"

namespace reflet {

/// The camera reflected in the mirror's plane, cropped to the mirror plus the margin (which may extend beyond the
/// screen) and resized by the scale. The image is flipped left to right, so that front faces stay counter-clockwise.
ViewParams mirroredView(const ViewParams& view, const Mirror& mirror, const PlanarSettings& settings);

/// The unmirrored camera, cropped and scaled in the same way.
ViewParams croppedView(const ViewParams& view, const Mirror& mirror, const PlanarSettings& settings);

/// An upright camera at the mirror's centre that looks along its normal.
Camera mirrorCamera(const Mirror& mirror, const PlanarSettings& settings);

/// A mirrored copy of all draws and lights. largestSide: as for planLampShadows.
struct MirroredScene {
    DrawList draws;
    LampBlock lamps;
    LampShadows lampShadows;
    vec3 sunDirection;
};
MirroredScene mirroredScene(const ViewInputs& in, const Mirror& mirror, const ShadowSettings& settings,
                            uint32_t largestSide);

/// Inputs of a planar view rendered by the mirrored camera (forms traced, lookup) or by the mirror's own camera (form
/// camera).
ViewInputs mirrorViewInputs(const ViewInputs& in, const Mirror& mirror, const PlanarSettings& settings);

/// Inputs of a planar view for form duplicate. Keeps references into `room`.
ViewInputs duplicateViewInputs(const ViewInputs& in, const Mirror& mirror, const PlanarSettings& settings,
                               const MirroredScene& room);

MirrorParams mirrorParams(const Mirror& mirror, const PlanarSettings& settings);

/// Reflection in the plane, world space to world space.
mat4 reflectionIn(const vec4& plane);

}  // namespace reflet
