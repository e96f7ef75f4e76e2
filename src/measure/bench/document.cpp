// Writes a bench as tables.
#include "capture/spread.h"
#include "measure/bench/output.h"
#include "measure/report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace reflet {

namespace {

// At least three significant digits.
std::string msText(double ms) {
    const double size = std::abs(ms);
    return fmt::format("{:.{}f}", ms, size < 10.0 ? 3 : size < 100.0 ? 2 : 1);
}

std::string spreadText(const Spread& spread) {
    return fmt::format("{} ({}–{})", msText(spread.median), msText(spread.lowerQuartile), msText(spread.upperQuartile));
}

std::string timeText(const Samples& samples, SeriesKind kind, const std::string& name) {
    const Series* series = samples.find(kind, name);
    return series == nullptr ? "" : spreadText(spreadOf(series->ms));
}

std::string medianText(const Samples& samples, SeriesKind kind, const std::string& name) {
    const Series* series = samples.find(kind, name);
    return series == nullptr ? "" : msText(spreadOf(series->ms).median);
}

std::string sizeText(uvec2 size) {
    return fmt::format("{}x{}", size.x, size.y);
}

std::string megabytes(uint64_t bytes) {
    return fmt::format("{:.1f}", static_cast<double>(bytes) / 1e6);
}

constexpr bool isNumber = true;

// Relative MSE, FLIP, FLIP of the display image.
void addErrors(TextTable::Row& row, const BenchState& state) {
    const bool known = state.error.has_value();
    row.emplace_back(known ? relativeMseText(state.error->relativeMse) : "");
    row.emplace_back(known ? flipText(state.error->flip) : "");
    row.emplace_back(known ? flipText(*state.displayedFlip) : "");
}

std::vector<TextTable::Column> frameColumns() {
    std::vector<TextTable::Column> columns{{"scene"}, {"variant"}, {"size"}};
    for (const char* name : {"device ms", "submitted ms", "wall ms", "record ms", "ns per pixel", "first: device ms",
                             "submitted ms", "rel. MSE", "FLIP", "shown", "steady: rel. MSE", "FLIP", "shown",
                             "memory, MB", "transient, MB", "passes", "barriers"}) {
        columns.push_back({name, isNumber});
    }
    return columns;
}

TextTable frameTable(const BenchResult& result) {
    TextTable table{frameColumns(), {}};
    for (const BenchRun& run : result.runs) {
        const Samples& steady = run.steady.samples;
        const Series* submitted = steady.find(SeriesKind::total, "submitted");
        const double pixels = static_cast<double>(run.size.x) * run.size.y;
        TextTable::Row row{
            run.scene,
            run.variant,
            sizeText(run.size),
            timeText(steady, SeriesKind::total, "frame"),
            timeText(steady, SeriesKind::total, "submitted"),
            medianText(steady, SeriesKind::total, "wall"),
            medianText(steady, SeriesKind::total, "record"),
            submitted == nullptr ? "" : fmt::format("{:.1f}", spreadOf(submitted->ms).median * 1e6 / pixels),
            timeText(run.first.samples, SeriesKind::total, "frame"),
            timeText(run.first.samples, SeriesKind::total, "submitted")};
        addErrors(row, run.first);
        addErrors(row, run.steady);
        row.emplace_back(megabytes(run.memory));
        const std::optional<Recording>& recorded = steady.recording();
        row.emplace_back(recorded ? megabytes(recorded->transientBytes) : "");
        row.emplace_back(recorded ? std::to_string(recorded->passes) : "");
        row.emplace_back(recorded ? std::to_string(recorded->barriers) : "");
        table.rows.push_back(std::move(row));
    }
    return table;
}

Phrase nameOf(SeriesKind kind, const std::string& name) {
    switch (kind) {
        case SeriesKind::total:
            return name;
        case SeriesKind::group:
            return "all of " + name;
        default:
            return asCode(name);
    }
}

void addRatios(TextTable& table, const BenchState& a, const BenchState& b, const char* state) {
    for (const Ratio& ratio : ratiosOf(a.samples, b.samples)) {
        table.rows.push_back({state, nameOf(ratio.kind, ratio.name), spreadText(spreadOf(ratio.ratios)),
                              spreadText(spreadOf(ratio.differences)), std::to_string(ratio.differences.size())});
    }
    if (a.error && b.error) {
        table.rows.push_back(
            {state, "relative MSE", fmt::format("{:.3f}", a.error->relativeMse / b.error->relativeMse),
             fmt::format("{} against {}", relativeMseText(a.error->relativeMse), relativeMseText(b.error->relativeMse)),
             ""});
    }
}

Section pairSection(const BenchPair& pair, const std::vector<BenchRun>& runs) {
    const BenchRun& a = runs[pair.a];
    const BenchRun& b = runs[pair.b];
    TextTable table{{{"state"},
                     {"what"},
                     {"ratio (quartiles)", isNumber},
                     {"difference, ms (quartiles)", isNumber},
                     {"turns", isNumber}},
                    {}};
    addRatios(table, a.first, b.first, "first");
    addRatios(table, a.steady, b.steady, "steady");
    return {fmt::format("{} against {}: {}, {}", a.variant, b.variant, a.scene, sizeText(a.size)),
            {"Times of the first divided by those of the second, frames alternating."},
            std::move(table)};
}

Section motionSection(const BenchResult& result) {
    TextTable table{{{"scene"},
                     {"variant"},
                     {"size"},
                     {"FLIP at rest", isNumber},
                     {"in motion (quartiles)", isNumber},
                     {"max", isNumber},
                     {"flicker", isNumber},
                     {"of the reference", isNumber}},
                    {}};
    for (const BenchRun& run : result.runs) {
        if (!run.motion) {
            continue;
        }
        const Spread flip = spreadOf(run.motion->displayedFlip);
        table.rows.push_back({run.scene, run.variant, sizeText(run.size), flipText(*run.steady.displayedFlip),
                              fmt::format("{} ({}–{})", flipText(flip.median), flipText(flip.lowerQuartile),
                                          flipText(flip.upperQuartile)),
                              flipText(flip.max), flipText(run.motion->flicker), flipText(run.motion->truthFlicker)});
    }
    return {"In motion",
            {"FLIP of every displayed frame against its own reference while the camera orbits; flicker: "
             "temporal change that the motion vectors do not explain."},
            std::move(table)};
}

std::vector<TextTable::Column> octaveColumns() {
    std::vector<TextTable::Column> columns{{"scene"}, {"variant"}, {"size"}};
    for (const char* name :
         {"frame", "rel. MSE", "FLIP", "shown", "2–4 pixels", "4–8", "8–16", "16–32", "32–64", "64–"}) {
        columns.push_back({name, isNumber});
    }
    return columns;
}

// Errors of octaves span several orders of magnitude.
std::string powerText(double error) {
    return fmt::format("{:.2e}", error);
}

double meanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void addOctaveRow(TextTable& table, const BenchRun& run, const std::string& frame, std::array<double, 3> errors,
                  const OctaveErrors& octaves) {
    TextTable::Row row{run.scene,           run.variant,        sizeText(run.size), frame, powerText(errors[0]),
                       flipText(errors[1]), flipText(errors[2])};
    std::ranges::transform(octaves, std::back_inserter(row), powerText);
    table.rows.push_back(std::move(row));
}

Section octaveSection(const BenchResult& result) {
    TextTable table{octaveColumns(), {}};
    for (const BenchRun& run : result.runs) {
        for (const StillError& error : run.still) {
            const Difference& d = error.difference;
            addOctaveRow(table, run, std::to_string(error.frame), {d.relativeMse, d.flip, error.displayedFlip},
                         d.octaves);
        }
        if (run.motion) {
            const MotionResult& m = *run.motion;
            addOctaveRow(table, run, "in motion", {meanOf(m.relativeMse), meanOf(m.flip), meanOf(m.displayedFlip)},
                         m.octaves);
        }
    }
    return {"Error over frames and by octave",
            {"Frames of a still view, frame 1 without history; in motion: means over frames. Octaves: parts of the "
             "relative MSE by wavelength; they sum to it."},
            std::move(table)};
}

Section restSection(const BenchResult& result) {
    constexpr size_t shown[] = {1, 2, 4, 8, 16};
    TextTable table{{{"scene"}, {"variant"}, {"size"}}, {}};
    for (const size_t after : shown) {
        table.columns.push_back({std::to_string(after), isNumber});
    }
    for (const BenchRun& run : result.runs) {
        TextTable::Row row{run.scene, run.variant, sizeText(run.size)};
        for (const size_t after : shown) {
            const bool known = run.motion && after <= run.motion->rest.size();
            row.emplace_back(known ? fmt::format("{:.1f} %", 100.0 * run.motion->rest[after - 1]) : "");
        }
        table.rows.push_back(std::move(row));
    }
    return {"At rest after motion",
            {"Reflections, where the motion changed them: mean difference from their final value, relative to its "
             "mean, by the number of frames since the motion stopped."},
            std::move(table)};
}

Section scalingSection(const std::vector<Scaling>& all) {
    TextTable table{{{"scene"}, {"variant"}, {"sizes"}, {"ns per pixel", isNumber}, {"spread", isNumber}}, {}};
    for (const Scaling& s : all) {
        std::vector<std::string> sizes;
        std::ranges::transform(s.sizes, std::back_inserter(sizes), sizeText);
        table.rows.push_back({s.scene, s.variant, fmt::format("{}", fmt::join(sizes, ", ")),
                              fmt::format("{:.1f}", fmt::join(s.nsPerPixel, ", ")),
                              fmt::format("{:.0f} %", 100.0 * s.spread)});
    }
    return {"Cost per pixel",
            {"Time from submission to fence divided by the number of pixels; spread: largest / smallest - "
             "1."},
            std::move(table)};
}

Section passSection(const BenchRun& run, double bandwidth) {
    TextTable table{{{"pass"},
                     {"ms (quartiles)", isNumber},
                     {"first frame, ms", isNumber},
                     {"bound, MB", isNumber},
                     {"floor, ms", isNumber},
                     {"floor over time", isNumber}},
                    {}};
    for (const Series& series : run.steady.samples.series()) {
        if (series.kind == SeriesKind::total && series.name != "frame") {
            continue;
        }
        const Spread spread = spreadOf(series.ms);
        std::string floor;
        std::string share;
        if (bandwidth > 0.0 && series.bytes > 0) {
            const double floorMs = static_cast<double>(series.bytes) / bandwidth * 1e3;
            floor = msText(floorMs);
            share = spread.median > 0.0 ? fmt::format("{:.0f} %", 100.0 * floorMs / spread.median) : "";
        }
        const SeriesKind kind = series.kind == SeriesKind::total ? SeriesKind::group : series.kind;
        table.rows.push_back({nameOf(kind, series.name), spreadText(spread),
                              medianText(run.first.samples, series.kind, series.name), megabytes(series.bytes), floor,
                              share});
    }
    return {fmt::format("Passes: {}, {}, {}", run.scene, run.variant, sizeText(run.size)), {}, std::move(table)};
}

}  // namespace

std::vector<Section> benchDocument(const BenchHead& head, const BenchPlan& plan, const BenchResult& result) {
    std::vector<Section> document{
        {"",
         {"Generated by ", asCode(head.command),
          fmt::format(" with reflet {} on {} ({}). Medians and quartiles of {} frames with history after {} warm-up "
                      "frames, and of {} frames without history.",
                      head.version, head.device, head.driver, plan.frames, plan.warmup, plan.firstFrames)},
         frameTable(result)}};
    for (const BenchPair& pair : result.pairs) {
        document.push_back(pairSection(pair, result.runs));
    }
    if (const auto scaling = scalingOf(result); !scaling.empty()) {
        document.push_back(scalingSection(scaling));
    }
    if (!plan.stillFrames.empty() || plan.motion.frames > 0) {
        document.push_back(octaveSection(result));
    }
    if (plan.motion.frames > 0) {
        document.push_back(motionSection(result));
    }
    if (plan.motion.rest > 0) {
        document.push_back(restSection(result));
    }
    for (const BenchRun& run : result.runs) {
        document.push_back(passSection(run, head.bandwidth));
    }
    if (head.bandwidth > 0.0) {
        document.push_back(
            {"", {fmt::format("Measured bandwidth: {:.1f} GB/s, read plus write.", head.bandwidth * 1e-9)}, {}});
    }
    return document;
}

}  // namespace reflet
