// Metrics of temporal artefacts in a sequence of pictures: ghosting, lag, flicker. Pure functions.
//
// Each frame in motion is compared with the settled picture of the same pose: the result of the same settings if
// nothing moves for many frames. So only artefacts of motion count. Radiance x is compressed to x / (1 + x) per
// channel, so that a few bright pixels do not outweigh all others.
#pragma once

#include "base/image_file.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace reflet {

/// A frame of a sequence. All images have one size.
struct MotionFrame {
    FloatImage picture;  ///< radiance "R" "G" "B" in motion
    FloatImage settled;  ///< the settled picture of its pose
    FloatImage motion;   ///< uv now minus uv in the frame before, "X" "Y"
};

/// x / (1 + x); values below 0 become 0.
FloatImage compressed(const FloatImage& radiance);

/// Ghosting: remaining light of earlier frames, by its age.
struct Ghosts {
    /// [k - 1]: the share of the light of k frames ago that is left; 0: none, 1: all of it, below 0: overshoot.
    /// NaN where fewer than `fewestGhostPixels` pixels have changed that long ago.
    std::vector<double> left;
    std::vector<uint64_t> pixels;  ///< [k - 1]: number of pixels that changed k frames ago, over all frames
};

constexpr uint64_t fewestGhostPixels = 32;

/// frames: frames[0] is at rest; the others follow it in motion. For a pixel p of frame t, the path p_1, p_2, … follows
/// the motion vectors into the past, as a temporal filter does. Its age is the smallest k for which F, the settled
/// picture of frame t - k at p_k, is outside of the range of the settled picture of frame t in the 5x5 pixels around p.
/// The former light is that difference: s = F - clamp(F, low, high), where low and high are the limits of that range.
/// e = M - clamp(M, low, high) is the same for the frame in motion. left[k - 1] is the sum of e s over the sum of s s,
/// over all pixels of age k and their channels.
Ghosts ghostsOf(std::span<const MotionFrame> frames, uint32_t oldest);

/// The share of the step from `before` to `after` that a picture still lacks: the sum of (picture - after) (before -
/// after) over the sum of (before - after)², over pixels where the step is at least a tenth of the mean of `before`.
/// NaN if there are fewer than fewestGhostPixels of these. before, after: settled pictures. Compresses all three.
double stepLeft(const FloatImage& picture, const FloatImage& before, const FloatImage& after);

/// The first frame from which on all `values` are at most `limit`; nullopt if the last one is not.
std::optional<uint32_t> framesUntil(std::span<const double> values, double limit);

struct Flicker {
    double frames = 0.0;   ///< flicker of the frames in motion
    double settled = 0.0;  ///< flicker of the settled pictures, one for each pose
};

/// Mean over frames, pixels and channels of |frame - previous frame reprojected by the motion vectors|, compressed.
Flicker flickerOf(std::span<const MotionFrame> frames);

}  // namespace reflet
