// The second depth layer: where what the camera sees ends. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_BACK_DEPTH_H
#define REFLET_RENDER_BACK_DEPTH_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

struct BackDepthParams {
    mat4 worldToClip;
    vec4 depthToDistance;  // as in ViewParams
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/draw_list.h"

namespace reflet {

/// Of each pixel, the depth of the nearest back face behind what the G-buffer shows there: D32, reversed, 0: none.
/// Closed things get their own far side. Behind an open sheet, which has none, lies that of the next thing behind it,
/// or nothing. depth: the G-buffer's own as it was drawn (the same view and list), of the view's size.
gpu::Image drawBackDepth(gpu::Frame& f, const DrawList& list, gpu::Image depth, const ViewParams& view);

}  // namespace reflet
#endif

#endif
