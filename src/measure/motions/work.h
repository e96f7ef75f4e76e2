// The plan and the results of `reflet bench --motions`, as plain values; and the measurement.
#pragma once

#include "base/image_file.h"
#include "measure/bench/truth.h"
#include "measure/motions/cases.h"
#include "measure/motions/measures.h"
#include "measure/variants.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

struct MotionsPlan {
    std::vector<MotionCase> cases;
    std::vector<Variant> variants;
    uvec2 size{160, 90};
    uint32_t seed = 0;
    uint32_t settle = 24;  ///< frames at rest before a settled picture, and before the motion
    TruthOptions truth;    ///< not TruthKind::none
    bool strips = false;   ///< whether to keep pictures
};

/// Number of frames that a settled picture averages.
constexpr uint32_t settledFrames = 8;
/// The largest measured age of ghosts, in frames.
constexpr uint32_t oldestGhost = 8;

/// Frames that a strip shows, counted from the event.
constexpr std::array<uint32_t, 2> stripFrames{0, 7};

/// Errors against the reference, one per frame.
struct MotionErrors {
    std::vector<double> flip;  ///< as displayed
    std::vector<double> relativeMse;
};

struct MotionsRun {
    MotionCase motion;
    std::string variant;
    std::string settings;  ///< settings that differ from the defaults, in the form of --set
    MotionErrors moving;
    MotionErrors rest;  ///< errors of frames at rest at the same poses
    Ghosts ghosts;
    Flicker flicker;
    double restFlicker = 0.0;  ///< mean change from frame to frame at rest, compressed
    /// For each frame from the event on. Lag::light: the share of the step that is left; Lag::rest: displayed FLIP over
    /// displayed FLIP at rest. `left`: for the final picture; `indirectLeft`: for indirect diffuse light (Lag::light).
    std::vector<double> left;
    std::vector<double> indirectLeft;
    std::vector<Bitmap> pictures;  ///< pictures of stripFrames, if the plan keeps them
};

struct MotionsResult {
    std::vector<MotionsRun> runs;  ///< case by case, and for each its variants
    /// For each case: references of stripFrames.
    std::vector<std::vector<Bitmap>> truths;
};

/// Mean FLIP in motion over mean FLIP at rest.
double errorRatio(const MotionsRun& run);
/// Flicker in motion over (flicker of the settled pictures + flicker at rest).
double flickerRatio(const MotionsRun& run);
/// Lag in frames after the event; nullopt: not over by the last frame. left: MotionsRun::left or indirectLeft.
std::optional<uint32_t> lagOf(const MotionsRun& run, const std::vector<double>& left);

/// Shows progress. Throws Error.
MotionsResult measureMotions(const MotionsPlan& plan, gpu::Device& device);

}  // namespace reflet
