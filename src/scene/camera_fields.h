// The table of a camera's fields. View files, keyframes of camera paths, records of sequences, fingerprints and the
// window take them from here, so a new field is one line in camera_fields.cpp.
#pragma once

#include "scene/camera.h"

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace reflet {

struct CameraField {
    enum class Part : uint8_t { placement, perspective, orthographic, always, lens };
    enum class Kind : uint8_t {
        position,
        direction,
        number,
        angle,  ///< degrees in files and in the window, radians in the camera
        count,
    };

    const char* key;  ///< in view files, keyframes and records
    std::variant<vec3 Camera::*, float Camera::*, uint32_t Camera::*> member;
    Part part;
    Kind kind;
    double min = 0.0;  ///< of a number, in the file's unit
    double max = 0.0;
    const char* unit = "";
    bool inFiles = true;    ///< a view file may set it
    bool followed = false;  ///< keyframes may set it, and paths interpolate it
};

std::span<const CameraField> cameraFields();

/// The keys of those fields that a view file (or, else, a keyframe) may set.
std::vector<std::string> cameraFileKeys(bool keyframe);

/// The values that paths interpolate, in the table's order, and the camera with these values.
std::vector<double> followedValues(const Camera& camera);
Camera withFollowedValues(Camera camera, std::span<const double> values);

/// Whether the field says something about this camera: the field of view of an orthographic one does not, nor the
/// aperture of a pinhole.
bool applies(const CameraField& field, const Camera& camera);

}  // namespace reflet
