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
    uint32_t settle = 24;  ///< frames at rest before a picture is settled, and before the motion
    TruthOptions truth;    ///< not TruthKind::none
    bool strips = false;   ///< whether to keep pictures
};

/// Frames whose mean is a settled picture.
constexpr uint32_t settledFrames = 8;
/// The oldest age of ghosts that is measured.
constexpr uint32_t oldestGhost = 8;

/// Frames after the event that a strip shows.
constexpr std::array<uint32_t, 2> stripFrames{0, 7};

/// Errors against the reference, one of each frame.
struct MotionErrors {
    std::vector<double> flip;  ///< as displayed
    std::vector<double> relativeMse;
};

struct MotionsRun {
    MotionCase motion;
    std::string variant;
    std::string settings;  ///< those that differ from the defaults, in the form of --set
    MotionErrors moving;
    MotionErrors rest;  ///< of a frame at rest at the same pose
    Ghosts ghosts;
    Flicker flicker;
    double restFlicker = 0.0;  ///< mean change from frame to frame at rest, compressed
    /// For Lag::light: the share of the step that is left in each frame from the event on; for Lag::rest: the
    /// displayed FLIP over that at rest. Of the final picture and, for Lag::light, of indirect diffuse light.
    std::vector<double> left;
    std::vector<double> indirectLeft;
    std::vector<Bitmap> pictures;  ///< of stripFrames, if the plan keeps them
};

struct MotionsResult {
    std::vector<MotionsRun> runs;  ///< case by case, and for each its variants
    /// For each case: references of stripFrames.
    std::vector<std::vector<Bitmap>> truths;
};

/// Mean FLIP in motion over mean FLIP at rest.
double errorRatio(const MotionsRun& run);
/// Change in motion over change of the settled pictures plus change at rest.
double flickerRatio(const MotionsRun& run);
/// Frames after the event; nullopt: it has not arrived in the last frame. `left` is MotionsRun::left or indirectLeft.
std::optional<uint32_t> lagOf(const MotionsRun& run, const std::vector<double>& left);

/// Shows progress. Throws Error.
MotionsResult measureMotions(const MotionsPlan& plan, gpu::Device& device);

}  // namespace reflet
