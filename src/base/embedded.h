// Text files that are part of the program: cmake/embed.cmake makes a function that returns them.
#pragma once

#include <span>
#include <string_view>

namespace reflet {

struct EmbeddedFile {
    std::string_view name;  ///< "quality.json"
    std::string_view text;
};

}  // namespace reflet
