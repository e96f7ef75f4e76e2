// Reprojection of static surfaces and the background: matrices from clip space to the last frame's clip space.
#pragma once

#include "effects/view.h"

namespace reflet {

/// Whether the background has moved in the picture. Never for orthographic cameras, which have one view direction.
inline bool movesSky(const ViewParams& view) {
    return view.eye.w != 0.0F && view.worldToClip != view.previousWorldToClip;
}

/// Reprojection matrix of static surfaces; exactly the identity for a still camera.
inline mat4 restToPreviousClip(const ViewParams& view) {
    return view.worldToClip != view.previousWorldToClip
               ? mat4(glm::dmat4(view.previousWorldToClip) * glm::dmat4(view.clipToWorld))
               : mat4(1.0F);
}

/// Reprojection matrix of the background.
inline mat4 toPreviousClip(const ViewParams& view) {
    return movesSky(view) ? restToPreviousClip(view) : mat4(1.0F);
}

}  // namespace reflet
