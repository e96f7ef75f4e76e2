// View files: camera, sun, lamps, environment, background, probes, mirrors and time as JSON. The view changes only if
// all is valid.
#include "scene/view_file.h"

#include "base/error.h"
#include "base/json.h"
#include "scene/background.h"
#include "scene/camera_json.h"
#include "scene/default_light.h"
#include "scene/environment.h"
#include "scene/json_values.h"
#include "scene/move_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace reflet {
namespace {

/// Ensures Camera's invariant that position, target and up define a view.
void checkOrientation(const JsonNode& node, Camera& camera) {
    const vec3 toTarget = camera.target - camera.position;
    if (!(glm::length(toTarget) > 0.0F)) {
        node.complain("position and target must not be the same point");
    }
    const vec3 forward = glm::normalize(toTarget);
    if (glm::length(glm::cross(forward, glm::normalize(camera.up))) >= 1e-3F) {
        return;
    }
    if (const auto up = node.find("up")) {
        up->complainMustBe("a direction that is not parallel to the view");
    }
    // The view's previous up is parallel to the new view axis.
    camera.up = std::abs(forward.y) < 0.9F ? vec3(0, 1, 0) : vec3(0, 0, -1);
}

Camera readCamera(const JsonNode& node, Camera camera) {
    node.requireKeys(cameraKeys(false));
    if (node.find("position") || node.find("target") || node.find("up")) {
        camera.node = -1;  // the file places it
    }
    camera.aims = camera.aims || node.find("target");
    readCameraFields(node, camera);
    const auto near = node.find("near");
    if (near && camera.orthographicHeight > 0.0F && camera.near >= camera.far) {
        near->complainMustBe(fmt::format("less than {:g} metres, the camera's far plane", camera.far));
    }
    checkOrientation(node, camera);
    return camera;
}

Sun readSun(const JsonNode& node, Sun sun) {
    static const std::array<std::string, 3> keys{"direction", "irradiance", "angular_diameter"};
    node.requireKeys(keys);
    if (const auto direction = node.find("direction")) {
        sun.direction = readDirection(*direction);
        sun.node = -1;
    }
    if (const auto irradiance = node.find("irradiance")) {
        sun.irradiance = readVec3(*irradiance, 0.0, largestInView);
    }
    if (const auto diameter = node.find("angular_diameter")) {
        sun.angularDiameter = static_cast<float>(diameter->number(0.0, 90.0, "degrees") * radiansPerDegree);
    }
    return sun;
}

void readLamps(const JsonNode& node, View& view) {
    static const std::array<std::string, 2> keys{"radius", "off"};
    node.requireKeys(keys);
    if (const auto radius = node.find("radius")) {
        view.lampRadius = static_cast<float>(radius->number(0.0, 1000.0, "metres"));
    }
    if (const auto off = node.find("off")) {
        if (!off->json().is_array()) {
            off->complainMustBe("a list of lamp numbers, from 0");
        }
        view.lampsOff.clear();
        for (size_t i = 0; i < off->json().size(); ++i) {
            const double number = off->at(i).number(0.0, 1e6);
            if (number != std::floor(number)) {
                off->at(i).complainMustBe("a whole number");
            }
            view.lampsOff.push_back(static_cast<uint32_t>(number));
        }
        std::ranges::sort(view.lampsOff);
    }
}

// Sets what the file says of an image that is chosen already.
void readImageProperties(const JsonNode& node, Environment& environment) {
    if (const auto radiance = node.find("radiance")) {
        radiance->complain("cannot be given together with an image; to scale the image, use 'intensity'");
    }
    if (const auto intensity = node.find("intensity")) {
        const double factor = intensity->number(0.0, largestRadiance);
        const double brightest = *std::ranges::max_element(environment.image->data);
        if (factor * brightest > largestRadiance) {
            intensity->complainMustBe(fmt::format("at most {:g}, because the image has values up to {:g}",
                                                  largestRadiance / brightest, brightest));
        }
        environment.intensity = static_cast<float>(factor);
    }
    if (const auto rotation = node.find("rotation")) {
        environment.rotation = static_cast<float>(rotation->number(-360.0, 360.0, "degrees") * radiansPerDegree);
    }
}

// By name, or an object with an image or a radiance; both replace the whole environment. `changed` has the file's
// camera and sun.
void readEnvironment(const JsonNode& node, View& changed, EnvironmentChoice choice) {
    static const std::array<std::string, 4> keys{"radiance", "image", "intensity", "rotation"};
    if (node.json().is_string()) {
        choice.name = node.json().get<std::string>();
        chooseEnvironment(changed, choice);
        return;
    }
    node.requireKeys(keys);
    if (const auto image = node.find("image")) {
        if (!image->json().is_string()) {
            image->complainMustBe("'sky', 'studio' or the name of an .hdr or .exr file");
        }
        choice.name = image->json().get<std::string>();
        if (node.find("radiance")) {
            readImageProperties(node, changed.environment);  // complains before a file is read
        }
        chooseEnvironment(changed, choice);
        if (!changed.environment.image) {
            image->complainMustBe("'sky', 'studio' or the name of an .hdr or .exr file");
        }
        readImageProperties(node, changed.environment);
        return;
    }
    for (const char* key : {"intensity", "rotation"}) {
        if (const auto ofImage = node.find(key)) {
            ofImage->complain("needs environment.image, which is not given");
        }
    }
    if (const auto radiance = node.find("radiance")) {
        changed.environment = {.radiance = readVec3(*radiance, 0.0, largestRadiance)};
        if (changed.hasDefaultSun && changed.environment.radiance != vec3(0.0F)) {
            changed.sun.irradiance = vec3(0.0F);
        }
    }
}

Background readBackground(const JsonNode& node) {
    if (node.json().is_array()) {
        return {Background::Mode::color, readVec3(node, 0.0, 1.0)};
    }
    if (!node.json().is_string()) {
        node.complainMustBe("a name or three numbers of 0 to 1");
    }
    try {
        return parseBackground(node.json().get<std::string>());
    } catch (const Error& error) {
        node.complain(error.what());
    }
}

Probe readProbe(const JsonNode& node) {
    static const std::array<std::string, 3> keys{"position", "box_min", "box_max"};
    node.requireKeys(keys);
    const JsonNode position = required(node, "position");
    const JsonNode boxMax = required(node, "box_max");
    Probe probe;
    probe.position = readPosition(position);
    probe.box.min = readPosition(required(node, "box_min"));
    probe.box.max = readPosition(boxMax);
    if (glm::any(glm::lessThanEqual(probe.box.max, probe.box.min))) {
        boxMax.complainMustBe("more than box_min on every axis");
    }
    if (glm::any(glm::lessThanEqual(probe.position, probe.box.min)) ||
        glm::any(glm::greaterThanEqual(probe.position, probe.box.max))) {
        position.complainMustBe("inside the box");
    }
    return probe;
}

std::vector<Probe> readProbes(const JsonNode& node) {
    if (!node.json().is_array()) {
        node.complainMustBe("an array of probes");
    }
    const size_t count = node.json().size();
    if (count > View::maxProbes) {
        node.complain(fmt::format("must have at most {} probes, has {}", View::maxProbes, count));
    }
    std::vector<Probe> probes;
    for (size_t i = 0; i < count; ++i) {
        probes.push_back(readProbe(node.at(i)));
    }
    return probes;
}

std::vector<std::string> readNames(const JsonNode& node) {
    if (!node.json().is_array()) {
        node.complainMustBe("a list of names");
    }
    std::vector<std::string> names;
    for (size_t i = 0; i < node.json().size(); ++i) {
        const JsonNode name = node.at(i);
        if (!name.json().is_string()) {
            name.complainMustBe("a name");
        }
        names.push_back(name.json().get<std::string>());
    }
    return names;
}

}  // namespace

nlohmann::ordered_json viewJson(const View& view) {
    using nlohmann::ordered_json;
    // As doubles, which convert back to the same floats.
    const auto list = [](const vec3& v) { return ordered_json{double(v.x), double(v.y), double(v.z)}; };
    const auto degrees = [](float radians) { return double(radians) / radiansPerDegree; };
    ordered_json json{{"camera", cameraJson(view.camera)}};
    if (view.sun.node < 0) {
        json["sun"]["direction"] = list(view.sun.direction);
    }
    json["sun"]["irradiance"] = list(view.sun.irradiance);
    json["sun"]["angular_diameter"] = degrees(view.sun.angularDiameter);
    if (view.lampRadius) {
        json["lamps"]["radius"] = double(*view.lampRadius);
    }
    if (!view.lampsOff.empty()) {
        json["lamps"]["off"] = view.lampsOff;
    }
    if (!view.environment.image) {
        json["environment"]["radiance"] = list(view.environment.radiance);
    } else if (!view.environment.imageFile.empty()) {
        json["environment"] = {{"image", view.environment.imageFile},
                               {"intensity", double(view.environment.intensity)},
                               {"rotation", degrees(view.environment.rotation)}};
    }
    if (view.background.mode == Background::Mode::color) {
        json["background"] = list(view.background.color);
    } else {
        json["background"] = backgroundText(view.background);
    }
    if (view.probes) {
        json["probes"] = ordered_json::array();
        for (const Probe& probe : *view.probes) {
            json["probes"].push_back({{"position", list(probe.position)},
                                      {"box_min", list(probe.box.min)},
                                      {"box_max", list(probe.box.max)}});
        }
    }
    if (!view.mirrors.empty()) {
        json["mirrors"] = view.mirrors;
    }
    json["time"] = view.time;
    if (view.origin != glm::dvec3(0.0)) {
        movePositions(json, view.origin);
    }
    return json;
}

void applyViewFile(const std::filesystem::path& path, View& view) {
    applyViewJson(parseJsonFile(path), path, view);
}

void applyViewJson(const nlohmann::json& file, const std::filesystem::path& path, View& view) {
    static const std::array<std::string, 8> keys{"camera",     "sun",    "lamps",   "environment",
                                                 "background", "probes", "mirrors", "time"};
    nlohmann::json inWorld;
    if (view.origin != glm::dvec3(0.0)) {
        inWorld = file;
        movePositions(inWorld, -view.origin);
    }
    const JsonNode root(inWorld.is_null() ? file : inWorld, path);
    root.requireKeys(keys);
    View changed = view;
    if (const auto camera = root.find("camera")) {
        changed.camera = readCamera(*camera, view.camera);
    }
    if (const auto sun = root.find("sun")) {
        changed.sun = readSun(*sun, view.sun);
        changed.hasDefaultSun = false;
    }
    if (const auto lamps = root.find("lamps")) {
        readLamps(*lamps, changed);
    }
    if (const auto environment = root.find("environment")) {
        readEnvironment(*environment, changed,
                        {.name = {}, .base = path.parent_path(), .keepsSun = root.find("sun").has_value()});
    }
    if (const auto background = root.find("background")) {
        changed.background = readBackground(*background);
    }
    if (const auto probes = root.find("probes")) {
        changed.probes = readProbes(*probes);
    }
    if (const auto mirrors = root.find("mirrors")) {
        changed.mirrors = readNames(*mirrors);
    }
    if (const auto time = root.find("time")) {
        changed.time = time->number(0.0, View::largestTime, "seconds");
    }
    view = changed;
}

}  // namespace reflet
