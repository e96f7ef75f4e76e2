// Reads and writes whole files. What is written has no name, or a temporary one in the same folder, until it is whole;
// linking and renaming are atomic on POSIX.
#include "base/file.h"

#include "base/error.h"
#include "base/visible_text.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <random>
#include <string>
#include <system_error>
#include <utility>

namespace reflet {
namespace fs = std::filesystem;
namespace {

std::string reason(int errorNumber) {
    return std::generic_category().message(errorNumber);
}

/// A file descriptor that closes itself.
class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor(Descriptor&&) = delete;
    Descriptor& operator=(Descriptor&&) = delete;

    [[nodiscard]] int get() const { return value_; }
    [[nodiscard]] bool valid() const { return value_ >= 0; }

    /// False with errno set if the last of the content could not be written.
    bool close() {
        const int value = std::exchange(value_, -1);
        return value < 0 || ::close(value) == 0;
    }

private:
    int value_;
};

// A name from a file may be megabytes.
std::string shown(const fs::path& path) {
    constexpr size_t most = 1000;
    return oneLine(path.native(), most);
}

[[noreturn]] void failWrite(const fs::path& path, int errorNumber) {
    std::string advice;
    const fs::path folder = path.parent_path();
    std::error_code ignored;
    if (errorNumber == ENOENT && !folder.empty() && !fs::exists(folder, ignored)) {
        advice = fmt::format(": create the folder '{}' first", shown(folder));
    }
    fail("{}: cannot be written: {}{}", shown(path), reason(errorNumber), advice);
}

/// A name in the same folder that is unique across processes and threads, also of several machines that share the
/// folder, where process ids are not unique: hence a random number for each process. Without the target's name, which
/// may be as long as a file system allows.
fs::path temporaryName(const fs::path& target) {
    static const unsigned process = std::random_device()();
    static std::atomic<unsigned> counter = 0;
    // As text: fs::path::replace_filename of libstdc++ 12 frees what it does not own if memory runs out in it.
    const std::string& whole = target.native();
    const std::string folder = whole.substr(0, whole.rfind('/') + 1);
    return folder + fmt::format(".reflet-{}-{:08x}-{}.tmp", ::getpid(), process, counter++);
}

/// Names of temporary files, for a signal handler: no locks, and no memory taken while one looks.
class TemporaryList {
public:
    static constexpr size_t none = 64;

    size_t add(const fs::path& path) noexcept {
        char* name = ::strdup(path.c_str());
        for (size_t i = 0; name != nullptr && i < names_.size(); ++i) {
            char* empty = nullptr;
            if (names_.at(i).compare_exchange_strong(empty, name)) {
                return i;
            }
        }
        std::free(name);  // NOLINT(cppcoreguidelines-no-malloc): of strdup
        return none;
    }

    void forget(size_t index) noexcept {
        if (index < none) {
            std::free(names_.at(index).exchange(nullptr));  // NOLINT(cppcoreguidelines-no-malloc): of strdup
        }
    }

    void removeAll() const noexcept {
        for (const std::atomic<char*>& name : names_) {
            if (const char* path = name.load(); path != nullptr) {
                ::unlink(path);
            }
        }
    }

private:
    std::array<std::atomic<char*>, none> names_{};
};

TemporaryList& temporaryList() noexcept {
    static constinit TemporaryList list;
    return list;
}

/// Held while a temporary file is created.
std::mutex& creation() noexcept {
    static constinit std::mutex mutex;
    return mutex;
}

void writeAll(int descriptor, std::string_view content, const fs::path& name) {
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno != EINTR) {
            failWrite(name, errno);
        }
        if (written > 0) {
            content.remove_prefix(static_cast<size_t>(written));
        }
    }
}

/// A file without a name in the folder of `target`: whatever ends the program, nothing is left of it. Negative: there
/// are none on this file system, or without /proc.
int openUnnamed(const fs::path& target) {
    const std::string& whole = target.native();
    const std::string folder = whole.substr(0, whole.rfind('/') + 1) + ".";
    return ::access("/proc/self/fd", X_OK) != 0 ? -1 : ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
}

/// False with errno set if it fails.
bool linkUnnamed(int descriptor, const fs::path& path) {
    std::array<char, 32> self{};
    *fmt::format_to_n(self.data(), self.size() - 1, "/proc/self/fd/{}", descriptor).out = '\0';
    return ::linkat(AT_FDCWD, self.data(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

/// To a pipe or a device.
void writeDirectly(const fs::path& path, std::string_view content) {
    // Not blocking: to open a pipe that nothing reads would wait for ever. Writing to it may wait.
    Descriptor file(::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | O_NONBLOCK));
    if (!file.valid() && errno == ENXIO) {
        fail("{}: cannot be written: it is a socket, or a pipe that nothing reads", shown(path));
    }
    if (!file.valid() || ::fcntl(file.get(), F_SETFL, O_WRONLY) != 0) {
        failWrite(path, errno);
    }
    writeAll(file.get(), content, path);
    if (!file.close()) {
        failWrite(path, errno);
    }
}

}  // namespace

std::string readFile(const fs::path& path, uint64_t maxBytes) {
    struct stat status {};
    const auto check = [&](bool done) {
        if (!done) {
            fail("{}: cannot be read: {}", shown(path), reason(errno));
        }
        if (S_ISDIR(status.st_mode)) {
            fail("{}: cannot be read: {}", shown(path), reason(EISDIR));
        }
        if (!S_ISREG(status.st_mode)) {
            fail("{}: cannot be read: it is a pipe or a device, not a regular file", shown(path));
        }
        if (status.st_size > 0 && static_cast<uint64_t>(status.st_size) > maxBytes) {
            fail("{}: cannot be read: it has {} bytes, more than the limit of {} MiB", shown(path), status.st_size,
                 maxBytes >> 20U);
        }
    };
    check(::stat(path.c_str(), &status) == 0);  // before opening it: to open a device can have effects
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file.valid()) {
        fail("{}: cannot be read: {}", shown(path), reason(errno));
    }
    check(::fstat(file.get(), &status) == 0);  // it may be another one by now
    std::string content;
    content.reserve(static_cast<size_t>(status.st_size));
    std::string block(size_t{1} << 16, '\0');
    for (;;) {
        const ssize_t count = ::read(file.get(), block.data(), block.size());
        if (count < 0 && errno != EINTR) {
            fail("{}: cannot be read: {}", shown(path), reason(errno));
        }
        if (count == 0) {
            return content;
        }
        if (count > 0) {
            content.append(block, 0, static_cast<size_t>(count));
            if (content.size() > maxBytes) {  // it grows, or is one of /proc, which have size 0
                fail("{}: cannot be read: it has more than {} MiB", shown(path), maxBytes >> 20U);
            }
        }
    }
}

void writeFileAtomically(const fs::path& path, std::string_view content, Lasting lasting) {
    AtomicFile file(path);
    file.write(content);
    file.commit(lasting);
}

bool writeNewFile(const fs::path& path, std::string_view content) {
    AtomicFile file(path);
    file.write(content);
    return file.commitNew();
}

AtomicFile::AtomicFile(const fs::path& target, Naming naming) : name_(target), target_(target) {
    std::error_code error;
    const fs::file_status status = fs::status(target, error);
    if (status.type() == fs::file_type::none) {  // too long, or a loop of links
        failWrite(target, error.value());
    }
    if (fs::is_directory(status) || !target.has_filename()) {
        fail("{}: cannot be written: it is a folder; name a file in it", shown(target));
    }
    direct_ = fs::exists(status) && !fs::is_regular_file(status);
    if (direct_) {
        return;
    }
    if (fs::is_symlink(fs::symlink_status(target, error))) {
        std::error_code dangling;
        const fs::path resolved = fs::canonical(target, dangling);
        target_ = dangling ? target : resolved;
    }
    if (naming == Naming::whenWhole) {
        descriptor_ = openUnnamed(target_);
    }
    if (descriptor_ < 0) {
        openNamed();
    }
}

void AtomicFile::openNamed() {
    tempPath_ = temporaryName(target_);
    const std::scoped_lock lock(creation());
    listed_ = temporaryList().add(tempPath_);  // first: the program may end right after the file is created
    descriptor_ = ::open(tempPath_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
        const int error = errno;
        temporaryList().forget(listed_);
        failWrite(name_, error);
    }
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
    forgetTemporary();
}

void AtomicFile::forgetTemporary() noexcept {
    if (!tempPath_.empty()) {
        ::unlink(tempPath_.c_str());
        temporaryList().forget(listed_);
        tempPath_.clear();
    }
}

void AtomicFile::write(std::string_view content) {
    if (direct_) {
        writeDirectly(name_, content);
    } else {
        writeAll(descriptor_, content, name_);
    }
}

// Brings the content to the disk. Without that, a machine that loses power may keep the name, but not the content.
void AtomicFile::flush() const {
    if (::fsync(descriptor_) != 0 && errno != EINVAL) {  // EINVAL: a file system that cannot
        failWrite(name_, errno);
    }
}

bool AtomicFile::linkTo(const fs::path& path) const {
    return tempPath_.empty() ? linkUnnamed(descriptor_, path) : ::link(tempPath_.c_str(), path.c_str()) == 0;
}

void AtomicFile::commit(Lasting lasting) {
    if (direct_) {
        return;
    }
    if (lasting == Lasting::yes) {
        flush();
    }
    if (tempPath_.empty()) {
        if (linkTo(target_)) {
            return;
        }
        if (errno != EEXIST) {
            failWrite(name_, errno);
        }
        fs::path named = temporaryName(target_);  // no call replaces a file by one without a name
        const std::scoped_lock lock(creation());
        listed_ = temporaryList().add(named);
        if (!linkTo(named)) {
            const int error = errno;
            temporaryList().forget(listed_);
            failWrite(name_, error);
        }
        tempPath_ = std::move(named);
    }
    if (::close(std::exchange(descriptor_, -1)) != 0 || ::rename(tempPath_.c_str(), target_.c_str()) != 0) {
        failWrite(name_, errno);
    }
    forgetTemporary();
}

void removeTemporaryFiles() noexcept {
    temporaryList().removeAll();
}

void exitNow(int status) noexcept {
    creation().lock();  // for good: what is created after the removal would stay
    removeTemporaryFiles();
    ::_exit(status);
}

bool AtomicFile::commitNew() {
    if (direct_) {
        return true;
    }
    flush();
    if (!linkTo(target_)) {
        if (errno == EEXIST) {
            return false;
        }
        commit();  // a file system without hard links
    }
    return true;  // the destructor removes the temporary name
}

}  // namespace reflet
