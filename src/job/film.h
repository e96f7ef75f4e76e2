// Films: outputs with all frames in one file, .webp, .mp4 or .webm. Frames are PNG files in a folder beside the film
// until it is complete, so a film can be resumed and shared like any sequence.
#pragma once

#include "job/sequence_names.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// Whether the name ends in .webp, .mp4 or .webm.
bool isFilm(const std::string& output);

/// The films among a command's outputs.
class Films {
public:
    /// Replaces each film in `outputs` by the name of its frames, "film.webp.frames/frame_######.png", and creates that
    /// folder. Throws UsageError for a format that needs ffmpeg if it is not installed, or that is too small for the
    /// picture's size.
    Films(std::vector<std::string>& outputs, uint32_t width, uint32_t height);
    /// Removes folders that are still empty.
    ~Films();
    Films(const Films&) = delete;
    Films& operator=(const Films&) = delete;

    [[nodiscard]] bool any() const { return !films_.empty(); }
    [[nodiscard]] std::vector<std::string> names() const;
    /// Whether the output is the name of a film's frames.
    [[nodiscard]] bool hasFrames(const std::string& output) const;

    /// Writes films from the frames [first, first + count) and removes the frames' files. If frames of other shares are
    /// missing, prints a note and writes nothing. Throws Error. Returns the names of the films written.
    [[nodiscard]] std::vector<std::string> write(double fps, uint32_t first, uint32_t count) const;

private:
    struct Film {
        std::string file;
        FrameNames frames;
    };

    std::vector<Film> films_;
};

}  // namespace reflet
