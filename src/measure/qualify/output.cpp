// Stored pictures, and the forms of a qualification: JSON, and a page.
#include "base/embedded.h"
#include "base/error.h"
#include "base/json_text.h"
#include "measure/qualify/qualify.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet {

std::span<const EmbeddedFile> qualifyFiles();

namespace {

using Json = nlohmann::ordered_json;

nlohmann::json storedFile(std::string_view name) {
    for (const EmbeddedFile& file : qualifyFiles()) {
        if (file.name == name) {
            return parseJson(file.text);
        }
    }
    fail("there is no stored file '{}'", name);
}

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
    TextTable table{
        {{"scene"}, {"preset"}, {"mean", true}, {"worst", true}, {"error", true}, {"llvmpipe's", true}, {"result"}},
        {}};
    const auto share = [](const std::optional<double>& value) { return value ? percent(*value) : std::string(); };
    for (const QualifiedPicture& picture : q.pictures) {
        const char* result = !picture.finite       ? "FAILED: not finite"
                             : !picture.difference ? "no picture is stored"
                             : picture.passes()    ? "passed"
                                                   : "FAILED";
        table.rows.push_back({{picture.scene},
                              {picture.preset},
                              {picture.difference ? percent(picture.difference->mean) : ""},
                              {picture.difference ? percent(picture.difference->worst) : ""},
                              {share(picture.error)},
                              {share(picture.storedError)},
                              {result}});
    }
    return {
        "Pictures",
        {fmt::format("Luminance of {} cells of frame {} at {}, against llvmpipe's. Allowed: mean {}, worst cell {}. "
                     "Error: mean difference from the path-traced reference, which is not judged.",
                     sizeText(gridSize), qualifyFrames + 1, sizeText(qualifySize), percent(gridTolerance.mean),
                     percent(gridTolerance.worst))},
        table};
}

// Modelled times of the library's steady frames (docs/gpu_model.py), by pass: milliseconds on each of these GPUs.
using Modelled = std::map<std::string, std::vector<double>>;
constexpr uvec2 modelledSize{1920, 1080};
constexpr const char* modelledGpus = "RX 6800 XT / RTX 3060";

// Of a preset's passes; none for frames of another size.
Modelled modelledTimes(const Qualification& q, const std::string& preset) {
    const auto all = storedFile("model.json").get<std::map<std::string, Modelled>>();
    const auto found = all.find(preset);
    return q.timedSize == modelledSize && found != all.end() ? found->second : Modelled{};
}

std::string timesText(const std::vector<double>& ms) {
    std::vector<std::string> texts;
    std::ranges::transform(ms, std::back_inserter(texts), [](double v) { return fmt::format("{:.3f}", v); });
    return fmt::format("{}", fmt::join(texts, " / "));
}

// All passes, the slowest first.
std::vector<std::string> passOrder(const Qualification& q) {
    std::map<std::string, double> most;
    for (const QualifiedTimes& times : q.times) {
        for (const auto& [name, ms] : times.passMs) {
            most[name] = std::max(most[name], ms);
        }
    }
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [name, ms] : most) {
        order.emplace_back(-ms, name);
    }
    std::ranges::sort(order);
    std::vector<std::string> names;
    std::ranges::transform(order, std::back_inserter(names), [](const auto& one) { return one.second; });
    return names;
}

Section timeSection(const Qualification& q) {
    TextTable table{{{"pass"}}, {{{"frame, ms"}}, {{"device memory, MB"}}}};
    const std::vector<std::string> names = passOrder(q);
    for (const std::string& name : names) {
        table.rows.push_back({asCode(name)});
    }
    bool hasModel = false;
    for (const QualifiedTimes& times : q.times) {
        const Modelled modelled = modelledTimes(q, times.preset);
        hasModel = hasModel || !modelled.empty();
        table.columns.push_back({times.preset, true});
        table.rows[0].push_back({fmt::format("{:.3f}", times.frameMs)});
        table.rows[1].push_back({megabytes(times.memory)});
        for (size_t i = 0; i < names.size(); ++i) {
            const auto found = times.passMs.find(names[i]);
            table.rows[i + 2].push_back({found == times.passMs.end() ? "" : fmt::format("{:.3f}", found->second)});
        }
        if (modelled.empty()) {
            continue;
        }
        table.columns.push_back({"modelled", true});
        table.rows[0].push_back({});
        table.rows[1].push_back({});
        for (size_t i = 0; i < names.size(); ++i) {
            const auto found = modelled.find(names[i]);
            table.rows[i + 2].push_back({found == modelled.end() ? "" : timesText(found->second)});
        }
    }
    std::string text =
        fmt::format("builtin:{} at {}, medians by the device's timestamps, ms.", q.timedScene, sizeText(q.timedSize));
    if (hasModel) {
        text += fmt::format(
            " Modelled: of the library's passes on {} (docs/gpu-model.md), which are not the program's in everything.",
            modelledGpus);
    }
    return {"Times", {text}, table};
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
    return storedFile("grids.json").get<std::map<std::string, LuminanceGrid>>();
}

// A line for each picture, four digits a cell.
std::string gridsText(const Qualification& q) {
    std::vector<std::string> lines;
    const auto add = [&](const std::string& name, const LuminanceGrid& grid) {
        std::vector<std::string> cells;
        std::ranges::transform(grid, std::back_inserter(cells), [](float v) { return fmt::format("{:.4g}", v); });
        lines.push_back(fmt::format("\"{}\": [{}]", name, fmt::join(cells, ",")));
    };
    for (const QualifiedPicture& picture : q.pictures) {
        add(picture.scene + " " + picture.preset, picture.grid);
    }
    for (const auto& [scene, grid] : q.references) {
        add(scene + " reference", grid);
    }
    return fmt::format("{{\n{}\n}}\n", fmt::join(lines, ",\n"));
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
        one["reference_error"] = picture.error ? Json(*picture.error) : Json();
        one["reference_error_llvmpipe"] = picture.storedError ? Json(*picture.storedError) : Json();
        one["passes"] = picture.passes();
        one["luminance"] = picture.grid;
        json["pictures"].push_back(std::move(one));
    }
    json["timed"] = {{"scene", q.timedScene}, {"size", {q.timedSize.x, q.timedSize.y}}};
    for (const QualifiedTimes& times : q.times) {
        json["timed"]["presets"][times.preset] = {{"frame_ms", times.frameMs},
                                                  {"memory_bytes", times.memory},
                                                  {"passes_ms", times.passMs},
                                                  {"modelled_passes_ms", modelledTimes(q, times.preset)}};
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
