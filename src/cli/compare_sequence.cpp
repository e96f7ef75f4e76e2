// `reflet compare` with sequences: a table over frames, means, and the worst frame of each metric.
#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/progress.h"
#include "base/visible_text.h"
#include "cli/compare.h"
#include "compare/heat_map.h"
#include "job/scene_options.h"
#include "job/sequence_names.h"
#include "measure/report/frame_plot.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace reflet {

namespace {

struct FrameError {
    uint32_t frame = 0;
    Difference difference;
};

using FrameErrors = std::vector<FrameError>;

std::string list(const std::vector<uint32_t>& numbers) {
    constexpr size_t most = 5;
    const size_t shown = std::min(most, numbers.size());
    return fmt::format("{}{}", fmt::join(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                       numbers.size() > shown ? fmt::format(" and {} more", numbers.size() - shown) : "");
}

std::vector<uint32_t> without(const std::vector<uint32_t>& numbers, const std::vector<uint32_t>& others) {
    std::vector<uint32_t> rest;
    std::ranges::set_difference(numbers, others, std::back_inserter(rest));
    return rest;
}

// Those of the reference, which may have fewer; a frame that it has and the other one lacks is an error.
std::vector<uint32_t> framesToCompare(const PicturePair& names) {
    const std::vector<uint32_t> frames = FrameNames(names[0].file).numbers();
    if (frames.empty()) {
        fail("{}: there is no file of that name", names[0].file);
    }
    if (!FrameNames::isPattern(names[1].file)) {
        return frames;
    }
    const std::vector<uint32_t> truths = FrameNames(names[1].file).numbers();
    if (truths.empty()) {
        fail("{}: there is no file of that name", names[1].file);
    }
    if (const auto missing = without(truths, frames); !missing.empty()) {
        fail("{} lacks frames that {} has: {}", names[0].file, names[1].file, list(missing));
    }
    if (const auto more = without(frames, truths); !more.empty()) {
        printWarning(fmt::format("{} lacks frames that {} has, which are not compared: {}", names[1].file,
                                 names[0].file, list(more)));
    }
    return truths;
}

std::string fileOf(const std::string& name, uint32_t frame) {
    return FrameNames::isPattern(name) ? FrameNames(name).file(frame).string() : name;
}

PictureName pictureOf(PictureName name, uint32_t frame) {
    name.file = fileOf(name.file, frame);
    name.text = name.layer.empty() ? name.file : name.file + ":" + name.layer;
    return name;
}

// Larger is worse.
double badness(const Metric& metric, const Difference& difference) {
    const double value = metric.value(difference);
    return metric.largeIsGood ? -value : std::abs(value);
}

const FrameError& worstOf(const Metric& metric, const FrameErrors& errors) {
    return *std::ranges::max_element(errors, {},
                                     [&](const FrameError& error) { return badness(metric, error.difference); });
}

double meanOf(const Metric& metric, const FrameErrors& errors) {
    double sum = 0.0;
    for (const FrameError& error : errors) {
        sum += metric.value(error.difference);
    }
    return sum / static_cast<double>(errors.size());
}

// 10 characters take every number of 4 digits: -1.234e-05.
void printTable(const FrameErrors& errors, std::span<const Metric> columns) {
    fmt::print("{:<10}", "frame");
    for (const Metric& metric : columns) {
        fmt::print(" {:>12}", metric.name);
    }
    fmt::print("\n");
    const auto row = [&](const std::string& name, const auto& textOf) {
        fmt::print("{:<10}", visibleText(name));
        for (const Metric& metric : columns) {
            fmt::print(" {:>12}", textOf(metric));
        }
        fmt::print("\n");
    };
    const auto number = [](double value) { return fmt::format("{:.4g}", value); };
    for (const FrameError& error : errors) {
        row(fmt::format("{}", error.frame), [&](const Metric& m) { return number(m.value(error.difference)); });
    }
    row("mean", [&](const Metric& m) { return number(meanOf(m, errors)); });
    row("worst", [&](const Metric& m) { return number(m.value(worstOf(m, errors).difference)); });
    row("in frame", [&](const Metric& m) { return fmt::format("{}", worstOf(m, errors).frame); });
}

// JSON has no infinity: it becomes null.
void printJson(const CompareCommand& command, ImageKind kind, uvec2 size, const FrameErrors& errors) {
    nlohmann::ordered_json json{{"picture", command.picture},
                                {"truth", command.truth},
                                {"kind", kind == ImageKind::linear ? "linear" : "display"},
                                {"size", {size.x, size.y}},
                                {"pixels_per_degree", command.pixelsPerDegree},
                                {"frames", nlohmann::ordered_json::array()}};
    for (const FrameError& error : errors) {
        nlohmann::ordered_json frame{{"frame", error.frame}};
        for (const Metric& metric : comparedMetrics()) {
            frame[std::string(metric.name)] = metric.value(error.difference);
        }
        frame["pixels"] = error.difference.pixels;
        json["frames"].push_back(frame);
    }
    for (const Metric& metric : comparedMetrics()) {
        const FrameError& worst = worstOf(metric, errors);
        json["mean"][std::string(metric.name)] = meanOf(metric, errors);
        json["worst"][std::string(metric.name)] = {{"frame", worst.frame}, {"value", metric.value(worst.difference)}};
    }
    fmt::print("{}\n", jsonText(json, 2));
}

FramePlot plotOf(const CompareCommand& command, const FrameErrors& errors) {
    FramePlot plot{.title = fmt::format("{} against {}", command.picture, command.truth), .frames = {}, .curves = {}};
    for (const FrameError& error : errors) {
        plot.frames.push_back(error.frame);
    }
    for (const Metric& metric : metrics()) {
        FrameCurve curve{.name = std::string(metric.name), .unit = std::string(metric.unit)};
        for (const FrameError& error : errors) {
            curve.values.push_back(metric.value(error.difference));
        }
        curve.marked = static_cast<size_t>(&worstOf(metric, errors) - errors.data());
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

void checkLimits(const std::vector<Limit>& limits, const FrameErrors& errors) {
    std::vector<std::string> broken;
    for (const Limit& limit : limits) {
        const auto breaks = [&](const FrameError& error) { return limit.isBroken(error.difference); };
        const auto count = std::ranges::count_if(errors, breaks);
        if (count == 0) {
            continue;
        }
        // Of a metric with a sign (bias), only what is too large breaks the limit.
        const FrameError& worst = *std::ranges::max_element(errors, {}, [&](const FrameError& error) {
            const double value = limit.metric.value(error.difference);
            return limit.metric.largeIsGood ? -value : value;
        });
        broken.push_back(
            fmt::format("{} is {} in frame {}, {} the limit {}{}", limit.metric.name,
                        valueText(limit.metric, limit.metric.value(worst.difference)), worst.frame,
                        limit.metric.largeIsGood ? "below" : "above", limit.value,
                        count > 1 ? fmt::format(" ({} of {} frames break it)", count, errors.size()) : ""));
    }
    if (!broken.empty()) {
        fail("{}", fmt::join(broken, "; "));
    }
}

}  // namespace

void compareSequences(const CompareCommand& command, const PicturePair& names, const std::vector<Limit>& limits) {
    const std::vector<uint32_t> frames = framesToCompare(names);
    const bool allMaps = FrameNames::isPattern(command.heatMap);
    FrameErrors errors;
    FloatImage worstMap;
    double worstFlip = -1.0;
    Progress progress("comparing frame", frames.size());
    for (const uint32_t frame : frames) {
        CompareCommand now = command;
        now.mask = fileOf(command.mask, frame);
        Comparison result = comparePair(now, {pictureOf(names[0], frame), pictureOf(names[1], frame)});
        errors.push_back({frame, result.difference});
        if (allMaps) {
            writePng(fileOf(command.heatMap, frame), heatMap(result.flip));
        }
        if (result.difference.flip > worstFlip) {
            worstFlip = result.difference.flip;
            worstMap = std::move(result.flip);
        }
        progress.advance();
    }
    if (!command.heatMap.empty() && !allMaps) {
        writePng(command.heatMap, heatMap(worstMap));
    }
    if (!command.plot.empty()) {
        writeFileAtomically(command.plot, framePlot(plotOf(command, errors)));
    }
    if (command.json) {
        printJson(command, names[0].kind, {worstMap.width, worstMap.height}, errors);
    } else {
        printTable(errors, metrics());
        fmt::print("\n");
        printTable(errors, octaveMetrics());
    }
    checkLimits(limits, errors);
}

}  // namespace reflet
