// The table of a camera's fields.
#include "scene/camera_fields.h"

#include "base/error.h"
#include "scene/json_values.h"

#include <array>

namespace reflet {

namespace {

using Kind = CameraField::Kind;
using Part = CameraField::Part;

constexpr std::array fields{
    CameraField{.key = "position",
                .member = &Camera::position,
                .part = Part::placement,
                .kind = Kind::position,
                .followed = true},
    CameraField{
        .key = "target", .member = &Camera::target, .part = Part::placement, .kind = Kind::position, .followed = true},
    CameraField{.key = "up", .member = &Camera::up, .part = Part::placement, .kind = Kind::direction, .followed = true},
    CameraField{.key = "fov_y",
                .member = &Camera::fovY,
                .part = Part::perspective,
                .kind = Kind::angle,
                .min = 1.0,
                .max = 179.0,
                .unit = "degrees",
                .followed = true},
    CameraField{.key = "near",
                .member = &Camera::near,
                .part = Part::always,
                .kind = Kind::number,
                .min = 1e-6,
                .max = 1000.0,
                .unit = "metres"},
    CameraField{.key = "orthographic_height",
                .member = &Camera::orthographicHeight,
                .part = Part::orthographic,
                .kind = Kind::number,
                .min = 1e-6,
                .max = largestInView,
                .unit = "metres"},
    CameraField{.key = "far",
                .member = &Camera::far,
                .part = Part::orthographic,
                .kind = Kind::number,
                .min = 1e-6,
                .max = largestInView,
                .unit = "metres",
                .inFiles = false},
    CameraField{.key = "aperture_radius",
                .member = &Camera::apertureRadius,
                .part = Part::lens,
                .kind = Kind::number,
                .max = 1000.0,
                .unit = "metres",
                .followed = true},
    CameraField{.key = "focus_distance",
                .member = &Camera::focusDistance,
                .part = Part::lens,
                .kind = Kind::number,
                .max = largestInView,
                .unit = "metres",
                .followed = true},
    CameraField{
        .key = "blades", .member = &Camera::blades, .part = Part::lens, .kind = Kind::count, .max = Camera::mostBlades},
    CameraField{.key = "blade_rotation",
                .member = &Camera::bladeRotation,
                .part = Part::lens,
                .kind = Kind::angle,
                .min = -360.0,
                .max = 360.0,
                .unit = "degrees",
                .followed = true},
};

// Does not compile with a member that the table may not know: add its line above, then its name here. Not in the table:
// the name, what the target means, the node, and the targets of focus.
[[maybe_unused]] void knowsAllMembers(const Camera& camera) {
    const auto& [name, position, target, up, fovY, near, orthographicHeight, far, aims, node, apertureRadius,
                 focusDistance, blades, bladeRotation, focus] = camera;
    (void)name;
    static_assert(fields.size() + 4 == 15);
}

}  // namespace

std::span<const CameraField> cameraFields() {
    return fields;
}

std::vector<std::string> cameraFileKeys(bool keyframe) {
    std::vector<std::string> keys;
    for (const CameraField& field : fields) {
        if (keyframe ? field.followed : field.inFiles) {
            keys.emplace_back(field.key);
        }
    }
    return keys;
}

std::vector<double> followedValues(const Camera& camera) {
    std::vector<double> values;
    for (const CameraField& field : fields) {
        if (!field.followed) {
            continue;
        }
        if (const auto* vector = std::get_if<vec3 Camera::*>(&field.member)) {
            const vec3& v = camera.**vector;
            values.insert(values.end(), {v.x, v.y, v.z});
        } else {
            values.push_back(camera.*std::get<float Camera::*>(field.member));
        }
    }
    return values;
}

Camera withFollowedValues(Camera camera, std::span<const double> values) {
    size_t at = 0;
    for (const CameraField& field : fields) {
        if (!field.followed) {
            continue;
        }
        if (const auto* vector = std::get_if<vec3 Camera::*>(&field.member)) {
            camera.** vector = glm::dvec3(values[at], values[at + 1], values[at + 2]);
            at += 3;
        } else {
            camera.*std::get<float Camera::*>(field.member) = static_cast<float>(values[at++]);
        }
    }
    REFLET_CHECK(at == values.size(), "{} of {} values", at, values.size());
    return camera;
}

bool applies(const CameraField& field, const Camera& camera) {
    switch (field.part) {
        case Part::perspective:
            return camera.orthographicHeight <= 0.0F;
        case Part::orthographic:
            return camera.orthographicHeight > 0.0F;
        case Part::lens:
            return camera.apertureRadius > 0.0F;
        case Part::placement:
        case Part::always:
            break;
    }
    return true;
}

}  // namespace reflet
