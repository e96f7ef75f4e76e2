// Writes a bench as JSON, and as a plot.
#include "base/json_text.h"
#include "capture/spread.h"
#include "measure/bench/output.h"
#include "measure/report/plot.h"
#include "measure/variants.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet {

namespace {

using Json = nlohmann::ordered_json;

Json sizeJson(uvec2 size) {
    return {size.x, size.y};
}

Json errorJson(const Difference& error) {
    Json json = Json::object();
    for (const Metric& metric : metrics()) {
        json[std::string(metric.name)] = metric.value(error);
    }
    return json;
}

Json seriesJson(const Series& series, double bandwidth) {
    Json json = spreadJson(spreadOf(series.ms));
    json["bytes"] = series.bytes;
    if (series.kind == SeriesKind::pass) {
        json["raster"] = series.raster;
    }
    if (bandwidth > 0.0) {
        json["floor_ms"] = static_cast<double>(series.bytes) / bandwidth * 1e3;
    }
    return json;
}

Json stateJson(const BenchState& state, double bandwidth) {
    Json json = {{"frames", state.samples.frames()}};
    Json groups = Json::object();
    Json passes = Json::object();
    for (const Series& series : state.samples.series()) {
        if (series.kind == SeriesKind::total) {
            json[series.name + "_ms"] = spreadJson(spreadOf(series.ms));
        } else {
            (series.kind == SeriesKind::group ? groups : passes)[series.name] = seriesJson(series, bandwidth);
        }
    }
    json["groups"] = groups;
    json["passes"] = passes;
    if (const std::optional<Recording>& recorded = state.samples.recording()) {
        json["recorded"] = {{"passes", recorded->passes},
                            {"barriers", recorded->barriers},
                            {"transient_bytes", recorded->transientBytes}};
    }
    json["error"] = state.error ? errorJson(*state.error) : Json();
    if (state.displayedFlip) {
        json["error"]["displayed_flip"] = *state.displayedFlip;
    }
    return json;
}

void addOctaves(Json& json, const Difference& difference) {
    for (const Metric& metric : octaveMetrics()) {
        json[std::string(metric.name)] = metric.value(difference);
    }
}

Json stillJson(const std::vector<StillError>& errors) {
    Json frames = Json::array();
    for (const StillError& error : errors) {
        Json frame = {{"frame", error.frame}};
        frame.update(errorJson(error.difference));
        addOctaves(frame, error.difference);
        frame["displayed_flip"] = error.displayedFlip;
        frames.push_back(std::move(frame));
    }
    return frames;
}

Json motionJson(const MotionResult& motion) {
    Json octaves = Json::object();
    addOctaves(octaves, {.octaves = motion.octaves});
    return {{"flip", motion.flip},
            {"displayed_flip", motion.displayedFlip},
            {"relative_mse", motion.relativeMse},
            {"octaves", octaves},
            {"flicker", motion.flicker},
            {"truth_flicker", motion.truthFlicker},
            {"rest", motion.rest}};
}

Json runJson(const BenchRun& run, double bandwidth) {
    Json json = {{"scene", run.scene},         {"variant", run.variant},     {"settings", run.settings},
                 {"size", sizeJson(run.size)}, {"triangles", run.triangles}, {"memory_bytes", run.memory}};
    json["truth"] = run.truthFile.empty()
                        ? Json()
                        : Json{{"file", run.truthFile}, {"samples", run.truthSamples}, {"noise", run.truthNoise}};
    json["convergence"] = stillJson(run.still);
    json["motion"] = run.motion ? motionJson(*run.motion) : Json();
    json["first"] = stateJson(run.first, bandwidth);
    json["steady"] = stateJson(run.steady, bandwidth);
    return json;
}

Json ratiosJson(const BenchState& a, const BenchState& b) {
    Json groups = Json::object();
    Json passes = Json::object();
    Json json = Json::object();
    for (const Ratio& ratio : ratiosOf(a.samples, b.samples)) {
        Json one = {{"ratio", spreadJson(spreadOf(ratio.ratios))},
                    {"difference_ms", spreadJson(spreadOf(ratio.differences))}};
        if (ratio.kind == SeriesKind::total) {
            one["ratios"] = ratio.ratios;
            json[ratio.name] = one;
        } else {
            (ratio.kind == SeriesKind::group ? groups : passes)[ratio.name] = one;
        }
    }
    json["groups"] = groups;
    json["passes"] = passes;
    if (a.error && b.error) {
        json["error_ratio"] = {{"relative_mse", a.error->relativeMse / b.error->relativeMse},
                               {"flip", a.error->flip / b.error->flip}};
    }
    return json;
}

Json pairJson(const BenchPair& pair, const std::vector<BenchRun>& runs) {
    const BenchRun& a = runs[pair.a];
    const BenchRun& b = runs[pair.b];
    return {{"scene", a.scene},
            {"size", sizeJson(a.size)},
            {"a", a.variant},
            {"b", b.variant},
            {"first", ratiosJson(a.first, b.first)},
            {"steady", ratiosJson(a.steady, b.steady)}};
}

Json truthJson(const TruthOptions& truth) {
    if (truth.kind == TruthKind::none) {
        return {};
    }
    if (truth.kind == TruthKind::chain) {
        Json chain{{"kind", "chain"}, {"rays", truth.chainRays}};
        if (truth.chainOf) {
            chain["of"] = changedSettings(*truth.chainOf);
        }
        return chain;
    }
    const ReferenceOptions& r = truth.reference;
    return {{"kind", "reference"},
            {"bounces", r.bounces == ReferenceOptions::unlimited ? Json() : Json(r.bounces)},
            {"visible_only", r.visibleOnly},
            {"spp", r.samples}};
}

std::string convergencePlot(const BenchPlan& plan, const BenchResult& result) {
    ScatterPlot plot;
    plot.title = "A still view: error over frames, down to the bias";
    plot.xLabel = "frame";
    plot.yLabel = fmt::format("relative MSE of {}", plan.layer);
    plot.joined = true;
    for (const BenchRun& run : result.runs) {
        std::string series = run.variant;
        if (plan.scenes.size() > 1) {
            series = fmt::format("{}, {}", run.scene, series);
        }
        if (plan.sizes.size() > 1) {
            series += fmt::format(", {}x{}", run.size.x, run.size.y);
        }
        for (const StillError& error : run.still) {
            plot.points.push_back({"", series, double(error.frame), error.difference.relativeMse});
        }
        if (!run.still.empty()) {
            plot.points.back().label = run.variant;
        }
    }
    return scatterPlot(plot);
}

}  // namespace

std::vector<Scaling> scalingOf(const BenchResult& result) {
    std::vector<Scaling> all;
    for (const BenchRun& run : result.runs) {
        auto same = std::ranges::find_if(
            all, [&](const Scaling& s) { return s.scene == run.scene && s.variant == run.variant; });
        if (same == all.end()) {
            same = all.insert(all.end(), {run.scene, run.variant, {}, {}, 0.0});
        }
        const Series* submitted = run.steady.samples.find(SeriesKind::total, "submitted");
        if (submitted != nullptr && std::ranges::find(same->sizes, run.size) == same->sizes.end()) {
            same->sizes.push_back(run.size);
            const double pixels = static_cast<double>(run.size.x) * run.size.y;
            same->nsPerPixel.push_back(spreadOf(submitted->ms).median * 1e6 / pixels);
        }
    }
    std::erase_if(all, [](const Scaling& s) { return s.sizes.size() < 2; });
    for (Scaling& scaling : all) {
        const auto [low, high] = std::ranges::minmax(scaling.nsPerPixel);
        scaling.spread = low > 0.0 ? high / low - 1.0 : 0.0;
    }
    return all;
}

std::string benchJson(const BenchHead& head, const BenchPlan& plan, const BenchResult& result) {
    Json runs = Json::array();
    for (const BenchRun& run : result.runs) {
        runs.push_back(runJson(run, head.bandwidth));
    }
    Json pairs = Json::array();
    for (const BenchPair& pair : result.pairs) {
        pairs.push_back(pairJson(pair, result.runs));
    }
    Json scaling = Json::array();
    for (const Scaling& s : scalingOf(result)) {
        Json sizes = Json::array();
        std::ranges::transform(s.sizes, std::back_inserter(sizes), sizeJson);
        scaling.push_back({{"scene", s.scene},
                           {"variant", s.variant},
                           {"sizes", sizes},
                           {"ns_per_pixel", s.nsPerPixel},
                           {"spread", s.spread}});
    }
    const Json json = {{"reflet", head.version},
                       {"command", head.command},
                       {"device", head.device},
                       {"driver", head.driver},
                       {"bandwidth_bytes_per_s", head.bandwidth},
                       {"first_frames", plan.firstFrames},
                       {"warmup", plan.warmup},
                       {"frames", plan.frames},
                       {"layer", plan.layer},
                       {"truth", truthJson(plan.truth)},
                       {"runs", runs},
                       {"comparisons", pairs},
                       {"scaling", scaling}};
    return jsonText(json, 2) + "\n";
}

std::string benchPlot(const BenchPlan& plan, const BenchResult& result) {
    if (plan.plotsConvergence) {
        return convergencePlot(plan, result);
    }
    ScatterPlot plot;
    plot.title = "Steady state: left is faster, down is closer to the reference";
    plot.xLabel = "milliseconds per frame, from submission to fence";
    plot.yLabel = fmt::format("relative MSE of {}", plan.layer);
    for (const BenchRun& run : result.runs) {
        const Series* submitted = run.steady.samples.find(SeriesKind::total, "submitted");
        if (submitted == nullptr || !run.steady.error) {
            continue;
        }
        std::string series = run.scene;
        if (plan.sizes.size() > 1) {
            series += fmt::format(" {}x{}", run.size.x, run.size.y);
        }
        plot.points.push_back({run.variant, series, spreadOf(submitted->ms).median, run.steady.error->relativeMse});
    }
    return scatterPlot(plot);
}

}  // namespace reflet
