// Finds the name that somebody meant who mistyped it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace reflet {

/// The one of `names` that `name` was most likely meant to be, upper and lower case being the same; the first of
/// several equally near. None where none is near: less than half of the letters wrong, or one is a part of the other.
std::optional<std::string> nearestName(std::string_view name, std::span<const std::string> names);

/// "; did you mean 'x'?" with the nearest name, to end a message with; "" where none is near.
std::string suggestion(std::string_view name, std::span<const std::string> names);

/// "max_steps" of "maxSteps": the C++ member's name as users type it.
std::string snakeCase(std::string_view camelCase);

}  // namespace reflet
