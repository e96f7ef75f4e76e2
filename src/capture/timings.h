// Collects device times of passes over several frames.
#pragma once

#include "base/math.h"
#include "device/frame.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace reflet {

/// Medians over all frames but the first, which creates the pipelines; a single frame is used nevertheless.
class Timings {
public:
    /// leaveOutFirst: false includes the first frame.
    explicit Timings(bool leaveOutFirst = true) : leaveOutFirst_(leaveOutFirst) {}

    /// Adds one frame: the result of Frame::passTimes(), with the whole frame as "frame".
    void add(const std::vector<gpu::PassTime>& times);

    /// Median of the whole frame, milliseconds. Needs at least one frame.
    [[nodiscard]] double frameMs() const;
    /// Medians of all passes, in the order in which they ran.
    [[nodiscard]] std::vector<gpu::PassTime> passes() const;

    /// The content of the --timings file.
    [[nodiscard]] nlohmann::ordered_json json(const std::string& device, uvec2 size) const;

private:
    bool leaveOutFirst_;
    uint32_t frames_ = 0;
    std::map<std::string, std::vector<double>> samples_;
    std::vector<std::string> order_;
};

}  // namespace reflet
