// What the fuzz targets share. Each target is a libFuzzer program that gives the bytes to one reader of files as a user
// would, by a file. A reader may return or throw Error; everything else is a finding.
#pragma once

#include "base/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace reflet::fuzz {

/// A folder of this process, removed at its end.
inline const std::filesystem::path& folder() {
    struct Folder {
        Folder() {
            std::string name = (std::filesystem::temp_directory_path() / "reflet-fuzz-XXXXXX").string();
            if (::mkdtemp(name.data()) == nullptr) {
                std::abort();
            }
            path = name;
        }
        ~Folder() {
            std::error_code ignored;
            std::filesystem::remove_all(path, ignored);
        }
        std::filesystem::path path;
    };
    static const Folder made;
    return made.path;
}

/// A file in that folder with these bytes.
inline std::filesystem::path file(const char* name, const uint8_t* bytes, size_t size) {
    const std::filesystem::path path = folder() / name;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
    return path;
}

/// Errors must be one line of bounded length.
template <class Action>
int survive(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        const std::string text = error.what();
        if (text.find('\n') != std::string::npos || text.size() > 20000) {
            std::abort();
        }
    }
    return 0;
}

}  // namespace reflet::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);
