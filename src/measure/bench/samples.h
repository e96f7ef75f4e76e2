// Collects times of many frames, by pass and group of passes.
#pragma once

#include "device/frame.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace reflet {

enum class SeriesKind : uint8_t {
    total,  ///< "wall", "submitted", "record", "frame"
    group,  ///< passes that belong together
    pass,
};

/// The times of a pass or group in every frame, milliseconds; 0 in frames without it.
struct Series {
    SeriesKind kind = SeriesKind::pass;
    std::string name;
    std::vector<double> ms;
    uint64_t bytes = 0;   ///< bytes bound by its passes, in the last frame that had it
    bool raster = false;  ///< a pass that draws triangles
};

/// Host-side statistics of a frame.
struct Recording {
    double ms = 0.0;      ///< host time to list and record its passes
    uint32_t passes = 0;  ///< including copies and clears
    uint32_t barriers = 0;
    uint64_t transientBytes = 0;  ///< bytes of the memory that transient images and buffers share
};

/// Groups: "geometry" has all passes that draw triangles, "effects" all others; "diffuse" has all passes whose names
/// start with "diffuse.", and so on.
class Samples {
public:
    /// wallMs: time of the whole frame by the host's clock. Submission to fence, and device times, come from `frame`.
    void add(double wallMs, const gpu::Frame& frame);
    /// passes: as from Frame::passTimes(). recording: none if unknown, as for programs that do not report it.
    void add(double wallMs, double submittedMs, std::span<const gpu::PassTime> passes,
             const std::optional<Recording>& recording = {});

    [[nodiscard]] size_t frames() const { return frames_; }
    /// Statistics of the last frame.
    [[nodiscard]] const std::optional<Recording>& recording() const { return recording_; }
    /// Totals, groups, then passes in the order in which they first ran.
    [[nodiscard]] std::vector<Series> series() const;
    /// nullptr: no frame had it.
    [[nodiscard]] const Series* find(SeriesKind kind, const std::string& name) const;

private:
    Series& at(SeriesKind kind, const std::string& name);
    void addTime(SeriesKind kind, const std::string& name, const gpu::PassTime& time);

    size_t frames_ = 0;
    std::optional<Recording> recording_;
    std::vector<Series> series_;
};

/// Comparison of two alternatives that were measured alternately.
struct Ratio {
    SeriesKind kind = SeriesKind::total;
    std::string name;
    std::vector<double> ratios;       ///< first time / second time; for turns in which both are above 0
    std::vector<double> differences;  ///< first time - second time, milliseconds; for all turns
};

/// Ratios for every pass and group that both have.
std::vector<Ratio> ratiosOf(const Samples& first, const Samples& second);

}  // namespace reflet
