// Formats the results of a bench: for other programs (JSON), for readers (tables) and as a plot.
#pragma once

#include "base/document.h"
#include "measure/bench/work.h"

#include <string>
#include <vector>

namespace reflet {

/// Facts about the run as a whole.
struct BenchHead {
    std::string version;
    std::string command;  ///< as typed
    std::string device;
    std::string driver;
    double bandwidth = 0.0;  ///< bytes per second; 0: not measured
};

/// The keys are described in docs/bench.md.
std::string benchJson(const BenchHead& head, const BenchPlan& plan, const BenchResult& result);

/// Tables: frames; comparisons; cost per pixel, if there are several sizes; error over frames and by octave; passes.
std::vector<Section> benchDocument(const BenchHead& head, const BenchPlan& plan, const BenchResult& result);

/// An SVG: relative MSE against milliseconds from submission to fence, steady state; a series for each scene and size.
/// With BenchPlan::plotsConvergence: relative MSE over frames of a still view, a line for each run.
std::string benchPlot(const BenchPlan& plan, const BenchResult& result);

/// Times per pixel of one scene and variant at several sizes.
struct Scaling {
    std::string scene;
    std::string variant;
    std::vector<uvec2> sizes;
    std::vector<double> nsPerPixel;  ///< medians, submission to fence, steady state
    double spread = 0.0;             ///< largest over smallest, minus 1
};
std::vector<Scaling> scalingOf(const BenchResult& result);

}  // namespace reflet
