// One process's share of work that is divided among several.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace reflet {

/// One of `count` equal shares, counted from 0.
struct Share {
    uint32_t index = 0;
    uint32_t count = 1;
};

/// The value of an environment variable; nullptr if there is none.
using EnvironmentVariable = std::function<const char*(const char* name)>;

/// "3/16" is the third of sixteen; "" is all. "auto" takes index and count from the environment of a Slurm job array,
/// of a Slurm step with several tasks, or of both. "auto/16" takes only the index, also from a PBS job array or GNU
/// parallel, which do not provide the count. Throws UsageError, also for an environment without an array, with two
/// arrays, or with one whose indices are not a contiguous range.
Share parseShare(const std::string& text);
Share parseShare(const std::string& text, const EnvironmentVariable& environment);

}  // namespace reflet
