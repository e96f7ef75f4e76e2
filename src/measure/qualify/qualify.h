// Qualifies a device: built-in scenes against stored pictures, times, memory, a stability run. For the first run on an
// untested device.
#pragma once

#include "base/document.h"
#include "base/math.h"
#include "device/device.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// A downsampled picture: mean radiance luminance of each cell, rows from the top.
using LuminanceGrid = std::vector<float>;
inline constexpr uvec2 gridSize{16, 9};
/// Size in pixels of the pictures that grids are computed from.
inline constexpr uvec2 qualifySize{160, 90};
inline constexpr uint32_t qualifyFrames = 8;

/// Difference of a grid from the stored one; relative to the stored cell, or to a tenth of the picture's mean where the
/// cell is darker than that.
struct GridDifference {
    double mean = 0.0;
    double worst = 0.0;
};

/// Tolerated difference. Rounding changes the paths of single rays, so that cells differ by noise.
inline constexpr GridDifference gridTolerance{0.02, 0.25};

struct QualifyPlan {
    std::vector<std::string> scenes;   ///< names of built-in scenes
    std::vector<std::string> presets;  ///< "fast"
    uvec2 timedSize{0};                ///< pixels of timed frames
    uint32_t timedFrames = 10;
    double seconds = 60.0;    ///< duration of the stability run
    bool references = false;  ///< path trace reference grids, to be stored
};

struct QualifiedPicture {
    std::string scene;
    std::string preset;
    LuminanceGrid grid;
    bool finite = true;
    std::optional<GridDifference> difference;  ///< none: no picture is stored
    std::optional<double> error;               ///< mean difference from the path-traced picture; none: none is stored
    std::optional<double> storedError;         ///< `error` of llvmpipe's stored picture
    [[nodiscard]] bool passes() const;
};

struct QualifiedTimes {
    std::string preset;
    uint64_t memory = 0;                   ///< bytes of device memory
    double frameMs = 0.0;                  ///< median, first to last pass
    std::map<std::string, double> passMs;  ///< medians
};

struct Stability {
    double seconds = 0.0;
    uint64_t frames = 0;
    uint64_t rounds = 0;       ///< restarts
    uint64_t differing = 0;    ///< rounds whose picture differs from the first round's, byte by byte
    uint64_t memoryBegin = 0;  ///< bytes of device memory after the first round
    uint64_t memoryEnd = 0;
    [[nodiscard]] bool passes() const { return differing == 0 && memoryEnd <= memoryBegin; }
};

struct Qualification {
    std::string version;
    gpu::DeviceDescription device;
    bool validated = false;             ///< the validation layer was active
    std::vector<std::string> messages;  ///< its messages
    std::vector<QualifiedPicture> pictures;
    std::map<std::string, LuminanceGrid> references;  ///< by scene, with QualifyPlan.references
    uvec2 timedSize{0};
    std::string timedScene;
    std::vector<QualifiedTimes> times;
    Stability stability;
    [[nodiscard]] bool passes() const;
};

/// Grids built into the program. Keys: "scene preset" (rendered by llvmpipe) and "scene reference" (path traced).
std::map<std::string, LuminanceGrid> storedGrids();
std::string gridsText(const Qualification& q);

GridDifference differenceOf(const LuminanceGrid& grid, const LuminanceGrid& stored);

/// Each adds its part to `to`. Show progress. Throw Error.
void qualifyPictures(const QualifyPlan& plan, gpu::Device& device, Qualification& to);
void qualifyTimes(const QualifyPlan& plan, gpu::Device& device, Qualification& to);
void qualifyStability(const QualifyPlan& plan, gpu::Device& device, Qualification& to);

/// The keys are described in docs/devices.md.
std::string qualificationJson(const Qualification& q);
std::vector<Section> qualificationDocument(const Qualification& q);

}  // namespace reflet
