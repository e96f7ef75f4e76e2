// Whole files in and out. What is written appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace reflet {

/// The content of a file. Throws Error if it cannot be read.
std::string readFile(const std::filesystem::path& path);

/// Writes a file so that whoever reads `path` sees the old content or the new, never a part. Throws Error, and then
/// the old content is still there.
void writeFileAtomically(const std::filesystem::path& path, std::string_view content);

/// The same for a file that must be new. False if `path` exists, also if another process makes it at this moment.
bool writeNewFile(const std::filesystem::path& path, std::string_view content);

/// For libraries that write to a path themselves: have them write to tempPath(), then commit(). Without commit()
/// nothing happens to the target. A target that is no regular file (/dev/null, a pipe) is written to directly.
class AtomicFile {
public:
    /// Creates the empty temporary file in the target's folder. Throws Error if the target cannot be written.
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    AtomicFile(AtomicFile&&) = delete;
    AtomicFile& operator=(AtomicFile&&) = delete;

    [[nodiscard]] const std::filesystem::path& tempPath() const { return tempPath_; }

    /// Gives the temporary file the target's name. At most once. Throws Error.
    void commit();
    /// The same, but false if the target exists: then nothing happens to it.
    bool commitNew();

private:
    std::filesystem::path name_;      ///< as the caller said it, for messages
    std::filesystem::path target_;    ///< symbolic links resolved
    std::filesystem::path tempPath_;  ///< target_ itself where that is written to directly
    bool pending_ = false;            ///< the temporary file exists
};

}  // namespace reflet
