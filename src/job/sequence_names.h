// File names of a sequence: a run of # stands for the frame number.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// "out/picture_####.png": at least as many digits as there are #, filled with zeros.
class FrameNames {
public:
    /// Whether the file name (not its folder) has a #.
    static bool isPattern(const std::string& output);

    /// Throws UsageError for a second run of #.
    explicit FrameNames(const std::string& pattern);

    [[nodiscard]] const std::string& pattern() const { return pattern_; }
    [[nodiscard]] std::filesystem::path file(uint32_t number) const;
    /// Whether a frame could have this file name, without a folder.
    [[nodiscard]] bool matches(std::string_view name) const;
    /// All existing files that match the pattern. Throws Error if the folder cannot be read.
    [[nodiscard]] std::vector<std::filesystem::path> existing() const;
    /// Their numbers, sorted.
    [[nodiscard]] std::vector<uint32_t> numbers() const;
    /// Beside the images: "out/picture_####.png.sequence.json".
    [[nodiscard]] std::filesystem::path record() const { return pattern_ + ".sequence.json"; }

private:
    std::string pattern_;
    std::filesystem::path folder_;
    std::string before_;  ///< file name before the number
    std::string after_;
    size_t digits_ = 0;
};

}  // namespace reflet
