// The parts of `reflet compare` that images and sequences share.
#pragma once

#include "compare/compare.h"
#include "compare/picture_input.h"

#include <array>
#include <string>
#include <vector>

namespace reflet {

struct CompareCommand {
    std::string picture;
    std::string truth;
    std::string mask;
    std::string heatMap;
    std::string plot;
    std::vector<std::string> failAbove;
    float pixelsPerDegree = CompareOptions().pixelsPerDegree;
    bool json = false;
    bool paths = false;
};

using PicturePair = std::array<PictureName, 2>;  ///< the image, the reference

/// METRIC=X of --fail-above.
struct Limit {
    Metric metric;
    double value = 0.0;

    [[nodiscard]] bool isBroken(const Difference& difference) const;
};

/// What is measured: metrics(), then octaveMetrics().
std::vector<Metric> comparedMetrics();

/// "31.2 dB"
std::string valueText(const Metric& metric, double value);

/// Reads two images and compares them, with the command's mask. Throws Error.
Comparison comparePair(const CompareCommand& command, const PicturePair& names);

/// The command's mask for this image; empty without one. Throws Error.
std::vector<bool> loadMask(const std::string& mask, const PicturePair& names, const FloatImage& picture);

/// Prints where in the light's paths the difference is: by layer, as text or JSON. Throws Error, also for a file that
/// lacks one.
void comparePaths(const CompareCommand& command, const PicturePair& names);

/// Compares every frame of a sequence, prints a table or JSON, writes heat maps and the plot. names: the first with a
/// run of #. Throws Error, also if a frame of the reference is missing in the other sequence or a limit is broken.
void compareSequences(const CompareCommand& command, const PicturePair& names, const std::vector<Limit>& limits);

}  // namespace reflet
