// Places cameras and suns by angles.
#include "job/camera_options.h"

#include "base/error.h"
#include "base/text.h"
#include "scene/focus.h"
#include "scene/framing.h"
#include "scene/json_values.h"
#include "scene/pose.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace reflet {

namespace {

constexpr double smallestDistance = 1e-6;  // metres
constexpr double percent = 0.01;
constexpr double smallestPercent = 1.0;
constexpr double largestPercent = 10000.0;
constexpr float fullFrame = 24.0F;  // height of the sensor in millimetres

/// Distance of an orbit.
struct Distance {
    double number = 100.0;
    bool isPercent = true;  ///< of what is right without it; else metres
};

struct Orbit {
    Direction direction;
    std::optional<Distance> distance;
};

std::vector<std::string> partsOf(const std::string& text) {
    std::vector<std::string> parts{""};
    for (const char c : text) {
        if (c == ',') {
            parts.emplace_back();
        } else if (c != ' ') {
            parts.back() += c;
        }
    }
    return parts;
}

std::optional<double> numberOf(const std::string& text) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const char* begin = text.starts_with('+') ? text.data() + 1 : text.data();
    const auto [rest, error] = std::from_chars(begin, end, value);
    return error == std::errc() && rest == end && begin != end && std::isfinite(value) ? std::optional(value)
                                                                                       : std::nullopt;
}

[[noreturn]] void failDirection(const std::string& text, const std::string& option) {
    failUsage(
        "{0} must be AZIMUTH,ELEVATION{1}: degrees from the front (+Z) to the right (-360 to 360) and above the "
        "horizon "
        "(-90 to 90){2}; it is '{3}'",
        option, option == "--orbit" ? "[,DISTANCE]" : "",
        option == "--orbit" ? ", and metres (1e-6 to 1e12) or percent of the automatic distance (1% to 10000%)" : "",
        text);
}

Distance parseDistance(std::string part, const std::string& text) {
    const bool isPercent = part.ends_with('%');
    if (isPercent) {
        part.pop_back();
    }
    const auto number = numberOf(part);
    if (!number || *number < (isPercent ? smallestPercent : smallestDistance) ||
        *number > (isPercent ? largestPercent : largestInView)) {
        failDirection(text, "--orbit");
    }
    return {*number, isPercent};
}

Orbit parseOrbit(const std::string& text) {
    const std::vector<std::string> parts = partsOf(text);
    if (parts.size() != 3) {
        return {parseDirection(text, "--orbit"), std::nullopt};
    }
    return {parseDirection(parts[0] + "," + parts[1], "--orbit"), parseDistance(parts[2], text)};
}

/// "X,Y,Z", from the coordinates of the file to those of the world.
std::optional<vec3> pointOf(const std::string& text, const std::string& option, const glm::dvec3& origin) {
    const std::vector<std::string> parts = partsOf(text);
    if (parts.size() != 3) {
        return std::nullopt;
    }
    glm::dvec3 point(0.0);
    for (int i = 0; i < 3; ++i) {
        const auto number = numberOf(parts[static_cast<size_t>(i)]);
        if (!number || std::abs(*number) > largestInView) {
            failUsage("{} must be X,Y,Z in metres (-1e12 to 1e12) or the name of a node; it is '{}'", option, text);
        }
        point[i] = *number;
    }
    return vec3(point - origin);
}

/// The direction that is up in the picture, also for a camera that looks straight up or down.
vec3 upFor(const Direction& direction) {
    if (std::abs(direction.elevation) < 89.9) {
        return {0, 1, 0};
    }
    const vec3 front(unitVector({direction.azimuth, 0.0}));
    return direction.elevation > 0.0 ? -front : front;
}

void setFov(const CameraOptions& options, const Scene& scene, float aspect, bool automatic, View& view) {
    if (!options.fov) {
        return;
    }
    view.camera.orthographicHeight = 0.0F;
    view.camera.fovY = static_cast<float>(*options.fov * radiansPerDegree);
    if (automatic && !options.wholeTurn) {
        frameScene(view.camera, scene, aspect, view.time);
    }
}

/// Looks along `forward`, from where the scene fills the image.
Camera framed(const CameraOptions& options, const View& view, const vec3& forward, const vec3& up, const Scene& scene,
              float aspect) {
    if (options.wholeTurn && view.camera.orthographicHeight <= 0.0F) {
        return turningCamera(scene, aspect, view.time, forward, view.camera.fovY, up).camera;
    }
    Camera camera = view.camera;
    camera.up = up;
    camera.target = camera.position + forward * std::max(1.0F, glm::length(camera.position));
    frameScene(camera, scene, aspect, view.time);
    return camera;
}

void goAround(const CameraOptions& options, const std::optional<vec3>& lookAt, const Scene& scene, float aspect,
              bool automatic, View& view) {
    const Orbit orbit = parseOrbit(options.orbit);
    Camera& camera = view.camera;
    const bool frames = automatic || !camera.aims;
    const float before = glm::distance(camera.position, camera.target);
    const glm::dvec3 forward = -unitVector(orbit.direction);
    const bool usesMetres = orbit.distance && !orbit.distance->isPercent;
    const float near = camera.near;
    const vec3 up = upFor(orbit.direction);
    if (frames) {
        camera = framed(options, view, vec3(forward), up, scene, aspect);
    }
    const float usual = frames ? glm::distance(camera.position, camera.target) : before;
    const vec3 pivot = lookAt.value_or(camera.target);
    const Distance distance = orbit.distance.value_or(Distance{});
    const double metres = distance.isPercent ? percent * distance.number * usual : distance.number;
    camera.up = up;
    camera.target = pivot;
    camera.position = vec3(glm::dvec3(pivot) - forward * metres);
    camera.near = std::min(usesMetres ? near : camera.near, std::max(static_cast<float>(0.1 * metres), 1e-6F));
    camera.aims = true;
    if (camera.position == camera.target) {
        failUsage("--orbit {}: {:g} metres vanish beside the coordinates of the scene", options.orbit, metres);
    }
}

void turnTo(const vec3& point, Camera& camera) {
    if (point == camera.position) {
        failUsage("--look-at: the camera is at this very point");
    }
    const vec3 forward = glm::normalize(point - camera.position);
    camera.target = point;
    camera.aims = true;
    if (glm::length(glm::cross(forward, glm::normalize(camera.up))) < 1e-3F) {
        camera.up = std::abs(forward.y) < 0.9F ? vec3(0, 1, 0) : vec3(0, 0, -1);
    }
}

void magnify(double zoom, Camera& camera) {
    if (camera.orthographicHeight > 0.0F) {
        camera.orthographicHeight /= static_cast<float>(zoom);
        return;
    }
    const double fov = 2.0 * std::atan(std::tan(0.5 * double(camera.fovY)) / zoom) / radiansPerDegree;
    if (fov < 1.0 || fov > 179.0) {
        failUsage("--zoom {:g} makes the field of view {:.3g} degrees; it can be 1 to 179", zoom, fov);
    }
    camera.fovY = static_cast<float>(fov * radiansPerDegree);
}

void setLens(const CameraOptions& options, const Scene& scene, View& view) {
    Camera& camera = view.camera;
    if (options.fNumber) {
        if (camera.orthographicHeight > 0.0F) {
            failUsage("--f-number needs a perspective camera: add --fov, or aperture_radius in a view file");
        }
        camera.apertureRadius = apertureOfFNumber(static_cast<float>(*options.fNumber), camera.fovY, fullFrame);
    }
    if (options.focus.empty()) {
        return;
    }
    if (camera.apertureRadius <= 0.0F) {
        failUsage("--focus: the camera is a pinhole, which has everything in focus: add --f-number 2.8");
    }
    if (const auto metres = numberOf(options.focus)) {
        if (*metres < smallestDistance || *metres > largestInView) {
            failUsage("--focus must be 1e-6 to 1e12 metres, X,Y,Z or the name of a node; it is '{}'", options.focus);
        }
        camera.focusDistance = static_cast<float>(*metres);
        camera.focus.clear();
    } else if (const auto point = pointOf(options.focus, "--focus", view.origin)) {
        camera.focus = {{.kind = FocusTarget::Kind::point, .point = *point, .node = {}}};
    } else {
        camera.focus = {{.kind = FocusTarget::Kind::node, .node = options.focus}};
        checkFocus(camera, scene, "--focus");
    }
}

}  // namespace

bool CameraOptions::any() const {
    return !orbit.empty() || !lookAt.empty() || fov || zoom || fNumber || !focus.empty() || !sun.empty();
}

glm::dvec3 unitVector(const Direction& direction) {
    const double azimuth = direction.azimuth * radiansPerDegree;
    const double elevation = direction.elevation * radiansPerDegree;
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

Direction directionOf(const glm::dvec3& vector) {
    const glm::dvec3 v = glm::normalize(vector);
    return {std::atan2(v.x, v.z) / radiansPerDegree, std::atan2(v.y, std::hypot(v.x, v.z)) / radiansPerDegree};
}

Direction parseDirection(const std::string& text, const std::string& option) {
    const std::vector<std::string> parts = partsOf(text);
    const auto azimuth = numberOf(parts.front());
    const auto elevation = parts.size() == 2 ? numberOf(parts.back()) : std::nullopt;
    if (!azimuth || !elevation || std::abs(*azimuth) > Direction::largestAzimuth ||
        std::abs(*elevation) > Direction::largestElevation) {
        failDirection(text, option);
    }
    return {*azimuth, *elevation};
}

void placeCamera(const CameraOptions& options, const Scene& scene, float aspect, bool automatic, View& view) {
    if (options.wholeTurn && automatic) {
        view.camera = turningCamera(scene, aspect, view.time, std::nullopt,
                                    static_cast<float>(options.fov.value_or(0.0) * radiansPerDegree))
                          .camera;
    }
    if (view.camera.node >= 0 && (!options.orbit.empty() || !options.lookAt.empty())) {
        view.camera = posed(view, scene).camera;
        view.camera.node = -1;
    }
    setFov(options, scene, aspect, automatic, view);
    std::optional<vec3> point;
    if (!options.lookAt.empty()) {
        point = pointOf(options.lookAt, "--look-at", view.origin);
        point = point ? point : centerOfNode(options.lookAt, scene, scenePose(scene, view.time), "--look-at");
    }
    if (!options.orbit.empty()) {
        goAround(options, point, scene, aspect, automatic, view);
    } else if (point) {
        turnTo(*point, view.camera);
    }
    if (options.zoom) {
        magnify(*options.zoom, view.camera);
    }
    setLens(options, scene, view);
}

void placeSun(const CameraOptions& options, View& view) {
    if (!options.sun.empty()) {
        view.sun.direction = vec3(-unitVector(parseDirection(options.sun, "--sun")));
        view.sun.node = -1;
    }
}

}  // namespace reflet
