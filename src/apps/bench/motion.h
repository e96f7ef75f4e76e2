// How near to the truth frames are while the camera and things move, how much they flicker beyond what the truth itself
// changes, and how soon reflections come to rest when all stops.
#pragma once

#include "apps/bench/subject.h"
#include "apps/bench/truth.h"

#include <cstdint>
#include <vector>

namespace reflet {

struct MotionPlan {
    uint32_t frames = 0;    ///< 0: nothing is measured
    float degrees = 30.0F;  ///< that the camera turns round what it looks at, over all of them
    uint32_t warmup = 11;   ///< frames at rest before
    float fps = 24.0F;      ///< frames a second of the scene's animations
    uint32_t rest = 0;      ///< frames after, in which all stands still, that are held against the final value
};

struct MotionResult {
    std::vector<double> flip;           ///< of every frame to its own truth, mean over the picture
    std::vector<double> displayedFlip;  ///< the same as displayedFlip() has it
    /// Mean over pixels and channels of |frame - the last one where the motion says that it was|, mean over frames.
    double flicker = 0.0;
    double truthFlicker = 0.0;  ///< the same of the truths
    /// Of every frame at rest, of the reflections: mean |frame - final value| over the mean of the final value, of
    /// pixels that the motion has changed. 0: it has changed none.
    std::vector<double> rest;
};

/// The view that a frame of the motion has; 0 is the scene's own.
View viewInMotion(const View& view, const MotionPlan& plan, uint32_t frame);

/// Mean over pixels and channels of |now - before at uv - motion|, of pixels that were inside of the picture before.
/// motion: uv now minus uv before, "X" and "Y".
double changeBeyondMotion(const FloatImage& now, const FloatImage& before, const FloatImage& motion);

/// As of MotionResult::rest. before: what was shown before the motion; what differs by more than a tenth of the mean
/// counts as changed.
double changeAtRest(const FloatImage& frame, const FloatImage& final, const FloatImage& before);

/// A truth is made, or found, for every frame. Shows progress. Throws Error.
MotionResult measureMotion(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings,
                           const TruthOptions& truth, const MotionPlan& plan);

}  // namespace reflet
