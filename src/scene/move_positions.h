// Positions in view files and camera paths, between the file's coordinates and the world's.
#pragma once

#include "base/math.h"

#include <initializer_list>

namespace reflet {

/// Adds `by` to all positions of a parsed view file or camera path, in double. What is no number stays as it is.
template <class Json>
void movePositions(Json& file, const glm::dvec3& by) {
    const auto move = [&](Json& part, std::initializer_list<const char*> keys) {
        for (const char* key : keys) {
            if (!part.is_object() || !part.contains(key) || !part[key].is_array()) {
                continue;
            }
            for (size_t i = 0; i < 3 && i < part[key].size(); ++i) {
                Json& number = part[key][i];
                number = number.is_number() ? Json(number.template get<double>() + by[static_cast<int>(i)]) : number;
            }
        }
    };
    for (auto& [key, value] : file.items()) {
        if (key == "camera") {
            move(value, {"position", "target", "focus"});
        }
        if (key == "keyframes" || key == "probes") {
            for (auto& part : value) {
                move(part, {"position", "target", "focus", "box_min", "box_max"});
            }
        }
    }
}

}  // namespace reflet
