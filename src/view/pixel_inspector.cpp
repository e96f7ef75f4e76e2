// Picks pixels.
#include "view/pixel_inspector.h"

#include "base/error.h"

#include <algorithm>

namespace reflet {

void PixelInspector::pick(uvec2 pixel, bool focuses) {
    render_.post("reading a pixel", RenderThread::AtEnd::drop,
                 [this, pixel, focuses, state = work_.state,
                  size = work_.renderSize()](RenderThread::Work& work) -> RenderThread::Finish {
                     const Picked picked = work.live->pick(state, size, pixel);
                     return [this, picked, focuses] {
                         picked_ = picked;
                         if (focuses) {
                             focusOnPicked();
                         }
                     };
                 });
}

// Focuses on the plane through the surface of the picked pixel.
void PixelInspector::focusOnPicked() {
    const auto depth = std::ranges::find(picked_->values, "depth", &PickedValues::name);
    if (depth == picked_->values.end() || !(depth->values.front() > 0.0F)) {
        fail("pixel {}, {} shows no surface to focus on: click on one", picked_->pixel.x, picked_->pixel.y);
    }
    work_.focusAt(depth->values.front());
    work_.tell(work_.state.view.camera.apertureRadius > 0.0F
                   ? fmt::format("Focus at {:.3f} m", depth->values.front())
                   : fmt::format("Focus at {:.3f} m; the camera is a pinhole until it has an aperture",
                                 depth->values.front()));
}

// Whether the picked pixel still belongs to the recorded ray: false once the camera or the size has changed.
bool PixelInspector::isPickedView() const {
    return picked_->view.worldToClip == work_.live().view.worldToClip && picked_->view.size == work_.live().view.size;
}

bool PixelInspector::update() {
    if (!picked_ || picked_->change == work_.live().changes || !isPickedView()) {
        return false;
    }
    pick(picked_->pixel, false);
    return true;
}

}  // namespace reflet
