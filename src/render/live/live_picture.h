// Live pictures: what a camera of the scene sees, on the surfaces whose material names it. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_LIVE_PICTURE_H
#define REFLET_RENDER_LIVE_PICTURE_H

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

#include "gpu/frame.h"
#include "render/view.h"

namespace reflet {

/// A picture to be drawn before what shows it.
struct LiveView {
    ViewParams view;     ///< of the picture's size
    gpu::Image picture;  ///< RGBA16F, storage; it keeps what it shows until the next frame
};

/// Puts radiance (RGBA16F, of its size) into the picture.
void showLive(gpu::Frame& f, gpu::Image radiance, gpu::Image picture);

}  // namespace reflet
#endif

#endif
