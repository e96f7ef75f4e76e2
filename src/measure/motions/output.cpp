#include "measure/motions/output.h"

#include "base/json_text.h"
#include "measure/report/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace reflet {

namespace {

using Json = nlohmann::ordered_json;

constexpr uint32_t mostLag = 4;
constexpr double mostGhost = 0.02;
constexpr double mostFlicker = 1.2;

// NaN is null.
Json numbersJson(std::span<const double> values) {
    Json json = Json::array();
    for (const double value : values) {
        json.push_back(std::isfinite(value) ? Json(value) : Json());
    }
    return json;
}

Json errorsJson(const MotionErrors& errors) {
    return {{"displayed_flip", numbersJson(errors.flip)}, {"relative_mse", numbersJson(errors.relativeMse)}};
}

Json lagJson(const MotionsRun& run, const std::vector<double>& left) {
    const std::optional<uint32_t> lag = lagOf(run, left);
    return lag ? Json(*lag) : Json();
}

Json runJson(const MotionsRun& run) {
    Json json = {{"case", run.motion.name},
                 {"variant", run.variant},
                 {"settings", run.settings},
                 {"error_ratio", errorRatio(run)},
                 {"error_in_motion", errorsJson(run.moving)},
                 {"error_at_rest", errorsJson(run.rest)},
                 {"ghost", {{"left", numbersJson(run.ghosts.left)}, {"pixels", run.ghosts.pixels}}},
                 {"flicker_ratio", flickerRatio(run)},
                 {"flicker",
                  {{"in_motion", run.flicker.frames}, {"settled", run.flicker.settled}, {"at_rest", run.restFlicker}}}};
    if (run.motion.lag != MotionCase::Lag::none) {
        json["lag"] = {{"of", run.motion.lag == MotionCase::Lag::light ? "light" : "error"},
                       {"frames", lagJson(run, run.left)},
                       {"left", numbersJson(run.left)}};
    }
    if (!run.indirectLeft.empty()) {
        json["lag"]["indirect_frames"] = lagJson(run, run.indirectLeft);
        json["lag"]["indirect_left"] = numbersJson(run.indirectLeft);
    }
    return json;
}

Phrase judged(std::string text, bool good) {
    return {std::move(text), good ? Phrase::Style::plain : Phrase::Style::emphasis};
}

Phrase ghostText(double left) {
    if (!std::isfinite(left)) {
        return "–";
    }
    return judged(fmt::format("{:.1f} %", 100.0 * left), left <= mostGhost);
}

Phrase lagText(const MotionsRun& run, const std::vector<double>& left) {
    if (left.empty() || std::ranges::any_of(left, [](double value) { return std::isnan(value); })) {
        return "–";
    }
    const std::optional<uint32_t> lag = lagOf(run, left);
    return judged(lag ? std::to_string(*lag) : fmt::format("> {}", left.size() - 1),
                  lag.value_or(mostLag + 1) <= mostLag);
}

double meanOf(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value / static_cast<double>(values.size());
    }
    return sum;
}

TextTable::Row rowOf(const MotionsRun& run) {
    const double ratio = errorRatio(run);
    const double flicker = flickerRatio(run);
    const double firstGhost = run.ghosts.left.front();
    return {std::string(run.motion.name),
            flipText(meanOf(run.rest.flip)),
            flipText(meanOf(run.moving.flip)),
            judged(fmt::format("{:.2f}", ratio), ratio <= run.motion.ratio),
            std::isfinite(firstGhost) ? fmt::format("{:.1f} %", 100.0 * firstGhost) : "–",
            ghostText(run.ghosts.left.back()),
            lagText(run, run.left),
            lagText(run, run.indirectLeft),
            judged(fmt::format("{:.2f}", flicker), flicker <= mostFlicker)};
}

Section sectionOf(const MotionsResult& result, const std::string& variant) {
    constexpr bool isNumber = true;
    TextTable table{{{"case"},
                     {"FLIP at rest", isNumber},
                     {"in motion", isNumber},
                     {"ratio", isNumber},
                     {"ghost after 1 frame", isNumber},
                     {fmt::format("after {}", oldestGhost), isNumber},
                     {"lag, frames", isNumber},
                     {"of indirect light", isNumber},
                     {"flicker", isNumber}},
                    {}};
    for (const MotionsRun& run : result.runs) {
        if (run.variant == variant) {
            table.rows.push_back(rowOf(run));
        }
    }
    return {variant, {}, std::move(table)};
}

// With 6 bits per channel, to keep files small.
void copyInto(Bitmap& to, const Bitmap& from, size_t x, size_t y) {
    for (size_t row = 0; row < from.height; ++row) {
        for (size_t column = 0; column < from.width; ++column) {
            for (size_t c = 0; c < 3; ++c) {
                const uint8_t value = from.data[(row * from.width + column) * from.channels + c];
                to.data[((y + row) * to.width + x + column) * 3 + c] =
                    static_cast<uint8_t>((value & 0xFCU) | (value >> 6U));
            }
        }
    }
}

}  // namespace

std::string motionsJson(const BenchHead& head, const MotionsPlan& plan, const MotionsResult& result) {
    Json runs = Json::array();
    for (const MotionsRun& run : result.runs) {
        runs.push_back(runJson(run));
    }
    const Json json = {{"reflet", head.version},
                       {"command", head.command},
                       {"device", head.device},
                       {"driver", head.driver},
                       {"size", {plan.size.x, plan.size.y}},
                       {"settle", plan.settle},
                       {"motions", runs}};
    return jsonText(json, 2) + "\n";
}

std::vector<Section> motionsDocument(const BenchHead& head, const MotionsPlan& plan, const MotionsResult& result) {
    TextTable cases{{{"case"}, {"what moves"}, {"frames", true}}, {}};
    for (const MotionCase& which : plan.cases) {
        cases.rows.push_back({std::string(which.name), std::string(which.description), std::to_string(which.frames)});
    }
    std::vector<Section> document{{"",
                                   {"Generated by ", asCode(head.command),
                                    fmt::format(" with reflet {} on {} ({}), {}x{} pixels. Emphasised numbers miss "
                                                "their target.",
                                                head.version, head.device, head.driver, plan.size.x, plan.size.y)},
                                   std::move(cases)}};
    for (const Variant& variant : plan.variants) {
        document.push_back(sectionOf(result, variant.name));
    }
    return document;
}

Bitmap motionsStrip(const MotionsPlan& plan, const MotionsResult& result, size_t which) {
    Bitmap strip;
    strip.width = static_cast<uint32_t>(plan.size.x * stripFrames.size());
    strip.height = static_cast<uint32_t>(plan.size.y * (plan.variants.size() + 1));
    strip.channels = 3;
    strip.data.resize(size_t(strip.width) * strip.height * 3);
    for (size_t row = 0; row <= plan.variants.size(); ++row) {
        const std::vector<Bitmap>& pictures =
            row == 0 ? result.truths[which] : result.runs[which * plan.variants.size() + row - 1].pictures;
        for (size_t column = 0; column < stripFrames.size(); ++column) {
            copyInto(strip, pictures[column], column * plan.size.x, row * plan.size.y);
        }
    }
    return strip;
}

}  // namespace reflet
