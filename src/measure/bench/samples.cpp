// Collects times of many frames.
#include "measure/bench/samples.h"

#include <algorithm>

namespace reflet {

void Samples::add(double wallMs, const gpu::Frame& frame) {
    const gpu::RecordingCounts& counts = frame.counts();
    add(wallMs, frame.submittedMs(), frame.passTimes(),
        Recording{counts.ms, counts.passes, counts.barriers, frame.transientBytes()});
}

void Samples::add(double wallMs, double submittedMs, std::span<const gpu::PassTime> passes,
                  const std::optional<Recording>& recording) {
    ++frames_;
    recording_ = recording;
    addTime(SeriesKind::total, "wall", {"", wallMs});
    addTime(SeriesKind::total, "submitted", {"", submittedMs});
    if (recording) {
        addTime(SeriesKind::total, "record", {"", recording->ms});
    }
    for (const gpu::PassTime& pass : passes) {
        if (pass.name == "frame") {
            addTime(SeriesKind::total, "frame", pass);
            continue;
        }
        addTime(SeriesKind::pass, pass.name, pass);
        addTime(SeriesKind::group, pass.raster ? "geometry" : "effects", pass);
        if (const size_t point = pass.name.find('.'); point != std::string::npos) {
            addTime(SeriesKind::group, pass.name.substr(0, point), pass);
        }
    }
    for (Series& series : series_) {
        series.ms.resize(frames_, 0.0);
    }
}

void Samples::addTime(SeriesKind kind, const std::string& name, const gpu::PassTime& time) {
    Series& series = at(kind, name);
    if (series.ms.size() < frames_) {  // the first of this frame
        series.ms.resize(frames_, 0.0);
        series.bytes = 0;
        series.raster = time.raster && kind == SeriesKind::pass;
    }
    series.ms.back() += time.ms;
    series.bytes += time.bytes;
}

Series& Samples::at(SeriesKind kind, const std::string& name) {
    const auto known = std::ranges::find_if(series_, [&](const Series& s) { return s.kind == kind && s.name == name; });
    return known != series_.end() ? *known : series_.emplace_back(Series{kind, name, {}, 0, false});
}

const Series* Samples::find(SeriesKind kind, const std::string& name) const {
    const auto known = std::ranges::find_if(series_, [&](const Series& s) { return s.kind == kind && s.name == name; });
    return known != series_.end() ? &*known : nullptr;
}

std::vector<Series> Samples::series() const {
    std::vector<Series> ordered = series_;
    std::ranges::stable_sort(ordered, {}, &Series::kind);
    return ordered;
}

std::vector<Ratio> ratiosOf(const Samples& first, const Samples& second) {
    std::vector<Ratio> all;
    for (const Series& a : first.series()) {
        const Series* b = second.find(a.kind, a.name);
        if (b == nullptr) {
            continue;
        }
        Ratio ratio{a.kind, a.name, {}, {}};
        for (size_t turn = 0; turn < std::min(a.ms.size(), b->ms.size()); ++turn) {
            ratio.differences.push_back(a.ms[turn] - b->ms[turn]);
            if (a.ms[turn] > 0.0 && b->ms[turn] > 0.0) {
                ratio.ratios.push_back(a.ms[turn] / b->ms[turn]);
            }
        }
        all.push_back(std::move(ratio));
    }
    return all;
}

}  // namespace reflet
