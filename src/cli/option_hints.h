// Options of other programs, for people who type them from habit.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace reflet {

/// What to type instead of an option that a command does not have: "; use --orbit AZ,EL[,DISTANCE]", or "" for what is
/// not known. option: "--camera-orbit", also with a value, "--fov=30". has: whether the command has an option; only
/// such ones are named.
std::string optionHint(std::string_view option, const std::function<bool(const std::string& name)>& has);

/// The same for the ending of an output's name, ".jpg".
std::string endingHint(std::string_view ending);

}  // namespace reflet
