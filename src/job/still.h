// Renders stills: one finished picture, the best that an effort buys, rather than a frame of a game.
#pragma once

#include "job/sequence.h"

#include <chrono>
#include <string>
#include <string_view>

namespace reflet {

/// Whether the options ask for a still: one picture and nothing that is about single frames; or an effort.
bool isStill(const RenderOptions& options);

/// The preset of a still, if the user names none.
std::string_view stillPreset(const RenderOptions& options);

/// "at most 30 s, or until the noise is 0.004".
std::string stillLimits(const RenderOptions& options);

/// Renders frames of the view until the effort's noise or time is reached, and keeps the last one in job.pictures.
/// The time counts from `start`, with all that was done before the first frame.
void renderStill(const RenderJob& job, std::chrono::steady_clock::time_point start);

}  // namespace reflet
