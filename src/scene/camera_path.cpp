// Camera paths: monotone cubics between keyframes, and orbits.
#include "scene/camera_path.h"

#include "base/error.h"
#include "base/text.h"
#include "scene/camera_fields.h"
#include "scene/camera_json.h"
#include "scene/focus.h"
#include "scene/json_values.h"
#include "scene/move_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace reflet {
namespace {

struct EasingName {
    std::string name;
    Easing easing;
};

const std::array<EasingName, 5>& easingNames() {
    static const std::array<EasingName, 5> names{{{"linear", Easing::linear},
                                                  {"smooth", Easing::smooth},
                                                  {"step", Easing::step},
                                                  {"ease-in", Easing::easeIn},
                                                  {"ease-out", Easing::easeOut}}};
    return names;
}

double eased(double x, Easing easing) {
    switch (easing) {
        case Easing::smooth:
            return x * x * (3.0 - 2.0 * x);
        case Easing::step:
            return 0.0;
        case Easing::easeIn:
            return x * x;
        case Easing::easeOut:
            return x * (2.0 - x);
        case Easing::linear:
            break;
    }
    return x;
}

/// The slope of a monotone cubic where one of slope `before` over `widthBefore` meets one of slope `after`.
double monotoneSlope(double before, double widthBefore, double after, double widthAfter) {
    if (!(before * after > 0.0)) {
        return 0.0;  // a turning point
    }
    const double weightBefore = 2.0 * widthAfter + widthBefore;
    const double weightAfter = widthAfter + 2.0 * widthBefore;
    return (weightBefore + weightAfter) / (weightBefore / before + weightAfter / after);
}

Easing readEasing(const JsonNode& node) {
    std::vector<std::string> names;
    for (const EasingName& known : easingNames()) {
        if (node.json().is_string() && node.json().get<std::string>() == known.name) {
            return known.easing;
        }
        names.push_back(known.name);
    }
    const std::string meant = node.json().is_string() ? suggestion(node.json().get<std::string>(), names) : "";
    node.complainMustBe(fmt::format("one of {}{}", fmt::join(names, ", "), meant));
}

CameraPath::Keyframe readKeyframe(const JsonNode& node, const Camera& camera) {
    std::vector<std::string> keys = cameraKeys(true);
    keys.insert(keys.end(), {"time", "easing"});
    node.requireKeys(keys);
    CameraPath::Keyframe keyframe{0.0, camera, Easing::linear};
    keyframe.camera.node = -1;  // the path moves it
    keyframe.time = required(node, "time").number(0.0, View::largestTime, "seconds");
    (void)required(node, "position");
    (void)required(node, "target");
    readCameraFields(node, keyframe.camera);
    if (keyframe.camera.position == keyframe.camera.target) {
        node.complain("position and target must not be the same point");
    }
    if (const auto easing = node.find("easing")) {
        keyframe.easing = readEasing(*easing);
    }
    return keyframe;
}

bool hasFixedFocus(const Camera& camera) {
    return camera.focus.empty() && camera.focusDistance > 0.0F;
}

std::vector<FocusTarget> focusOf(const Camera& camera) {
    if (hasFixedFocus(camera)) {
        return {{.kind = FocusTarget::Kind::distance, .distance = camera.focusDistance, .node = {}}};
    }
    return camera.focus.empty() ? std::vector<FocusTarget>(1) : camera.focus;
}

void weigh(std::vector<FocusTarget>& focus, double weight) {
    for (FocusTarget& target : focus) {
        target.weight *= static_cast<float>(weight);
    }
}

/// Distance along the ray to the first triangle, in lengths of `direction` (T. Möller and B. Trumbore, "Fast, Minimum
/// Storage Ray/Triangle Intersection", 1997).
std::optional<double> firstHit(const Scene& scene, const vec3& origin, const vec3& direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        const glm::dmat4 worldToObject = glm::inverse(glm::dmat4(instance.objectToWorld));
        const glm::dvec3 from(worldToObject * glm::dvec4(origin, 1.0));
        const glm::dvec3 along(worldToObject * glm::dvec4(direction, 0.0));
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::dvec3 a(mesh.positions.at(mesh.indices[i]));
            const glm::dvec3 ab = glm::dvec3(mesh.positions.at(mesh.indices[i + 1])) - a;
            const glm::dvec3 ac = glm::dvec3(mesh.positions.at(mesh.indices[i + 2])) - a;
            const glm::dvec3 p = glm::cross(along, ac);
            const glm::dvec3 q = glm::cross(from - a, ab);
            const double scale = 1.0 / glm::dot(ab, p);
            const double u = glm::dot(from - a, p) * scale;
            const double v = glm::dot(along, q) * scale;
            const double distance = glm::dot(ac, q) * scale;
            if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0) {  // false for the NaN of degenerate triangles
                nearest = std::min(nearest, distance);
            }
        }
    }
    return std::isfinite(nearest) ? std::optional(nearest) : std::nullopt;
}

}  // namespace

CameraPath::CameraPath(std::vector<Keyframe> keyframes, bool loop) : keyframes_(std::move(keyframes)), loop_(loop) {
    REFLET_CHECK(!keyframes_.empty() && (!loop_ || keyframes_.size() > 1), "{} keyframes", keyframes_.size());
    std::ranges::transform(keyframes_, std::back_inserter(values_),
                           [](const Keyframe& keyframe) { return followedValues(keyframe.camera); });
    makeTangents();
}

void CameraPath::makeTangents() {
    const size_t last = keyframes_.size() - 1;
    const auto width = [&](size_t i) { return keyframes_[i + 1].time - keyframes_[i].time; };
    const size_t valueCount = values_.front().size();
    tangents_.resize(keyframes_.size(), Values(valueCount));
    for (size_t k = 0; k < valueCount && last > 0; ++k) {
        const auto slope = [&](size_t i) { return (values_[i + 1][k] - values_[i][k]) / width(i); };
        for (size_t i = 1; i < last; ++i) {
            tangents_[i][k] = monotoneSlope(slope(i - 1), width(i - 1), slope(i), width(i));
        }
        if (loop_) {
            tangents_[0][k] = monotoneSlope(slope(last - 1), width(last - 1), slope(0), width(0));
            tangents_[last][k] = tangents_[0][k];
        } else {
            tangents_[0][k] = slope(0);
            tangents_[last][k] = slope(last - 1);
        }
    }
}

Camera CameraPath::cameraOf(const Values& values, size_t from, size_t to, double x) const {
    Camera camera = withFollowedValues(keyframes_.front().camera, values);
    const Camera& before = keyframes_[from].camera;
    const Camera& after = keyframes_[to].camera;
    std::vector<FocusTarget> first = focusOf(before);
    std::vector<FocusTarget> second = focusOf(after);
    if (hasFixedFocus(before) && hasFixedFocus(after)) {
        camera.focus.clear();  // the focus distance is one of the values
    } else if (first == second) {
        camera.focus = before.focus;
    } else {
        weigh(first, 1.0 - x);
        weigh(second, x);
        camera.focus = std::move(first);
        camera.focus.insert(camera.focus.end(), second.begin(), second.end());
    }
    return camera;
}

void CameraPath::checkFocus(const Scene& scene, const std::string& file) const {
    for (size_t i = 0; i < keyframes_.size(); ++i) {
        reflet::checkFocus(keyframes_[i].camera, scene, fmt::format("{}: keyframes[{}].focus", file, i));
    }
}

Camera CameraPath::at(double time) const {
    const double first = keyframes_.front().time;
    if (loop_) {
        const double length = keyframes_.back().time - first;
        time = std::fmod(time - first, length);
        time += first + (time < 0.0 ? length : 0.0);
    }
    if (time <= first) {
        return cameraOf(values_.front(), 0, 0, 0.0);
    }
    const auto next = std::ranges::upper_bound(keyframes_, time, {}, &Keyframe::time);
    if (next == keyframes_.end()) {
        return cameraOf(values_.back(), keyframes_.size() - 1, keyframes_.size() - 1, 0.0);
    }
    const auto to = static_cast<size_t>(next - keyframes_.begin());
    const size_t from = to - 1;
    const double width = keyframes_[to].time - keyframes_[from].time;
    const double x = eased((time - keyframes_[from].time) / width, keyframes_[from].easing);
    Values now(values_[from].size());
    for (size_t k = 0; k < now.size(); ++k) {  // cubic Hermite, as a change from the first value
        const double change = values_[to][k] - values_[from][k];
        const double start = tangents_[from][k] * width;
        const double end = tangents_[to][k] * width;
        now.at(k) =
            values_[from][k] + x * (start + x * (3.0 * change - 2.0 * start - end + x * (start + end - 2.0 * change)));
    }
    return cameraOf(now, from, to, x);
}

CameraPath loadCameraPath(const std::filesystem::path& path, const Camera& camera, const glm::dvec3& origin) {
    static const std::array<std::string, 2> keys{"keyframes", "loop"};
    nlohmann::json file = parseJsonFile(path);
    if (origin != glm::dvec3(0.0)) {
        movePositions(file, -origin);
    }
    const JsonNode root(file, path);
    root.requireKeys(keys);
    const JsonNode list = required(root, "keyframes");
    if (!list.json().is_array() || list.json().empty()) {
        list.complainMustBe("a list of keyframes");
    }
    std::vector<CameraPath::Keyframe> keyframes;
    for (size_t i = 0; i < list.json().size(); ++i) {
        const JsonNode node = list.at(i);
        keyframes.push_back(readKeyframe(node, camera));
        if (i > 0 && keyframes[i].time <= keyframes[i - 1].time) {
            required(node, "time")
                .complainMustBe(fmt::format("more than the previous keyframe's ({:g})", keyframes[i - 1].time));
        }
    }
    const auto loop = root.find("loop");
    if (loop && !loop->json().is_boolean()) {
        loop->complainMustBe("true or false");
    }
    const bool loops = loop && loop->json().get<bool>();
    const Camera& first = keyframes.front().camera;
    const Camera& last = keyframes.back().camera;
    if (loops && (keyframes.size() < 2 || first.position != last.position || first.target != last.target)) {
        loop->complain("the first and the last keyframe of a loop must have the same position and target");
    }
    return {std::move(keyframes), loops};
}

vec3 orbitPivot(const Camera& camera, const Scene& scene) {
    if (camera.aims) {
        return camera.target;
    }
    const vec3 forward = glm::normalize(camera.target - camera.position);
    if (const auto distance = firstHit(scene, camera.position, forward)) {
        return camera.position + static_cast<float>(*distance) * forward;
    }
    const Aabb bounds = scene.bounds();
    const float middle = bounds.empty() ? 0.0F : glm::dot(bounds.center() - camera.position, forward);
    return middle > 0.0F ? camera.position + middle * forward : camera.target;
}

Camera orbit(Camera camera, const vec3& pivot, double turns) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 2.0 * glm::pi<double>() * turns, glm::dvec3(0.0, 1.0, 0.0)));
    const auto turned = [&](const vec3& p) {
        return vec3(glm::dvec3(pivot) + turn * (glm::dvec3(p) - glm::dvec3(pivot)));
    };
    camera.position = turned(camera.position);
    camera.target = turned(camera.target);
    camera.up = turn * glm::dvec3(camera.up);
    camera.node = -1;  // the orbit moves it
    return camera;
}

}  // namespace reflet
