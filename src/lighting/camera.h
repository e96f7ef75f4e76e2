// A camera as the stages see it, from its matrices.
#pragma once

#include "effects/view.h"

namespace reflet::lighting {

/// worldToView: a rotation and a translation. viewToClip: with y down and reversed depth, without jitter. The last
/// frame's matrix is this one's. The eye, depthToDistance and pixelAngle are as exact as matrices of floats tell: a
/// caller that knows them better sets them.
ViewParams viewOf(const mat4& worldToView, const mat4& viewToClip, uvec2 size);

}  // namespace reflet::lighting
