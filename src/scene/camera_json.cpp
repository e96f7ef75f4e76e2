// Reads and writes cameras as JSON, from the table of their fields.
#include "scene/camera_json.h"

#include "base/error.h"
#include "scene/camera_fields.h"
#include "scene/json_values.h"

#include <array>
#include <cmath>

namespace reflet {

namespace {

using Kind = CameraField::Kind;
using nlohmann::ordered_json;

constexpr double fullFrame = 24.0;  // height of the sensor in millimetres
constexpr std::array lensKeys{"f_number", "sensor_height", "focus"};

ordered_json list(const vec3& v) {
    return {double(v.x), double(v.y), double(v.z)};  // as doubles, which convert back to the same floats
}

double unitOf(const CameraField& field) {
    return field.kind == Kind::angle ? radiansPerDegree : 1.0;
}

uint32_t readCount(const JsonNode& node, const CameraField& field) {
    const double number = node.number(field.min, field.max, field.unit);
    if (number != std::floor(number) || (number > 0.0 && number < Camera::fewestBlades)) {
        node.complainMustBe(fmt::format("0 (round) or a whole number of {} to {}", Camera::fewestBlades, field.max));
    }
    return static_cast<uint32_t>(number);
}

void readField(const JsonNode& node, const CameraField& field, Camera& camera) {
    if (const auto* vector = std::get_if<vec3 Camera::*>(&field.member)) {
        camera.** vector = field.kind == Kind::direction ? readDirection(node) : readPosition(node);
    } else if (const auto* count = std::get_if<uint32_t Camera::*>(&field.member)) {
        camera.** count = readCount(node, field);
    } else {
        camera.*std::get<float Camera::*>(field.member) =
            static_cast<float>(node.number(field.min, field.max, field.unit) * unitOf(field));
    }
}

void readPart(const JsonNode& node, Camera& camera, bool lens) {
    for (const CameraField& field : cameraFields()) {
        if ((field.part == CameraField::Part::lens) == lens && field.inFiles) {
            if (const auto value = node.find(field.key)) {
                readField(*value, field, camera);
            }
        }
    }
}

void refuseBoth(const JsonNode& node, const char* key, const char* other) {
    const auto value = node.find(key);
    if (value && node.find(other)) {
        value->complain(fmt::format("cannot be given together with {}: remove one of them", other));
    }
}

void readFNumber(const JsonNode& node, Camera& camera) {
    refuseBoth(node, "f_number", "aperture_radius");
    const auto fNumber = node.find("f_number");
    const auto sensor = node.find("sensor_height");
    if (sensor && !fNumber) {
        sensor->complain("needs f_number, which is not given");
    }
    if (!fNumber) {
        return;
    }
    if (camera.orthographicHeight > 0.0F) {
        fNumber->complain("needs a perspective camera: give aperture_radius in metres instead");
    }
    const double number = fNumber->number(0.01, 1e6);
    const double height = sensor ? sensor->number(0.01, 1e6, "millimetres") : fullFrame;
    camera.apertureRadius = apertureOfFNumber(static_cast<float>(number), camera.fovY, static_cast<float>(height));
}

FocusTarget readFocusTarget(const JsonNode& node) {
    if (node.json().is_array()) {
        return {.kind = FocusTarget::Kind::point, .point = readPosition(node), .node = {}};
    }
    if (!node.json().is_string() || node.json().get<std::string>().empty()) {
        node.complainMustBe("the name of a node or a point [x, y, z]");
    }
    return {.kind = FocusTarget::Kind::node, .node = node.json().get<std::string>()};
}

void readFocus(const JsonNode& node, Camera& camera) {
    refuseBoth(node, "focus", "focus_distance");
    if (const auto focus = node.find("focus")) {
        camera.focus = {readFocusTarget(*focus)};
    } else if (node.find("focus_distance")) {
        camera.focus.clear();
    }
}

ordered_json valueOf(const CameraField& field, const Camera& camera, double unit) {
    if (const auto* vector = std::get_if<vec3 Camera::*>(&field.member)) {
        return list(camera.**vector);
    }
    if (const auto* count = std::get_if<uint32_t Camera::*>(&field.member)) {
        return camera.**count;
    }
    return double(camera.*std::get<float Camera::*>(field.member)) / unit;
}

// Between two targets, only the distance can be said.
void addFocus(ordered_json& json, const Camera& camera) {
    if (camera.focus.size() != 1) {
        return;
    }
    const FocusTarget& target = camera.focus.front();
    switch (target.kind) {
        case FocusTarget::Kind::automatic:
            json["focus_distance"] = 0.0;
            break;
        case FocusTarget::Kind::distance:
            json["focus_distance"] = double(target.distance);
            break;
        case FocusTarget::Kind::point:
            json.erase("focus_distance");
            json["focus"] = list(target.point);
            break;
        case FocusTarget::Kind::node:
            json.erase("focus_distance");
            json["focus"] = target.node;
            break;
    }
}

}  // namespace

std::vector<std::string> cameraKeys(bool keyframe) {
    std::vector<std::string> keys = cameraFileKeys(keyframe);
    keys.insert(keys.end(), lensKeys.begin(), lensKeys.end());
    return keys;
}

void readCameraFields(const JsonNode& node, Camera& camera) {
    if (node.find("fov_y")) {
        if (const auto height = node.find("orthographic_height")) {
            height->complain("cannot be given together with fov_y: a camera is orthographic or perspective");
        }
        camera.orthographicHeight = 0.0F;  // a field of view implies perspective
    }
    readPart(node, camera, false);
    readLens(node, camera);
}

void readLens(const JsonNode& node, Camera& camera) {
    readPart(node, camera, true);
    readFNumber(node, camera);
    readFocus(node, camera);
}

ordered_json cameraJson(const Camera& camera) {
    ordered_json json;
    for (const CameraField& field : cameraFields()) {
        const bool placed = field.part != CameraField::Part::placement || camera.node < 0;
        const bool lens = field.part == CameraField::Part::lens;  // a pinhole is said, too: the scene's may be none
        if (field.inFiles && placed && (lens || applies(field, camera))) {
            json[field.key] = valueOf(field, camera, unitOf(field));
        }
    }
    addFocus(json, camera);
    return json;
}

ordered_json cameraRecord(const Camera& camera) {
    ordered_json json;
    for (const CameraField& field : cameraFields()) {
        if (field.part != CameraField::Part::lens || applies(field, camera)) {
            json[field.key] = valueOf(field, camera, unitOf(field));
        }
    }
    if (camera.apertureRadius > 0.0F) {
        for (const FocusTarget& t : camera.focus) {
            json["focus"].push_back({static_cast<int>(t.kind), t.distance, list(t.point), t.node, t.weight});
        }
    }
    return json;
}

}  // namespace reflet
