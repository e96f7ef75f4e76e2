// Text files embedded in the program: cmake/embed.cmake generates a function that returns them.
#pragma once

#include <span>
#include <string_view>

namespace reflet {

struct EmbeddedFile {
    std::string_view name;  ///< "quality.json"
    std::string_view text;
};

}  // namespace reflet
