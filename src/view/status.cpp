// Writes the status.
#include "view/status.h"

#include "base/json_text.h"
#include "view/progress_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace reflet {

namespace {

using nlohmann::ordered_json;

const char* nameOf(RayOutcome outcome) {
    constexpr std::array<const char*, 4> names{"hit", "left the screen", "spent", "hidden"};
    return names[static_cast<size_t>(outcome)];
}

ordered_json pickedJson(const Picked& picked) {
    ordered_json json{{"pixel", {picked.pixel.x, picked.pixel.y}}, {"change", picked.change}};
    for (const PickedValues& values : picked.values) {
        json["values"][values.name] = values.values;
    }
    if (picked.ray) {
        json["ray"] = {{"outcome", nameOf(picked.ray->outcome)},
                       {"distance", picked.ray->distance},
                       {"confidence", picked.ray->confidence},
                       {"samples", picked.ray->samples}};
    }
    if (!picked.hemisphere.empty()) {
        json["diffuse_hits"] = std::ranges::count_if(picked.hemisphere, &RecordedSample::hits);
    }
    if (picked.shadow) {
        json["shadow_lookups"] = picked.shadow->lookups;
    }
    return json;
}

}  // namespace

std::string statusText(const WindowStatus& status) {
    const Workspace& work = status.work;
    const PictureRect rect = work.pictureRect();
    const uvec2 size = work.renderSize();
    const Camera& camera = work.state.view.camera;
    const glm::dvec3 position = work.state.view.origin + glm::dvec3(camera.position);
    ordered_json json{{"drawn", status.drawn},
                      {"rendered", work.live().rendered},
                      {"frames", work.live().frames},
                      {"moving", status.moving},
                      {"scale", work.published.effort.scale},
                      {"frame_ms", work.live().milliseconds},
                      {"at_rest", status.atRest},
                      {"answered", work.redraws() == 0},
                      {"inputs", status.inputs},
                      {"pointer", {status.pointer.x, status.pointer.y}},
                      {"busy", status.busyWith},
                      {"progress", progressText(work.published, work.state.running, status.busyWith)},
                      {"scene", work.state.source.scene},
                      {"paused", work.state.running == Running::paused},
                      {"window", {status.window.x, status.window.y}},
                      {"picture", {rect.min.x, rect.min.y, rect.min.x + rect.size.x, rect.min.y + rect.size.y}},
                      {"size", {size.x, size.y}},
                      {"notice", work.notice()},
                      {"problem", work.problem()},
                      {"shader_problem", work.published.shaderProblem},
                      {"settings", settingsJson(work.state.settings, work.state.ofPreset)},
                      {"preset", work.state.preset},
                      {"camera", {position.x, position.y, position.z}},
                      {"lens", {{"aperture_radius", camera.apertureRadius}, {"focus_distance", camera.focusDistance}}},
                      {"compare", {{"message", status.compare.message()}, {"samples", status.compare.samples()}}}};
    for (const gpu::PassTime& pass : work.live().passes) {
        json["passes"][pass.name] = pass.ms;
    }
    if (work.live().exposure) {
        json["exposure"] = *work.live().exposure;
    }
    if (status.compare.error()) {
        json["compare"]["relative_mse"] = status.compare.error()->relativeMse;
        json["compare"]["flip"] = status.compare.error()->flip;
        json["compare"]["error_samples"] = status.compare.errorSamples();
    }
    if (status.picked) {
        json["picked"] = pickedJson(*status.picked);
    }
    json["controls"] = ordered_json::object();
    for (const auto& [name, place] : work.places.all()) {
        json["controls"][name] = {place.min.x, place.min.y, place.max.x, place.max.y};
    }
    return jsonText(json, 1) + "\n";
}

}  // namespace reflet
