// Writes a bench as Markdown tables.
#include "capture/spread.h"
#include "measure/bench/output.h"
#include "measure/report/text.h"

#include <fmt/format.h>

#include <algorithm>

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

std::string errorText(const BenchState& state) {
    return state.error ? relativeMseText(state.error->relativeMse) + " | " + flipText(state.error->flip) + " | " +
                             flipText(*state.displayedFlip)
                       : " | | ";
}

std::string frameTable(const BenchResult& result) {
    std::string text =
        "| scene | variant | size | device ms | submitted ms | wall ms | ns per pixel | first: device ms | submitted "
        "ms | rel. MSE | FLIP | shown | steady: rel. MSE | FLIP | shown | memory, MB |\n"
        "|---|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const BenchRun& run : result.runs) {
        const Samples& steady = run.steady.samples;
        const Series* submitted = steady.find(SeriesKind::total, "submitted");
        const double pixels = static_cast<double>(run.size.x) * run.size.y;
        const std::string perPixel =
            submitted == nullptr ? "" : fmt::format("{:.1f}", spreadOf(submitted->ms).median * 1e6 / pixels);
        text +=
            fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", escapeMarkdown(run.scene),
                        escapeMarkdown(run.variant), sizeText(run.size), timeText(steady, SeriesKind::total, "frame"),
                        timeText(steady, SeriesKind::total, "submitted"), medianText(steady, SeriesKind::total, "wall"),
                        perPixel, timeText(run.first.samples, SeriesKind::total, "frame"),
                        timeText(run.first.samples, SeriesKind::total, "submitted"), errorText(run.first),
                        errorText(run.steady), megabytes(run.memory));
    }
    return text;
}

void addRatioRow(std::string& text, const std::string& what, const Ratio& ratio, const char* state) {
    text += fmt::format("| {} | {} | {} | {} | {} |\n", state, what, spreadText(spreadOf(ratio.ratios)),
                        spreadText(spreadOf(ratio.differences)), ratio.differences.size());
}

void addRatios(std::string& text, const BenchState& a, const BenchState& b, const char* state) {
    for (const Ratio& ratio : ratiosOf(a.samples, b.samples)) {
        if (ratio.kind == SeriesKind::total) {
            addRatioRow(text, ratio.name, ratio, state);
        } else if (ratio.kind == SeriesKind::group) {
            addRatioRow(text, "all of " + escapeMarkdown(ratio.name), ratio, state);
        } else {
            addRatioRow(text, "`" + ratio.name + "`", ratio, state);
        }
    }
    if (a.error && b.error) {
        text += fmt::format("| {} | relative MSE | {:.3f} | {} against {} | |\n", state,
                            a.error->relativeMse / b.error->relativeMse, relativeMseText(a.error->relativeMse),
                            relativeMseText(b.error->relativeMse));
    }
}

std::string pairTable(const BenchPair& pair, const std::vector<BenchRun>& runs) {
    const BenchRun& a = runs[pair.a];
    const BenchRun& b = runs[pair.b];
    std::string text = fmt::format(
        "\n### {} against {}: {}, {}\n\nTimes of the first divided by those of the second, frames alternating.\n\n"
        "| state | what | ratio (quartiles) | difference, ms (quartiles) | turns |\n|---|---|--:|--:|--:|\n",
        escapeMarkdown(a.variant), escapeMarkdown(b.variant), escapeMarkdown(a.scene), sizeText(a.size));
    addRatios(text, a.first, b.first, "first");
    addRatios(text, a.steady, b.steady, "steady");
    return text;
}

std::string motionTable(const BenchResult& result) {
    std::string text =
        "\n### In motion\n\nFLIP of every displayed frame against its own reference while the camera orbits; flicker: "
        "temporal change that the motion vectors do not explain.\n\n"
        "| scene | variant | size | FLIP at rest | in motion (quartiles) | max | flicker | of the reference |\n"
        "|---|---|---|--:|--:|--:|--:|--:|\n";
    for (const BenchRun& run : result.runs) {
        if (!run.motion) {
            continue;
        }
        const Spread flip = spreadOf(run.motion->displayedFlip);
        text += fmt::format("| {} | {} | {} | {} | {} ({}–{}) | {} | {} | {} |\n", escapeMarkdown(run.scene),
                            escapeMarkdown(run.variant), sizeText(run.size), flipText(*run.steady.displayedFlip),
                            flipText(flip.median), flipText(flip.lowerQuartile), flipText(flip.upperQuartile),
                            flipText(flip.max), flipText(run.motion->flicker), flipText(run.motion->truthFlicker));
    }
    return text;
}

std::string restTable(const BenchResult& result) {
    std::string text =
        "\n### At rest after motion\n\nReflections, where the motion changed them: mean difference from their final "
        "value, relative to its mean, by the number of frames since the motion stopped.\n\n"
        "| scene | variant | size |";
    constexpr size_t shown[] = {1, 2, 4, 8, 16};
    for (const size_t after : shown) {
        text += fmt::format(" {} |", after);
    }
    text += "\n|---|---|---|--:|--:|--:|--:|--:|\n";
    for (const BenchRun& run : result.runs) {
        text +=
            fmt::format("| {} | {} | {} |", escapeMarkdown(run.scene), escapeMarkdown(run.variant), sizeText(run.size));
        for (const size_t after : shown) {
            const bool known = run.motion && after <= run.motion->rest.size();
            text += known ? fmt::format(" {:.1f} % |", 100.0 * run.motion->rest[after - 1]) : " |";
        }
        text += "\n";
    }
    return text;
}

std::string scalingTable(const std::vector<Scaling>& all) {
    std::string text =
        "\n### Cost per pixel\n\nTime from submission to fence divided by the number of pixels; spread: largest / "
        "smallest - 1.\n\n| scene | variant | sizes | ns per pixel | spread |\n|---|---|---|--:|--:|\n";
    for (const Scaling& s : all) {
        std::vector<std::string> sizes;
        std::ranges::transform(s.sizes, std::back_inserter(sizes), sizeText);
        text +=
            fmt::format("| {} | {} | {} | {:.1f} | {:.0f} % |\n", escapeMarkdown(s.scene), escapeMarkdown(s.variant),
                        fmt::join(sizes, ", "), fmt::join(s.nsPerPixel, ", "), 100.0 * s.spread);
    }
    return text;
}

std::string passTable(const BenchRun& run, double bandwidth) {
    std::string text = fmt::format(
        "\n### Passes: {}, {}, {}\n\n| pass | ms (quartiles) | first frame, ms | bound, MB | floor, ms | "
        "floor over time |\n|---|--:|--:|--:|--:|--:|\n",
        escapeMarkdown(run.scene), escapeMarkdown(run.variant), sizeText(run.size));
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
        const std::string name = series.kind == SeriesKind::pass ? "`" + series.name + "`" : "all of " + series.name;
        text +=
            fmt::format("| {} | {} | {} | {} | {} | {} |\n", name, spreadText(spread),
                        medianText(run.first.samples, series.kind, series.name), megabytes(series.bytes), floor, share);
    }
    return text;
}

}  // namespace

std::string benchMarkdown(const BenchHead& head, const BenchPlan& plan, const BenchResult& result) {
    std::string text = fmt::format(
        "Generated by `{}` with reflet {} on {} ({}). Medians and quartiles of {} frames with history after {} warm-up "
        "frames, and of {} frames without history.\n\n",
        head.command, head.version, head.device, head.driver, plan.frames, plan.warmup, plan.firstFrames);
    text += frameTable(result);
    for (const BenchPair& pair : result.pairs) {
        text += pairTable(pair, result.runs);
    }
    if (const auto scaling = scalingOf(result); !scaling.empty()) {
        text += scalingTable(scaling);
    }
    if (plan.motion.frames > 0) {
        text += motionTable(result);
    }
    if (plan.motion.rest > 0) {
        text += restTable(result);
    }
    for (const BenchRun& run : result.runs) {
        text += passTable(run, head.bandwidth);
    }
    if (head.bandwidth > 0.0) {
        text += fmt::format("\nMeasured bandwidth: {:.1f} GB/s, read plus write.\n", head.bandwidth * 1e-9);
    }
    return text;
}

}  // namespace reflet
