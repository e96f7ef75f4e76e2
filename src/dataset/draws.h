// Random numbers of data sets, equal on all machines, and the distributions that users name.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// A sequence of random numbers. (G. L. Steele, D. Lea, C. H. Flood, Fast Splittable Pseudorandom Number Generators,
/// OOPSLA 2014: SplitMix64)
class Draws {
public:
    /// Independent sequences for each seed and stream.
    Draws(uint64_t seed, uint64_t stream);

    uint64_t bits();
    double unit();  ///< [0, 1)
    double between(double low, double high) { return low + (high - low) * unit(); }
    uint32_t below(uint32_t count) { return static_cast<uint32_t>(bits() % count); }
    double normal();  ///< mean 0, deviation 1, at most 3 from the mean
    vec3 direction();

private:
    uint64_t state_;
};

/// A number that is drawn for each random camera.
struct Distribution {
    enum class Kind : uint8_t { none, uniform, normal, lens };

    Kind kind = Kind::none;
    double low = 0.0;   ///< normal: the mean
    double high = 0.0;  ///< normal: the deviation

    [[nodiscard]] double draw(Draws& draws) const;
};

struct NamedDistribution {
    std::string_view name;
    std::string_view meaning;
    Distribution distribution;
};

/// Metres above the floor.
std::vector<NamedDistribution> heightDistributions();
/// Vertical, degrees.
std::vector<NamedDistribution> fovDistributions();

/// A name, or "A..B": uniform from A to B within [least, most]. Throws UsageError that begins with `option`.
Distribution parseDistribution(std::string_view option, const std::string& text,
                               const std::vector<NamedDistribution>& named, double least, double most);

/// "eye: normal, mean 1.6 m ...", for help.
std::string listed(const std::vector<NamedDistribution>& named);

}  // namespace reflet
