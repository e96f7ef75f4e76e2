// Computes the matrices of an image's camera.
#include "scene/image_camera.h"

namespace reflet {

ImageCamera imageCamera(const View& view, uvec2 size) {
    using glm::dmat4;
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const dmat4 toView = dmat4(worldToView(view.camera)) * glm::translate(dmat4(1.0), -view.origin);
    const dmat4 ahead = glm::scale(dmat4(1.0), glm::dvec3(1, 1, -1));
    const dmat4 toUv =
        glm::translate(dmat4(1.0), glm::dvec3(0.5, 0.5, 0)) * glm::scale(dmat4(1.0), glm::dvec3(0.5, 0.5, 1));
    return {mat4(ahead * toView), mat4(toUv * dmat4(viewToClip(view.camera, aspect)) * toView)};
}

}  // namespace reflet
