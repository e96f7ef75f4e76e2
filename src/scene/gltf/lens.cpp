// Reads lenses of glTF cameras.
#include "scene/gltf/lens.h"

#include "scene/camera_json.h"
#include "scene/focus.h"

#include <nlohmann/json.hpp>

namespace reflet {

namespace {

// The error of a reader that begins its messages with `part`.
[[noreturn]] void failAs(const std::string& part, const Error& error, const GltfReport& report) {
    report.fail(part, "{}", std::string_view(error.what()).substr(part.size() + 2));
}

}  // namespace

void readGltfLens(const tinygltf::Value& extras, const std::string& part, Camera& camera, const GltfReport& report) {
    nlohmann::json lens = nlohmann::json::object();  // checked already: numbers, and a name
    for (const std::string& key : cameraKeys(false)) {
        if (extras.Has(key)) {
            const tinygltf::Value& value = extras.Get(key);
            lens[key] =
                value.IsString() ? nlohmann::json(value.Get<std::string>()) : nlohmann::json(value.GetNumberAsDouble());
        }
    }
    const std::string where = part + ".extras";
    Camera changed = camera;
    try {
        readLens(JsonNode(lens, where), changed);
    } catch (const Error& error) {
        failAs(where, error, report);
    }
    camera = changed;
}

void checkGltfFocus(Scene& scene, GltfReport& report) {
    for (size_t i = 0; i < scene.cameras.size(); ++i) {
        Camera& camera = scene.cameras[i];
        const std::string where = fmt::format("camera '{}'.extras.focus", camera.name);
        const bool found = report.tolerate("the camera will focus automatically", [&] {
            try {
                checkFocus(camera, scene, where);
            } catch (const Error& error) {
                failAs(where, error, report);
            }
        });
        if (!found) {
            camera.focus.clear();
        }
    }
}

}  // namespace reflet
