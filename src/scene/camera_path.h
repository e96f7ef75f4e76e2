// Camera motion over time: an orbit, or the keyframes of a JSON file.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// Timing from one keyframe to the next. linear: constant speed; smooth: zero speed at both ends; step: holds, then
/// jumps; easeIn: zero speed at the start; easeOut: zero speed at the end.
enum class Easing : uint8_t { linear, smooth, step, easeIn, easeOut };

/// Camera keyframes. Position, target, up, field of view and lens follow monotone cubics over time (F. N. Fritsch and
/// J. Butland, "A Method for Constructing Local Monotone Piecewise Cubic Interpolants", 1984): smooth through keyframes
/// with linear easing, without overshoot, and constant between two equal keyframes.
class CameraPath {
public:
    struct Keyframe {
        double time = 0.0;  ///< seconds, ascending
        Camera camera;
        Easing easing = Easing::linear;  ///< towards the next
    };

    /// At least one keyframe. A loop has at least two, the last of which equals the first.
    CameraPath(std::vector<Keyframe> keyframes, bool loop);

    /// Clamped to the first and the last keyframe, or repeated if it loops. What is not interpolated (near, the
    /// orthographic height, the number of blades) is taken from the first keyframe. Between keyframes that focus on
    /// different things the camera has both as targets, by their shares.
    [[nodiscard]] Camera at(double time) const;

    /// Throws Error if a keyframe focuses on a node that the scene does not have. file: for the message.
    void checkFocus(const Scene& scene, const std::string& file) const;

private:
    using Values = std::vector<double>;  ///< those of camera_fields.h that are followed

    /// x: share of the way from one keyframe to the next.
    [[nodiscard]] Camera cameraOf(const Values& values, size_t from, size_t to, double x) const;
    void makeTangents();

    std::vector<Keyframe> keyframes_;
    std::vector<Values> values_;    ///< of the keyframes
    std::vector<Values> tangents_;  ///< of the keyframes, per second
    bool loop_;
};

/// { "keyframes": [{ "time": 0, "position": [6,1,0], "target": [0,0,0], "up": [0,1,0], "fov_y": 75,
///                   "easing": "smooth" }], "loop": false }
/// Time, position and target are required; up, fov_y and the lens default to those of `camera`. Angles are in degrees;
/// times are on the scale of View::time. origin: Scene::origin. Throws Error as applyViewFile does.
CameraPath loadCameraPath(const std::filesystem::path& path, const Camera& camera, const glm::dvec3& origin = {});

/// Centre of an orbit: the camera's target or, if the target only gives a direction, the first surface along it, else
/// the point ahead that is nearest to the scene's centre.
vec3 orbitPivot(const Camera& camera, const Scene& scene);

/// The camera rotated about the vertical through the pivot, counter-clockwise as seen from above. turns 1: 360 degrees.
Camera orbit(Camera camera, const vec3& pivot, double turns);

}  // namespace reflet
