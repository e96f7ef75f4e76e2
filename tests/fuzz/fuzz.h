// What the fuzz targets share. A target is a function of bytes, which it gives to one reader of files. The reader may
// return or throw Error; everything else is a finding. Each target is a libFuzzer program of its own, and all of them
// are linked into the test programs, which call them with the seeds: see replay.h.
#pragma once

#include "base/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

// Defines the target reflet::fuzz::NAME and, in its libFuzzer program, the entry point.
#ifdef REFLET_LIBFUZZER
#define FUZZ_ENTRY(name)                                                       \
    extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) { \
        return reflet::fuzz::name(bytes, size);                                \
    }
#else
#define FUZZ_ENTRY(name)
#endif
#define FUZZ_TARGET(name)                        \
    namespace reflet::fuzz {                     \
    int name(const uint8_t* bytes, size_t size); \
    }                                            \
    FUZZ_ENTRY(name)                             \
    int reflet::fuzz::name(const uint8_t* bytes, size_t size)

#ifdef REFLET_LIBFUZZER
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);
#endif

namespace reflet::fuzz {

[[noreturn]] inline void finding(const char* what) {
    (void)!::write(STDERR_FILENO, what, std::string_view(what).size());
    (void)!::write(STDERR_FILENO, "\n", 1);
    std::abort();
}

/// A folder of this process, removed at its end: in memory, where the system has such a folder.
inline const std::filesystem::path& folder() {
    struct Folder {
        Folder() {
            std::error_code ignored;
            const std::filesystem::path memory = "/dev/shm";
            const bool hasMemory =
                std::filesystem::is_directory(memory, ignored) && ::access(memory.c_str(), W_OK) == 0;
            std::string name =
                ((hasMemory ? memory : std::filesystem::temp_directory_path()) / "reflet-fuzz-XXXXXX").string();
            if (::mkdtemp(name.data()) == nullptr) {
                finding("no folder for files");
            }
            path = name;
        }
        ~Folder() {
            std::error_code ignored;
            std::filesystem::remove_all(path, ignored);
        }
        Folder(const Folder&) = delete;
        Folder& operator=(const Folder&) = delete;
        Folder(Folder&&) = delete;
        Folder& operator=(Folder&&) = delete;

        std::filesystem::path path;
    };
    static const Folder made;
    return made.path;
}

/// Writes these bytes to the file. By system calls: a stream takes longer than most readers.
inline void writeBytes(const std::filesystem::path& path, const void* bytes, size_t size) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0 || ::write(file, bytes, size) != static_cast<ssize_t>(size) || ::close(file) != 0) {
        finding("no room for files");
    }
}

/// A file of `folder` with these bytes.
inline std::filesystem::path file(const char* name, const void* bytes, size_t size) {
    std::filesystem::path path = folder() / name;
    writeBytes(path, bytes, size);
    return path;
}

/// 32 bits, little-endian.
inline void appendWord(std::string& to, size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
        to.push_back(static_cast<char>(value >> shift & 0xFFU));
    }
}

/// Calls a reader. Errors must be one line of bounded length. Returns 0, as libFuzzer wants.
template <class Action>
int survive(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        const std::string text = error.what();
        if (text.find('\n') != std::string::npos || text.size() > 20000) {
            finding("an error that is not one line of bounded length");
        }
    }
    return 0;
}

}  // namespace reflet::fuzz
