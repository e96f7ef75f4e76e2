// Reads and writes whole files. Writing is atomic.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace reflet {

/// The content of a file. Throws Error if it cannot be read, has more than `maxBytes` bytes, or is no regular file:
/// reading a pipe or a device might never end.
std::string readFile(const std::filesystem::path& path, uint64_t maxBytes = uint64_t{1} << 40U);

/// Whether a written file must survive a loss of power: the disk is waited for.
enum class Lasting : uint8_t { no, yes };

/// Writes a file atomically: readers of `path` see the old content or the new, never a part. Throws Error and leaves
/// the old content on failure.
void writeFileAtomically(const std::filesystem::path& path, std::string_view content, Lasting lasting = Lasting::yes);

/// The same for a file that must not exist yet. Returns false if `path` exists, even if another process creates it
/// concurrently.
bool writeNewFile(const std::filesystem::path& path, std::string_view content);

/// Removes the temporary files of writes in progress (not all file systems need them), for a program that exits
/// immediately. May be called by a signal handler.
void removeTemporaryFiles() noexcept;

/// Ends the process at once, without destructors: for where a thread cannot be waited for. Files that threads are
/// writing are whole or unchanged, and no temporary files are left.
[[noreturn]] void exitNow(int status) noexcept;

/// Writes a file atomically: it gets its name when complete. Without commit() the target is unchanged. A target that is
/// no regular file (/dev/null, a pipe) is written directly.
class AtomicFile {
public:
    /// atOnce: a temporary name, as on file systems where all files have one.
    enum class Naming : uint8_t { whenWhole, atOnce };

    /// Throws Error if the target cannot be written.
    explicit AtomicFile(const std::filesystem::path& target, Naming naming = Naming::whenWhole);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    AtomicFile(AtomicFile&&) = delete;
    AtomicFile& operator=(AtomicFile&&) = delete;

    /// Adds to the content. Throws Error.
    void write(std::string_view content);
    /// Gives the file the target's name. Call at most once. Throws Error.
    void commit(Lasting lasting = Lasting::yes);
    /// The same, but returns false and changes nothing if the target exists.
    bool commitNew();

private:
    void openNamed();
    void forgetTemporary() noexcept;
    void flush() const;
    [[nodiscard]] bool linkTo(const std::filesystem::path& path) const;

    std::filesystem::path name_;      ///< as the caller gave it, for messages
    std::filesystem::path target_;    ///< symbolic links resolved
    std::filesystem::path tempPath_;  ///< empty: it has no name
    bool direct_ = false;             ///< not a regular file
    int descriptor_ = -1;
    size_t listed_ = 0;  ///< of the temporary file in the list of removeTemporaryFiles
};

}  // namespace reflet
