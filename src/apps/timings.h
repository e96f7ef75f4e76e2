// Device times of passes over several frames.
#pragma once

#include "base/math.h"
#include "gpu/frame.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace reflet {

/// Medians over all frames but the first, in which pipelines are made; over the first where it is the only one.
class Timings {
public:
    /// leaveOutFirst: false: medians over all frames.
    explicit Timings(bool leaveOutFirst = true) : leaveOutFirst_(leaveOutFirst) {}

    /// The times of one more frame: what Frame::passTimes() says, with the whole as "frame".
    void add(const std::vector<gpu::PassTime>& times);

    /// Of the whole frame, milliseconds. After at least one frame.
    [[nodiscard]] double frameMs() const;
    /// All passes in the order in which they ran.
    [[nodiscard]] std::vector<gpu::PassTime> passes() const;

    /// What --timings writes.
    [[nodiscard]] nlohmann::ordered_json json(const std::string& device, uvec2 size) const;

private:
    bool leaveOutFirst_;
    uint32_t frames_ = 0;
    std::map<std::string, std::vector<double>> samples_;
    std::vector<std::string> order_;
};

}  // namespace reflet
