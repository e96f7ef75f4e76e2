// Measures frames while the camera and objects move: error against a reference per frame, flicker beyond that of the
// reference, and how fast reflections converge when everything stops.
#pragma once

#include "compare/octaves.h"
#include "measure/bench/subject.h"
#include "measure/bench/truth.h"

#include <cstdint>
#include <vector>

namespace reflet {

struct MotionPlan {
    uint32_t frames = 0;    ///< 0: not measured
    float degrees = 30.0F;  ///< angle that the camera orbits around its target over all frames
    uint32_t warmup = 11;   ///< frames at rest before the motion
    float fps = 24.0F;      ///< frames per second of the scene's animations
    uint32_t rest = 0;      ///< frames at rest after the motion, compared with the final value
};

struct MotionResult {
    std::vector<double> flip;           ///< FLIP of every frame against its own reference, mean over the image
    std::vector<double> displayedFlip;  ///< the same by displayedFlip()
    std::vector<double> relativeMse;    ///< relative MSE of every frame
    OctaveErrors octaves{};             ///< parts of relativeMse, mean over frames
    /// Mean over pixels and channels of |frame - previous frame reprojected by the motion vectors|, mean over frames.
    double flicker = 0.0;
    double truthFlicker = 0.0;  ///< the same for the references
    /// For the reflections of every frame at rest: mean |frame - final value| / mean final value, over the pixels that
    /// the motion has changed. 0: no pixels changed.
    std::vector<double> rest;
};

/// The view of a frame of the motion; frame 0 has the scene's own view.
View viewInMotion(const View& view, const MotionPlan& plan, uint32_t frame);

/// Mean over pixels and channels of |now(uv) - before(uv - motion)|, over pixels that were inside the image before.
/// motion: uv now minus uv before, "X" and "Y".
double changeBeyondMotion(const FloatImage& now, const FloatImage& before, const FloatImage& motion);

/// One value of MotionResult::rest. before: the image before the motion; pixels that differ from it by more than a
/// tenth of the mean count as changed.
double changeAtRest(const FloatImage& frame, const FloatImage& final, const FloatImage& before);

/// Renders or loads a reference for every frame. Shows progress. Throws Error.
MotionResult measureMotion(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings,
                           const TruthOptions& truth, const MotionPlan& plan);

}  // namespace reflet
