// Renders stills: one converged picture, as good as the chosen effort allows, rather than a real-time frame.
#pragma once

#include "job/sequence.h"

#include <chrono>
#include <string>
#include <string_view>

namespace reflet {

/// Whether the options request a still: one picture and no options about single frames; or an effort.
bool isStill(const RenderOptions& options);

/// The default preset of a still.
std::string_view stillPreset(const RenderOptions& options);

/// "at most 30 s, or until the noise is 0.004".
std::string stillLimits(const RenderOptions& options);

/// Renders frames of the view until the effort's noise or time is reached, and keeps the last one in job.pictures.
/// Time counts from `start`, including all work before the first frame.
void renderStill(const RenderJob& job, std::chrono::steady_clock::time_point start);

}  // namespace reflet
