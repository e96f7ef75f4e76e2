// Records live camera images.
#include "renderer/live/live_picture.h"

namespace reflet {

void showLive(gpu::PassList& f, gpu::Image radiance, gpu::Image picture) {
    f.compute("live_picture", "live_picture.comp")
        .read("radiance", radiance)
        .write("picture", picture)
        .params(LivePictureParams{picture.size})
        .dispatch(picture.size);
}

}  // namespace reflet
