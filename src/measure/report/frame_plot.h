// Draws values over the frames of a sequence as SVG: a panel for each curve.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

struct FrameCurve {
    std::string name;
    std::string unit;                   ///< empty: none
    std::vector<double> values = {};    ///< one per frame; a value that is not finite leaves a gap
    std::optional<size_t> marked = {};  ///< index of the frame to point out
};

struct FramePlot {
    std::string title;
    std::vector<uint32_t> frames;  ///< numbers, ascending
    std::vector<FrameCurve> curves;
};

/// An <svg> element, for a separate file or inside HTML. Text and lines use the page's colour (currentColor). All axes
/// are linear; a panel's vertical one contains 0 unless all its values lie close together.
std::string framePlot(const FramePlot& plot);

}  // namespace reflet
