// Estimates the remaining noise of a picture that converges over frames at rest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace reflet {

/// Estimates noise from the mean of half the frames: if a mean of n frames has the variance s²/n, its difference from
/// the mean of the first half has the same variance.
class NoiseMeter {
public:
    /// Whether add() is needed for the frame of this number, counted from 0: the 8th, 16th, 32nd ...
    [[nodiscard]] bool wants(uint32_t frame) const { return frame + 1 >= next_; }

    /// display: 8-bit values.
    void add(uint32_t frame, std::span<const std::byte> display);

    /// Root mean square noise of display values, 0 to 1; 0: not known yet.
    [[nodiscard]] double noise() const { return noise_; }

private:
    static constexpr uint32_t firstCheck = 8;  // frames: before that, histories are too short for an estimate

    std::vector<std::byte> last_;
    double noise_ = 0.0;
    uint32_t next_ = firstCheck;
};

}  // namespace reflet
