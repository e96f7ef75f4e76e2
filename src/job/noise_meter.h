// Estimates the noise that is left in a picture which frames at rest converge to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace reflet {

/// The noise of a picture, by that of half its frames: where a mean of n frames has the variance s²/n, its difference
/// from that of the first half has the same.
class NoiseMeter {
public:
    /// Whether it takes the frame of this number, counted from 0: the 8th, 16th, 32nd ...
    [[nodiscard]] bool wants(uint32_t frame) const { return frame + 1 >= next_; }

    /// display: 8-bit values.
    void add(uint32_t frame, std::span<const std::byte> display);

    /// Root mean square of display values, 0 to 1; 0: not known yet.
    [[nodiscard]] double noise() const { return noise_; }

private:
    static constexpr uint32_t firstCheck = 8;  // frames: before, histories are too short to tell

    std::vector<std::byte> last_;
    double noise_ = 0.0;
    uint32_t next_ = firstCheck;
};

}  // namespace reflet
