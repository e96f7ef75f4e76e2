// Where a camera is over time: round its target, or from keyframe to keyframe of a JSON file.
#pragma once

#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace reflet {

/// How time passes from a keyframe to the next. linear: evenly; smooth: rests at both; step: stays, then jumps;
/// easeIn: rests at the first; easeOut: rests at the second.
enum class Easing : uint8_t { linear, smooth, step, easeIn, easeOut };

/// Keyframes of a camera. Between them position, target, up and field of view follow monotone cubics over time (F. N.
/// Fritsch and J. Butland, "A Method for Constructing Local Monotone Piecewise Cubic Interpolants", 1984): smooth
/// through every keyframe that is passed evenly, never beyond two neighbours, and still between two that are the same.
class CameraPath {
public:
    struct Keyframe {
        double time = 0.0;  ///< seconds, more than that of the one before
        Camera camera;
        Easing easing = Easing::linear;  ///< on the way to the next
    };

    /// At least one keyframe. In a loop, of at least two, the last one is where the first one is.
    CameraPath(std::vector<Keyframe> keyframes, bool loop);

    /// Before the first keyframe the first, after the last the last; in a loop round and round. What keyframes do not
    /// say (near, the orthographic height) is the first one's.
    [[nodiscard]] Camera at(double time) const;

private:
    static constexpr size_t valueCount = 10;
    using Values = std::array<double, valueCount>;  ///< position, target, up, fovY

    static Values valuesOf(const Camera& camera);
    [[nodiscard]] Camera cameraOf(const Values& values) const;
    void makeTangents();

    std::vector<Keyframe> keyframes_;
    std::vector<Values> values_;    ///< of the keyframes
    std::vector<Values> tangents_;  ///< of the keyframes, per second
    bool loop_;
};

/// { "keyframes": [{ "time": 0, "position": [6,1,0], "target": [0,0,0], "up": [0,1,0], "fov_y": 75,
///                   "easing": "smooth" }], "loop": false }
/// Time, position and target must be given; up and fov_y are those of `camera` if not. Angles in degrees; times are
/// View::time. Throws Error as applyViewFile does.
CameraPath loadCameraPath(const std::filesystem::path& path, const Camera& camera);

/// What an orbit goes round: the camera's target, or, if that is only some point ahead, what it sees there.
vec3 orbitPivot(const Camera& camera, const Scene& scene);

/// The camera turned about the vertical line through the pivot, counter-clockwise as seen from above. 1: all round.
Camera orbit(Camera camera, const vec3& pivot, double turns);

}  // namespace reflet
