// The second depth layer: the back faces of visible objects, for their thickness. Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_BACK_DEPTH_H
#define REFLET_RENDERER_BACK_DEPTH_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

struct BackDepthParams {
    mat4 worldToClip;
    vec4 depthToDistance;  // as in ViewParams
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"
#include "renderer/draw_list.h"

namespace reflet {

/// Depth of the nearest back face behind the G-buffer's surface, per pixel: D32, reversed, 0: none. For closed objects
/// that is their own far side; for open sheets it is the far side of the next object behind, if any. depth: the
/// G-buffer's depth as rendered (same view and list), of the view's size. withoutGlass: as for the G-buffer.
gpu::Image drawBackDepth(gpu::PassList& f, const DrawList& list, gpu::Image depth, const ViewParams& view,
                         bool withoutGlass = false);

}  // namespace reflet
#endif

#endif
