// Collects times of many frames, by pass and group of passes.
#pragma once

#include "device/frame.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace reflet {

enum class SeriesKind : uint8_t {
    total,  ///< "wall", "submitted", "frame"
    group,  ///< passes that belong together
    pass,
};

/// The times of a pass or group in every frame, milliseconds; 0 in frames without it.
struct Series {
    SeriesKind kind = SeriesKind::pass;
    std::string name;
    std::vector<double> ms;
    uint64_t bytes = 0;   ///< bound by its passes, in the last frame that had it
    bool raster = false;  ///< a pass that draws triangles
};

/// Groups: "geometry" has all passes that draw triangles, "effects" all others; "diffuse" has all passes whose names
/// start with "diffuse.", and so on.
class Samples {
public:
    /// `wallMs`: of the whole frame by the host's clock. Submission to fence, and the device times, come from `frame`.
    void add(double wallMs, const gpu::Frame& frame);
    /// `passes` as from Frame::passTimes().
    void add(double wallMs, double submittedMs, std::span<const gpu::PassTime> passes);

    [[nodiscard]] size_t frames() const { return frames_; }
    /// Totals, groups, then passes in the order in which they first ran.
    [[nodiscard]] std::vector<Series> series() const;
    /// nullptr: no frame had it.
    [[nodiscard]] const Series* find(SeriesKind kind, const std::string& name) const;

private:
    Series& at(SeriesKind kind, const std::string& name);
    void addTime(SeriesKind kind, const std::string& name, const gpu::PassTime& time);

    size_t frames_ = 0;
    std::vector<Series> series_;
};

/// Comparison of two alternatives that were measured alternately.
struct Ratio {
    SeriesKind kind = SeriesKind::total;
    std::string name;
    std::vector<double> ratios;       ///< first time / second time; for turns in which both are above 0
    std::vector<double> differences;  ///< first time - second time, milliseconds; for all turns
};

/// For every pass and group that both have.
std::vector<Ratio> ratiosOf(const Samples& first, const Samples& second);

}  // namespace reflet
