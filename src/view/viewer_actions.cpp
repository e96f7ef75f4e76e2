// The viewer's actions, and its status file for scripts.
#include "view/viewer.h"

#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "cli/command_line.h"
#include "renderer/presets.h"
#include "scene/default_light.h"
#include "scene/view_file.h"
#include "view/saved_state.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>

namespace reflet {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string sceneStem(const std::string& scene) {
    return scene.starts_with("builtin:") ? scene.substr(8) : fs::path(scene).stem().string();
}

// Writes the view to a permanent file, named after its content so that copied command lines stay valid.
std::string keptViewFile(const std::string& scene, const View& view) {
    const std::string text = jsonText(viewJson(view), 2) + "\n";
    const fs::path file =
        configurationFolder() / "views" / fmt::format("{}-{}.json", sceneStem(scene), fingerprintOf(text));
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    writeFileAtomically(file, text);
    return file.string();
}

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
    return json;
}

}  // namespace

void Viewer::applyPresetNamed(const std::string& name) {
    Settings settings;
    applyPreset(settings, name);
    state_.preset = name;
    state_.ofPreset = settings;
    state_.settings = settings;
}

std::string Viewer::commandLine() {
    const uvec2 size = renderSize();
    const SceneOptions& source = state_.source;
    std::string line = "reflet render " + shellWord(source.scene);
    if (source.sceneIndex) {
        line += fmt::format(" --scene {}", *source.sceneIndex);
    }
    if (!source.variant.empty()) {
        line += " --variant " + shellWord(source.variant);
    }
    line += fmt::format(" --size {}x{}", size.x, size.y);
    if (state_.preset != defaultPreset) {
        line += " --preset " + shellWord(state_.preset);
    }
    for (const SettingEntry& entry : settingEntries()) {
        const std::string value = settingText(state_.settings, entry);
        if (value != settingText(state_.ofPreset, entry)) {
            line += fmt::format(" --set {}", shellWord(entry.name + "=" + value));
        }
    }
    if (!source.camera.empty()) {
        line += " --camera " + shellWord(source.camera);
    }
    if (!opened_.isDefaultView(state_, size)) {
        line += " --view-file " + shellWord(keptViewFile(source.scene, state_.view));
    } else {
        if (!source.viewFile.empty()) {
            line += " --view-file " + shellWord(fs::absolute(source.viewFile).string());
        }
        if (!source.environment.empty()) {
            line += " --environment " + shellWord(isMadeEnvironment(source.environment) || source.environment == "none"
                                                      ? source.environment
                                                      : fs::absolute(source.environment).string());
        }
        if (!source.background.empty()) {
            line += " --background " + shellWord(source.background);
        }
        if (source.time) {
            line += fmt::format(" --time {}", *source.time);
        }
    }
    if (source.seed != 0) {
        line += fmt::format(" --seed {}", source.seed);
    }
    if (state_.show != "final") {
        line += " --show " + state_.show;
    }
    return line + fmt::format(" -o {}.png", shellWord(sceneStem(source.scene)));
}

void Viewer::takeScreenshot(const std::string& file) {
    const std::string extension = fs::path(file).extension().string();
    if (!file.empty() && extension != ".png" && extension != ".exr") {
        fail("{}: the name must end in .png or .exr", file);
    }
    render_.post("writing a screenshot", RenderThread::AtEnd::complete,
                 [this, file, state = state_, size = renderSize()](RenderThread::Work& work) {
                     std::string name = file;
                     for (int i = 1; name.empty(); ++i) {
                         const std::string next = fmt::format("{}-{}.png", sceneStem(state.source.scene), i);
                         name = fs::exists(next) ? "" : next;
                     }
                     work.live->screenshot(state, size, name);
                     return [this, name] { tell(fmt::format("Written: {}", fs::absolute(name).string())); };
                 });
}

void Viewer::pickPixel(uvec2 pixel, bool focuses) {
    render_.post(
        "reading a pixel", RenderThread::AtEnd::drop,
        [this, pixel, focuses, state = state_, size = renderSize()](RenderThread::Work& work) -> RenderThread::Finish {
            const Picked picked = work.live->pick(state, size, pixel);
            return [this, picked, focuses] {
                picked_ = picked;
                if (focuses) {
                    focusOnPicked();
                }
            };
        });
}

void Viewer::focusAt(float distance) {
    state_.view.camera.focus.clear();
    state_.view.camera.focusDistance = distance;
}

// Focuses on the plane through the surface of the picked pixel.
void Viewer::focusOnPicked() {
    const auto depth = std::ranges::find(picked_->values, "depth", &PickedValues::name);
    if (depth == picked_->values.end() || !(depth->values.front() > 0.0F)) {
        fail("pixel {}, {} shows no surface to focus on: click on one", picked_->pixel.x, picked_->pixel.y);
    }
    focusAt(depth->values.front());
    tell(state_.view.camera.apertureRadius > 0.0F
             ? fmt::format("Focus at {:.3f} m", depth->values.front())
             : fmt::format("Focus at {:.3f} m; the camera is a pinhole until it has an aperture",
                           depth->values.front()));
}

// Whether the picked pixel still belongs to the recorded ray: false once the camera or the size has changed.
bool Viewer::isPickedView() const {
    return picked_->view.worldToClip == now_.live->view.worldToClip && picked_->view.size == now_.live->view.size;
}

void Viewer::chooseFalseColorRange() {
    const auto& values = now_.live->values;
    if (!values || values->data.empty()) {
        return;
    }
    float low = values->data.front();
    float high = low;
    for (size_t i = 0; i < values->data.size(); i += values->channels.size()) {
        low = std::min(low, values->data[i]);
        high = std::max(high, values->data[i]);
    }
    state_.low = low;
    state_.high = std::max(high, low + 1e-6F);
}

void Viewer::writeStatus() {
    if (options_.status.empty()) {
        return;
    }
    const PictureRect rect = pictureRect();
    const uvec2 size = renderSize();
    ordered_json json{
        {"drawn", drawn_},
        {"rendered", now_.live->rendered},
        {"frames", now_.live->frames},
        {"moving", moving_},
        {"scale", now_.effort.scale},
        {"frame_ms", now_.live->milliseconds},
        {"at_rest", atRest()},
        {"answered", redraws_ == 0},
        {"busy", render_.busyWith()},
        {"scene", state_.source.scene},
        {"paused", state_.running == Running::paused},
        {"window", {window_.size().x, window_.size().y}},
        {"picture", {rect.min.x, rect.min.y, rect.min.x + rect.size.x, rect.min.y + rect.size.y}},
        {"size", {size.x, size.y}},
        {"notice", notice_},
        {"problem", problem_},
        {"shader_problem", now_.shaderProblem},
        {"settings", settingsJson(state_.settings, state_.ofPreset)},
        {"preset", state_.preset},
        {"camera", {state_.view.camera.position.x, state_.view.camera.position.y, state_.view.camera.position.z}},
        {"lens",
         {{"aperture_radius", state_.view.camera.apertureRadius},
          {"focus_distance", state_.view.camera.focusDistance}}},
        {"compare", {{"message", compare_.message()}, {"samples", compare_.samples()}}}};
    for (const gpu::PassTime& pass : now_.live->passes) {
        json["passes"][pass.name] = pass.ms;
    }
    if (now_.live->exposure) {
        json["exposure"] = *now_.live->exposure;
    }
    if (compare_.error()) {
        json["compare"]["relative_mse"] = compare_.error()->relativeMse;
        json["compare"]["flip"] = compare_.error()->flip;
    }
    if (picked_) {
        json["picked"] = pickedJson(*picked_);
    }
    if (picked_ && !picked_->hemisphere.empty()) {
        json["picked"]["diffuse_hits"] = std::ranges::count_if(picked_->hemisphere, &RecordedSample::hits);
    }
    if (picked_ && picked_->shadow) {
        json["picked"]["shadow_lookups"] = picked_->shadow->lookups;
    }
    json["controls"] = ordered_json::object();
    for (const auto& [name, place] : places_.all()) {
        json["controls"][name] = {place.min.x, place.min.y, place.max.x, place.max.y};
    }
    writeFileAtomically(options_.status, jsonText(json, 1) + "\n", Lasting::no);
}

}  // namespace reflet
