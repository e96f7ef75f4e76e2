// Live camera images: the view of a scene camera, shown on surfaces whose material names it. Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_LIVE_PICTURE_H
#define REFLET_RENDERER_LIVE_PICTURE_H

#include "base/shared.h"

SHARED_BEGIN

#define LIVE_SETTINGS(VALUE, SWITCH, CHOICE) \
    VALUE(uint, height, 180, 9, 1080,        \
          "Height in pixels of live camera images shown by materials; their aspect ratio is 16:9.")
SETTINGS(LiveSettings, LIVE_SETTINGS)

struct LivePictureParams {
    uvec2 size;
};

SHARED_END

#ifdef __cplusplus

#include "effects/view.h"
#include "gpu/pass_list.h"

namespace reflet {

/// A camera image, rendered before the surfaces that show it.
struct LiveView {
    ViewParams view;     ///< of the image's size
    gpu::Image picture;  ///< RGBA16F, storage; persists until the next frame
};

/// Copies radiance (RGBA16F, same size) to the picture.
void showLive(gpu::PassList& f, gpu::Image radiance, gpu::Image picture);

}  // namespace reflet
#endif

#endif
