// The camera of a scene that brings none: three-quarter view, as near as the whole picture allows.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <vector>

namespace reflet {

/// What is framed fills this share of the image's width or height, whichever it reaches first, and is centred.
constexpr float framedShare = 0.85F;

/// The nearest perspective camera that looks along `forward` (unit length, not parallel to `up`) and has all points, in
/// world space, within the middle `framedShare` of the image. Without points, or if they coincide: one that looks at
/// them.
Camera fitCamera(const std::vector<vec3>& points, const vec3& forward, float fovY, float aspect,
                 const vec3& up = vec3(0, 1, 0));

/// Frames the posed vertices at that time [s], from where their front faces are seen: from the front (+Z), the right
/// and slightly above, unless that shows less than 60 % of what another side does. Flat ground planes more than
/// five times, and sky domes more than ten times as large as everything else are not framed. The camera is inside a
/// closed room that shows only the backs of its walls. aspect: width / height of the image, > 0.
Camera framingCamera(const Scene& scene, float aspect, double time = 0.0);

/// Moves a camera, perspective or orthographic, without turning it, to where it frames the same vertices; detaches it
/// from its node. An empty scene leaves it where it is.
void frameScene(Camera& camera, const Scene& scene, float aspect, double time = 0.0);

/// A camera that goes around the scene, or turns within it.
struct TurningCamera {
    Camera camera;
    vec3 pivot{0.0F};  ///< on the vertical axis that it goes around: its target; or its own position
};

/// The nearest camera from which a whole turn frames the same vertices: the axis is the middle of their bounds. It
/// looks along `forward` (unit length, not vertical), or, without one, along the direction of framingCamera. Without
/// `forward`, the camera of a closed room is inside and turns around itself. fovY: 0: the usual one.
TurningCamera turningCamera(const Scene& scene, float aspect, double time, const std::optional<vec3>& forward,
                            float fovY = 0.0F, const vec3& up = vec3(0, 1, 0));

/// The default view (scene.h) of images of that aspect, if not 16:9.
View defaultView(const Scene& scene, float aspect);

}  // namespace reflet
