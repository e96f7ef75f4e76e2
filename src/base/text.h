// Suggests the name that a mistyped one was meant to be.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace reflet {

/// The name in `names` that `name` most likely stands for, case-insensitive; the first if several are equally near.
/// None if none is near: less than half of the letters wrong, or one is part of the other.
std::optional<std::string> nearestName(std::string_view name, std::span<const std::string> names);

/// "; did you mean 'x'?" with the nearest name, as the end of a message; "" if none is near.
std::string suggestion(std::string_view name, std::span<const std::string> names);

/// "max_steps" from "maxSteps": a C++ member's name as users type it.
std::string snakeCase(std::string_view camelCase);

}  // namespace reflet
