// Options of rendered and path-traced sequences.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

/// For outputs whose name has a run of #.
struct SequenceOptions {
    uint32_t firstFrame = 0;  ///< the number in the first file's name
    double fps = 24.0;
    std::string path;       ///< camera path: "orbit", or a JSON file
    uint32_t segment = 48;  ///< frames per segment; 0: all
    uint32_t warmUp = 16;   ///< frames rendered before each segment
    std::string share;      ///< as in parseShare
    bool overwrite = false;
};

/// Whether the outputs are sequences. Throws UsageError if only some are, or for options that exclude each other.
bool isSequence(const std::vector<std::string>& outputs, const SequenceOptions& options, uint32_t frames);

}  // namespace reflet
