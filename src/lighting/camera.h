// Makes ViewParams for the stages from a camera's matrices.
#pragma once

#include "effects/view.h"

namespace reflet::lighting {

/// worldToView: a rotation and a translation. viewToClip: with y down and reversed depth, without jitter. The last
/// frame's matrix is set to this one. eye, depthToDistance and pixelAngle are derived from float matrices: a caller
/// with more precise values should set them.
ViewParams viewOf(const mat4& worldToView, const mat4& viewToClip, uvec2 size);

}  // namespace reflet::lighting
