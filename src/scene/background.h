// What the camera sees where there is no surface. It lights nothing: rays that miss find the environment.
#pragma once

#include "scene/scene.h"

#include <string>

namespace reflet {

/// "environment", "blur", "transparent", the name of a colour, or "R,G,B" with display values of 0 to 1. Throws
/// UsageError that names the choices.
Background parseBackground(const std::string& text);
/// Text that parseBackground turns into the same.
std::string backgroundText(const Background& background);

/// The image convolved with a Gaussian lobe (von Mises-Fisher) of 12 degrees, 1024x512, "R" "G" "B".
FloatImage blurredImage(const FloatImage& image);

/// What camera rays that miss find: black for a colour, which is a display value, and for transparent.
/// blurred: blurredImage of the environment's image; only read where both are needed.
Environment environmentBehind(const View& view, const std::shared_ptr<const FloatImage>& blurred);
/// Whether that takes a blurred image.
bool needsBlurredImage(const View& view);

}  // namespace reflet
