// Times of many frames, sorted by what they are of.
#pragma once

#include "gpu/frame.h"

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

/// The times of one thing in every frame, milliseconds; 0 in frames that did not have it.
struct Series {
    SeriesKind kind = SeriesKind::pass;
    std::string name;
    std::vector<double> ms;
    uint64_t bytes = 0;   ///< of what its passes bind, in the last frame that had it
    bool raster = false;  ///< a pass that draws triangles
};

/// Groups: "geometry" are all passes that draw triangles, "effects" all others; "diffuse" all passes whose names start
/// with "diffuse.", and so on.
class Samples {
public:
    /// `wallMs`: of the whole frame by the host's clock. Submission to fence, and the device's times, are the frame's.
    void add(double wallMs, const gpu::Frame& frame);
    /// `passes` as Frame::passTimes() has them.
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

/// What two ways of doing the same took, turn by turn.
struct Ratio {
    SeriesKind kind = SeriesKind::total;
    std::string name;
    std::vector<double> ratios;       ///< the first's time over the second's; of turns in which both took any
    std::vector<double> differences;  ///< the first's minus the second's, milliseconds; of all turns
};

/// Of all that both have.
std::vector<Ratio> ratiosOf(const Samples& first, const Samples& second);

}  // namespace reflet
