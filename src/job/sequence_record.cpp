// Writes and compares the records of sequences.
#include "job/sequence_record.h"

#include "base/error.h"
#include "base/file.h"
#include "base/interrupt.h"
#include "base/json.h"
#include "base/json_text.h"
#include "base/message.h"
#include "job/fingerprint.h"
#include "scene/camera_json.h"
#include "scene/gltf/files.h"
#include "scene/json_values.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <thread>

namespace reflet {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json numbers(const vec3& v) {
    return {v.x, v.y, v.z};
}

/// As in view files.
double degrees(float radians) {
    return double(radians) / radiansPerDegree;
}

ordered_json recordOf(const Environment& e) {
    if (!e.image) {
        return {{"radiance", numbers(e.radiance)}};
    }
    Fingerprint texels;
    texels.add(std::as_bytes(std::span(e.image->data)));
    return {{"image", texels.text()}, {"intensity", e.intensity}, {"rotation", degrees(e.rotation)}};
}

// "settings.diffuse.rays was 4, is 8"
std::vector<std::string> differences(const nlohmann::json& old, const nlohmann::json& now) {
    const nlohmann::json before = old.flatten();
    const nlohmann::json after = now.flatten();
    std::vector<std::string> found;
    const auto text = [](const nlohmann::json& all, const std::string& key) {
        return all.contains(key) ? oneLine(jsonText(all.at(key))) : "missing";
    };
    nlohmann::json keys = before;
    keys.update(after);
    for (const auto& [key, ignored] : keys.items()) {
        const std::string was = text(before, key);
        const std::string is = text(after, key);
        if (was != is) {
            std::string name = oneLine(key.substr(std::min<size_t>(1, key.size())));
            std::ranges::replace(name, '/', '.');
            found.push_back(fmt::format("{} was {}, is {}", name, was, is));
        }
    }
    return found;
}

void failIfDifferent(const std::string& what, const nlohmann::json& old, const nlohmann::json& now,
                     const std::string& cure) {
    if (const std::vector<std::string> found = differences(old, now); !found.empty()) {
        constexpr size_t most = 3;
        const auto shown = std::span(found).first(std::min(most, found.size()));
        fail("{}: {}{}; {}", what, fmt::join(shown, "; "),
             found.size() > most ? fmt::format(" and {} more", found.size() - most) : "", cure);
    }
}

// Network file systems show the files of other machines late: NFS up to a minute, and at once after its folder is read.
bool appears(const fs::path& file, std::chrono::seconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!fs::exists(file)) {
        if (std::chrono::steady_clock::now() >= end || InterruptNote::arrived()) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        std::error_code ignored;
        const fs::directory_iterator look(file.has_parent_path() ? file.parent_path() : fs::path("."), ignored);
    }
    return true;
}

// Of a record that exists, though this process may not see it yet.
nlohmann::json readRecord(const fs::path& file) {
    (void)appears(file, std::chrono::seconds(60));
    return parseJsonFile(file);
}

void compareRecords(const FrameNames& names, const ordered_json& record,
                    const std::function<void(const std::string&)>& warn) {
    nlohmann::json old = readRecord(names.record());
    if (!old.is_object()) {
        fail("{}: not a record of a sequence: replace it with --overwrite", names.record().string());
    }
    nlohmann::json now = parseJson(jsonText(record));  // as it reads back from a file
    if (old.contains("device") && now.contains("device") && old.at("device") != now.at("device")) {
        warn(fmt::format("{}: begun on {}; frames of this device may differ in the last bits", names.pattern(),
                         oneLine(jsonText(old.at("device")))));
    }
    old.erase("device");
    now.erase("device");
    failIfDifferent(names.pattern() + ": its frames belong to another sequence", old, now,
                    "remove them with --overwrite, or choose another name");
}

}  // namespace

std::string sceneFingerprint(const std::string& scene) {
    if (scene.starts_with("builtin:")) {
        return "";
    }
    Fingerprint sum;
    visitGltfFiles(scene, [&](std::span<const uint8_t> bytes) { sum.add(std::as_bytes(bytes)); });
    return sum.text();
}

ordered_json recordOf(const View& view) {
    ordered_json json{{"camera", cameraRecord(view.camera)},
                      {"sun",
                       {{"direction", numbers(view.sun.direction)},
                        {"irradiance", numbers(view.sun.irradiance)},
                        {"angular_diameter", degrees(view.sun.angularDiameter)}}},
                      {"environment", recordOf(view.environment)},
                      {"background", {static_cast<int>(view.background.mode), numbers(view.background.color)}},
                      {"time", view.time},
                      {"mirrors", view.mirrors}};
    if (view.lampRadius) {
        json["lamp_radius"] = *view.lampRadius;
    }
    if (!view.lampsOff.empty()) {
        json["lamps_off"] = view.lampsOff;
    }
    if (view.probes) {
        json["probes"] = ordered_json::array();
        for (const Probe& probe : *view.probes) {
            json["probes"].push_back({numbers(probe.position), numbers(probe.box.min), numbers(probe.box.max)});
        }
    }
    return json;
}

void beginRecord(const fs::path& file, const ordered_json& record, const std::string& cure) {
    const std::string text = jsonText(record, 2) + "\n";
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (!fs::exists(file) && writeNewFile(file, text)) {
        return;
    }
    const nlohmann::json old = readRecord(file);
    if (!old.is_object()) {
        fail("{}: not a record: {}", file.string(), cure);
    }
    failIfDifferent(file.string() + ": its files belong to other options", old, parseJson(jsonText(record)), cure);
}

void beginSequence(const FrameNames& names, const ordered_json& record, bool overwrite,
                   const std::function<void(const std::string&)>& warn) {
    const std::string text = jsonText(record, 2) + "\n";
    const std::vector<fs::path> pictures = names.existing();  // before looking for the record, which is written first
    if (overwrite) {
        for (const fs::path& picture : pictures) {
            fs::remove(picture);
        }
        writeFileAtomically(names.record(), text);
        return;
    }
    if (!fs::exists(names.record())) {
        if (!pictures.empty() && !appears(names.record(), std::chrono::seconds(2))) {
            fail(
                "{} exists, but its record {} is missing: remove all files of that name with --overwrite, or choose "
                "another name",
                pictures.front().string(), names.record().string());
        }
        if (writeNewFile(names.record(), text)) {
            return;
        }
    }
    compareRecords(names, record, warn);
}

}  // namespace reflet
