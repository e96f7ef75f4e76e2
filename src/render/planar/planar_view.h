// Cameras that see what mirrors show, and what they draw.
#pragma once

#include "render/direct_view.h"
#include "render/planar/mirrors.h"

namespace reflet {

/// The camera mirrored in the mirror's plane: of its picture, what lies about the mirror (with the margin, which may
/// reach beyond the screen), as wide as the scale says. The picture is turned left to right, so that it is that of a
/// camera like all others: front faces stay counter-clockwise.
ViewParams mirroredView(const ViewParams& view, const Mirror& mirror, const PlanarSettings& settings);

/// The camera itself, cut and scaled alike.
ViewParams croppedView(const ViewParams& view, const Mirror& mirror, const PlanarSettings& settings);

/// A camera at the middle of the mirror, upright, that looks straight out of it.
Camera mirrorCamera(const Mirror& mirror, const PlanarSettings& settings);

/// Everything that is drawn, once more behind the mirror, and the lights with it. largestSide: as of planLampShadows.
struct MirroredScene {
    DrawList draws;
    LampBlock lamps;
    LampShadows lampShadows;
    vec3 sunDirection;
};
MirroredScene mirroredScene(const ViewInputs& in, const Mirror& mirror, const ShadowSettings& settings,
                            uint32_t largestSide);

/// What the mirror's view is made from: by the mirrored camera (traced, lookup), or by the mirror's own (camera).
ViewInputs mirrorViewInputs(const ViewInputs& in, const Mirror& mirror, const PlanarSettings& settings);

/// And what a duplicate is made from. Refers to the room.
ViewInputs duplicateViewInputs(const ViewInputs& in, const Mirror& mirror, const PlanarSettings& settings,
                               const MirroredScene& room);

MirrorParams mirrorParams(const Mirror& mirror, const PlanarSettings& settings);

/// World space to world space: mirrors points in the plane.
mat4 reflectionIn(const vec4& plane);

}  // namespace reflet
