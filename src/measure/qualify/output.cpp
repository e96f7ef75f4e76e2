// Stored pictures, and the forms of a qualification: JSON, and a page.
#include "base/embedded.h"
#include "base/error.h"
#include "base/json_text.h"
#include "measure/qualify/qualify.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {

std::span<const EmbeddedFile> qualifyFiles();

namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share) {
    return fmt::format("{:.2f} %", 100.0 * share);
}

std::string megabytes(uint64_t bytes) {
    return fmt::format("{:.1f}", static_cast<double>(bytes) / 1e6);
}

std::string sizeText(uvec2 size) {
    return fmt::format("{}x{}", size.x, size.y);
}

Section deviceSection(const Qualification& q) {
    const gpu::DeviceDescription& d = q.device;
    TextTable table{{{"device"}, {d.name}}, {}};
    const auto add = [&](const char* name, const std::string& value) { table.rows.push_back({{name}, {value}}); };
    add("kind", d.kind);
    add("Vulkan", d.api);
    add("driver", d.driver);
    add("optional features", d.extras.empty() ? "none" : fmt::format("{}", fmt::join(d.extras, ", ")));
    add("Reflet", q.version);
    add("validation", !q.validated         ? "the layer is not installed"
                      : q.messages.empty() ? "no messages"
                                           : fmt::format("{} messages", q.messages.size()));
    return {fmt::format("Qualification: {}", q.passes() ? "passed" : "FAILED"), {}, table};
}

Section pictureSection(const Qualification& q) {
    TextTable table{{{"scene"}, {"preset"}, {"mean", true}, {"worst", true}, {"result"}}, {}};
    for (const QualifiedPicture& picture : q.pictures) {
        const char* result = !picture.finite       ? "FAILED: not finite"
                             : !picture.difference ? "no picture is stored"
                             : picture.passes()    ? "passed"
                                                   : "FAILED";
        table.rows.push_back({{picture.scene},
                              {picture.preset},
                              {picture.difference ? percent(picture.difference->mean) : ""},
                              {picture.difference ? percent(picture.difference->worst) : ""},
                              {result}});
    }
    return {
        "Pictures",
        {fmt::format("Luminance of {} cells of frame {} at {}, against llvmpipe's. Allowed: mean {}, worst cell {}.",
                     sizeText(gridSize), qualifyFrames + 1, sizeText(qualifySize), percent(gridTolerance.mean),
                     percent(gridTolerance.worst))},
        table};
}

Section timeSection(const Qualification& q) {
    TextTable table{{{"pass"}}, {}};
    std::map<std::string, double> most;
    TextTable::Row frame{{"frame, ms"}};
    TextTable::Row memory{{"device memory, MB"}};
    for (const QualifiedTimes& times : q.times) {
        table.columns.push_back({times.preset, true});
        frame.push_back({fmt::format("{:.3f}", times.frameMs)});
        memory.push_back({megabytes(times.memory)});
        for (const auto& [name, ms] : times.passMs) {
            most[name] = std::max(most[name], ms);
        }
    }
    table.rows = {frame, memory};
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [name, ms] : most) {
        order.emplace_back(-ms, name);
    }
    std::ranges::sort(order);
    for (const auto& [ms, name] : order) {
        TextTable::Row row{asCode(name)};
        for (const QualifiedTimes& times : q.times) {
            const auto found = times.passMs.find(name);
            row.push_back({found == times.passMs.end() ? "" : fmt::format("{:.3f}", found->second)});
        }
        table.rows.push_back(row);
    }
    return {
        "Times",
        {fmt::format("builtin:{} at {}, medians by the device's timestamps, ms.", q.timedScene, sizeText(q.timedSize))},
        table};
}

Section stabilitySection(const Qualification& q) {
    const Stability& s = q.stability;
    return {"Stability",
            {fmt::format("{} frames in {:.0f} s, {} rounds from the same start: {} of their pictures differ from the "
                         "first. Device memory {} MB after the first round, {} MB after the last: {}.",
                         s.frames, s.seconds, s.rounds, s.differing, megabytes(s.memoryBegin), megabytes(s.memoryEnd),
                         s.passes() ? "passed" : "FAILED")},
            {}};
}

}  // namespace

std::map<std::string, LuminanceGrid> storedGrids() {
    std::map<std::string, LuminanceGrid> grids;
    for (const EmbeddedFile& file : qualifyFiles()) {
        const nlohmann::json stored = parseJson(file.text);
        for (const auto& [name, grid] : stored.items()) {
            grids[name] = grid.get<LuminanceGrid>();
        }
    }
    return grids;
}

// A line for each picture, four digits a cell.
std::string gridsText(const std::vector<QualifiedPicture>& pictures) {
    std::string text = "{\n";
    for (const QualifiedPicture& picture : pictures) {
        std::vector<std::string> cells;
        std::ranges::transform(picture.grid, std::back_inserter(cells),
                               [](float v) { return fmt::format("{:.4g}", v); });
        text += fmt::format("\"{} {}\": [{}]{}\n", picture.scene, picture.preset, fmt::join(cells, ","),
                            &picture == &pictures.back() ? "" : ",");
    }
    return text + "}\n";
}

std::string qualificationJson(const Qualification& q) {
    Json json{{"version", q.version},
              {"passes", q.passes()},
              {"device",
               {{"name", q.device.name},
                {"kind", q.device.kind},
                {"vulkan", q.device.api},
                {"driver", q.device.driver},
                {"optional_features", q.device.extras}}},
              {"validated", q.validated},
              {"validation_messages", q.messages}};
    for (const QualifiedPicture& picture : q.pictures) {
        Json one{{"scene", picture.scene}, {"preset", picture.preset}, {"finite", picture.finite}};
        one["mean_difference"] = picture.difference ? Json(picture.difference->mean) : Json();
        one["worst_difference"] = picture.difference ? Json(picture.difference->worst) : Json();
        one["passes"] = picture.passes();
        one["luminance"] = picture.grid;
        json["pictures"].push_back(std::move(one));
    }
    json["timed"] = {{"scene", q.timedScene}, {"size", {q.timedSize.x, q.timedSize.y}}};
    for (const QualifiedTimes& times : q.times) {
        json["timed"]["presets"][times.preset] = {
            {"frame_ms", times.frameMs}, {"memory_bytes", times.memory}, {"passes_ms", times.passMs}};
    }
    const Stability& s = q.stability;
    json["stability"] = {
        {"seconds", s.seconds},          {"frames", s.frames},        {"rounds", s.rounds},  {"differing", s.differing},
        {"memory_begin", s.memoryBegin}, {"memory_end", s.memoryEnd}, {"passes", s.passes()}};
    return jsonText(json, 1) + "\n";
}

std::vector<Section> qualificationDocument(const Qualification& q) {
    std::vector<Section> document{deviceSection(q), pictureSection(q), timeSection(q), stabilitySection(q)};
    if (!q.messages.empty()) {
        TextTable table{{{"validation message"}}, {}};
        for (const std::string& message : q.messages) {
            table.rows.push_back({{message}});
        }
        document.push_back({"Validation", {}, table});
    }
    return document;
}

}  // namespace reflet
