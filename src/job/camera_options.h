// Command line options of camera and sun: angles around the scene instead of coordinates. They apply after the view
// file.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace reflet {

struct CameraOptions {
    std::string orbit;   ///< "AZIMUTH,ELEVATION" or "AZIMUTH,ELEVATION,DISTANCE"; empty: the camera stays
    std::string lookAt;  ///< "X,Y,Z" in metres, in the coordinates of the file, or the name of a node with a mesh
    std::optional<double> fov;      ///< degrees, vertical
    std::optional<double> zoom;     ///< magnification of the picture's middle; 2: twice as large
    std::optional<double> fNumber;  ///< f-number of a full-frame lens
    std::string focus;              ///< focus distance in metres, or the point "X,Y,Z" or a name as in lookAt
    std::string sun;                ///< "AZIMUTH,ELEVATION": where it is seen from the scene
    bool wholeTurn = false;         ///< if the scene is framed: frame it for a camera that orbits it

    /// Whether any option changes the view.
    [[nodiscard]] bool any() const;
};

/// Azimuth in degrees from the front (+Z) to the right (+X), elevation above the horizon.
struct Direction {
    static constexpr double largestAzimuth = 360.0;
    static constexpr double largestElevation = 90.0;

    double azimuth = 0.0;
    double elevation = 0.0;
};

/// The unit vector from the middle of the scene in this direction, and the inverse (azimuth -180 to 180).
glm::dvec3 unitVector(const Direction& direction);
Direction directionOf(const glm::dvec3& vector);

/// Parses the direction of --orbit or --sun, without the distance. Throws UsageError that names the ranges.
Direction parseDirection(const std::string& text, const std::string& option);

/// Places the camera. A camera without an interest (of a glTF file, or `automatic`: made by framingCamera) orbits the
/// scene and frames it, unless a distance is given; others orbit their target at its distance. aspect: width / height
/// of the image. Throws UsageError that names the ranges, Error for a node that the scene does not have.
void placeCamera(const CameraOptions& options, const Scene& scene, float aspect, bool automatic, View& view);

/// Turns the sun, and detaches it from its node.
void placeSun(const CameraOptions& options, View& view);

}  // namespace reflet
