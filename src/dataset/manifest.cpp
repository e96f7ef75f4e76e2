// Writes what data sets say about themselves.
#include "dataset/manifest.h"

#include "base/error.h"
#include "base/json.h"
#include "dataset/files.h"
#include "job/sequence_record.h"
#include "reference/sampler.h"
#include "renderer/presets.h"
#include "scene/view_file.h"
#include "version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace reflet {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::string_view builtinPrefix = "builtin:";

std::string nameOf(const std::string& scene) {
    std::string name =
        scene.starts_with(builtinPrefix) ? scene.substr(builtinPrefix.size()) : fs::path(scene).stem().string();
    std::ranges::replace_if(
        name, [](char c) { return c == '/' || c == ' ' || c == '\\'; }, '_');
    return name.empty() ? "scene" : name;
}

void checkNoisy(const DatasetOptions& o) {
    for (const std::string& name : o.noisy) {
        if (std::ranges::count(o.noisy, name) > 1) {
            failUsage("--noisy: '{}' is named twice", name);
        }
        if (samplesOf(name) > 0) {
            continue;
        }
        if (o.layout == "oidn") {
            failUsage("--noisy {}: the layout oidn names images by their samples per pixel, so it takes numbers only",
                      name);
        }
        Settings settings;
        applyPreset(settings, name);
    }
    if (o.displayed && o.layout != "oidn") {
        failUsage(
            "--ldr is for --layout oidn; of others, the display image is final times the record's exposure, tone "
            "mapped");
    }
}

ordered_json rowsOf(const glm::dmat4& m) {
    ordered_json rows = ordered_json::array();
    for (int row = 0; row < 4; ++row) {
        rows.push_back({m[0][row], m[1][row], m[2][row], m[3][row]});
    }
    return rows;
}

ordered_json layersJson() {
    ordered_json all = ordered_json::array();
    for (const LayerInfo& layer : datasetLayers()) {
        all.push_back(
            {{"name", layer.name}, {"channels", layer.channels}, {"unit", layer.unit}, {"meaning", layer.meaning}});
    }
    return all;
}

}  // namespace

DatasetPlan::DatasetPlan(const DatasetOptions& options) : frames_(options.frames), burst_(options.burst) {
    checkNoisy(options);
    if (frames_ % burst_ != 0) {
        failUsage("--frames {}: must be a multiple of --burst {}", frames_, burst_);
    }
    if (std::isnan(options.noise) || std::isnan(options.clamp) || std::isnan(options.speed) ||
        std::isnan(options.shutter)) {  // no range refuses it
        failUsage("--noise, --clamp, --shutter and --speed must be numbers");
    }
    if (!(options.fps > 0.0 && options.fps <= 1e6)) {
        failUsage("--fps must be more than 0 and at most 1e6, is {:g}", options.fps);
    }
    for (const std::string& scene : options.scenes) {
        const std::string name = nameOf(scene);
        std::string own = name;
        for (int i = 2; std::ranges::find(names_, own) != names_.end(); ++i) {
            own = fmt::format("{}-{}", name, i);
        }
        names_.push_back(own);
    }
}

uint32_t DatasetPlan::sceneOf(uint32_t frame) const {
    const uint32_t burst = frame / burst_;
    return static_cast<uint32_t>((uint64_t(burst) + burst / scenes()) % scenes());
}

std::vector<uint32_t> DatasetPlan::sceneOfFrames() const {
    std::vector<uint32_t> all(frames_);
    for (uint32_t frame = 0; frame < frames_; ++frame) {
        all[frame] = sceneOf(frame);
    }
    return all;
}

uint32_t DatasetPlan::burstsOfScene(uint32_t /*scene*/) const {
    return std::max((frames_ / burst_ + scenes() - 1) / scenes(), 1U);
}

uint32_t samplesOf(const std::string& noisy) {
    uint32_t samples = 0;
    const char* end = noisy.data() + noisy.size();
    const auto [rest, error] = std::from_chars(noisy.data(), end, samples);
    return error == std::errc() && rest == end ? samples : 0;
}

uint32_t traceSeed(uint32_t seed, uint32_t frame, uint32_t version) {
    return mixBits(mixBits(mixBits(seed) ^ frame) + version * 0x9E3779B9U);
}

void beginDataset(const DatasetOptions& o, const DatasetPlan& plan, const std::vector<std::string>& environments) {
    const uvec2 size = parseSize(o.view.size);
    ordered_json scenes = ordered_json::array();
    for (size_t i = 0; i < o.scenes.size(); ++i) {
        scenes.push_back({{"name", plan.sceneNames()[i]},
                          {"scene", fs::path(o.scenes[i]).filename().string()},
                          {"fingerprint", sceneFingerprint(o.scenes[i])}});
    }
    ordered_json names = ordered_json::array();
    for (const std::string& environment : environments) {
        names.push_back(fs::path(environment).filename().string());
    }
    ordered_json settingsFiles = ordered_json::array();
    for (const std::string& file : o.view.settingsFiles) {
        settingsFiles.push_back(ordered_json(parseJsonFile(file)));
    }
    const ordered_json record{
        {"reflet", versionText},
        {"kind", "reflet dataset"},
        {"version", 2},
        {"frames", o.frames},
        {"burst", o.burst},
        {"fps", o.fps},
        {"size", {size.x, size.y}},
        {"seed", o.view.seed},
        {"scenes", scenes},
        {"cameras",
         {{"kind", o.cameras},
          {"path", o.path.empty() ? ordered_json() : ordered_json(parseJsonFile(o.path))},
          {"height", o.height},
          {"fov", o.fov},
          {"speed", o.speed},
          {"camera", o.view.camera},
          {"view_file", o.view.viewFile.empty() ? ordered_json() : ordered_json(parseJsonFile(o.view.viewFile))},
          {"time", o.view.time.value_or(0.0)}}},
        {"light",
         {{"sun", o.sun},
          {"environment", o.view.environment},
          {"environments", names},
          {"background", o.view.background},
          {"exposure", o.exposure}}},
        {"clean", {{"spp", o.samples}, {"noise", o.noise}, {"clamp", o.clamp}, {"shutter", o.shutter}}},
        {"noisy", o.noisy},
        {"scene_index", o.view.sceneIndex.value_or(-1)},
        {"settings_files", settingsFiles},
        {"settings", o.view.set},
        {"layout", o.layout},
        {"ldr", o.displayed},
        {"half", !o.floats},
        {"layers", layersJson()}};
    beginRecord(fs::path(o.folder) / "manifest.json", record, "empty the folder, or choose another");
}

void addView(ordered_json& record, const View& now, const View& before, uvec2 size) {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const auto toView = [](const View& view) {
        return rowsOf(glm::dmat4(worldToView(view.camera)) * glm::translate(glm::dmat4(1.0), -view.origin));
    };
    record["time"] = now.time;
    record["previous_time"] = before.time;
    View still = now;
    still.camera.node = -1;  // it has been posed
    record["camera"] = viewJson(still).at("camera");
    record["world_to_view"] = toView(now);
    record["view_to_clip"] = rowsOf(glm::dmat4(viewToClip(now.camera, aspect)));
    record["previous_world_to_view"] = toView(before);
    record["previous_view_to_clip"] = rowsOf(glm::dmat4(viewToClip(before.camera, aspect)));
    record["sun"] = {{"direction", {now.sun.direction.x, now.sun.direction.y, now.sun.direction.z}},
                     {"irradiance", {now.sun.irradiance.x, now.sun.irradiance.y, now.sun.irradiance.z}}};
    record["environment_rotation"] = now.environment.rotation;
}

}  // namespace reflet
