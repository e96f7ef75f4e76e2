// The camera and its thin lens. Plain values; scene/camera_fields.h lists them for files, paths and fingerprints.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

/// What a lens focuses on. scene/focus.h turns it into a distance.
struct FocusTarget {
    enum class Kind : uint8_t {
        automatic,  ///< the camera's target if the camera aims, else the scene's centre
        distance,
        point,
        node,  ///< the centre of all instances of that name
    };

    Kind kind = Kind::automatic;
    float distance = 0.0F;  ///< metres along the view axis
    vec3 point{0.0F};       ///< world space
    std::string node;
    float weight = 1.0F;  ///< of several targets between which the focus moves

    bool operator==(const FocusTarget&) const = default;
};

/// Perspective where orthographicHeight is 0, with reversed depth and an infinite far plane. A new field needs a line
/// in scene/camera_fields.cpp, which does not compile without.
struct Camera {
    static constexpr uint32_t fewestBlades = 3;
    static constexpr uint32_t mostBlades = 16;

    std::string name;
    vec3 position{0, 0, 5};
    vec3 target{0.0F};  ///< any point on the view axis ahead of the position
    vec3 up{0, 1, 0};   ///< not parallel to the view
    float fovY = glm::radians(60.0F);
    float near = 0.05F;               ///< metres, > 0
    float orthographicHeight = 0.0F;  ///< metres from the lower to the upper edge; > 0: orthographic
    float far = 1000.0F;              ///< metres; orthographic only
    bool aims = true;                 ///< the target is a point of interest; false: only its direction counts
    int32_t node = -1;                ///< index into Scene::nodes that it moves with; < 0: none

    float apertureRadius = 0.0F;  ///< metres; 0: a pinhole, everything is sharp
    float focusDistance =
        0.0F;             ///< metres along the view axis; 0: automatic. `posed` replaces it where `focus` says so
    uint32_t blades = 0;  ///< of the aperture: a regular polygon, its corners on the circle; 0: round
    float bladeRotation = 0.0F;      ///< counter-clockwise as the camera sees it; 0: a corner at the right
    std::vector<FocusTarget> focus;  ///< empty: focusDistance counts

    bool operator==(const Camera&) const = default;
};

/// Radius in metres of the aperture of a perspective lens of that f-number, whose sensor is that high:
/// f / (2 N) with the focal length f = sensorHeight / (2 tan(fovY / 2)).
float apertureOfFNumber(float fNumber, float fovY, float sensorHeightMillimetres);

/// Signed radius in pixels of the circle of confusion of a point at distance z [m] along the view axis: positive behind
/// the plane of focus, negative in front of it. z may be infinite. imageHeight: in pixels. Needs focusDistance > 0
/// unless the camera is a pinhole. Perspective: scale * (1 - focusDistance / z), with scale = circleOfConfusionScale.
/// Orthographic: scale * (z - focusDistance), in which scale is pixels per metre of distance.
float circleOfConfusion(const Camera& camera, float z, float imageHeight);

/// The factor in that formula: perspective: apertureRadius / focusDistance * imageHeight / (2 tan(fovY / 2)) pixels,
/// the radius at infinity; orthographic: apertureRadius / focusDistance * imageHeight / orthographicHeight, pixels per
/// metre.
float circleOfConfusionScale(const Camera& camera, float imageHeight);

}  // namespace reflet
