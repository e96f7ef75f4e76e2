// A file system (FUSE) that shows a folder and fails as network file systems and full disks do:
//   faulty_folder MOUNTPOINT -o folder=FOLDER,faults=FAULTS    (absolute paths; libfuse's options, too)
// Files in the folder FAULTS say which faults there are:
//   rename, fsync   a number N: the N-th call from now on fails with EIO, once, and the file is removed
//   full            while it exists, nothing can be written (ENOSPC)
//   nolink          while it exists, there are no hard links (EPERM)
//   late            while it exists, other processes see what a process creates two seconds later
// No file without a name (O_TMPFILE) can be made in it.
#define FUSE_USE_VERSION 31
#include <fcntl.h>
#include <fuse3/fuse.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds lateness(2);

struct Folder {
    char* folder = nullptr;
    char* faults = nullptr;
};

struct Creation {
    int process = 0;
    Clock::time_point at;
};

Folder& self() {
    static Folder folder;
    return folder;
}

std::map<std::string, Creation>& creations() {
    static std::map<std::string, Creation> all;
    return all;
}

std::string real(const char* path) {
    return std::string(self().folder) + path;
}

fs::path faultFile(const char* name) {
    return fs::path(self().faults) / name;
}

bool has(const char* fault) {
    return fs::exists(faultFile(fault));
}

// Whether this call is the one that fails.
bool takeFault(const char* fault) {
    std::ifstream in(faultFile(fault));
    int left = 0;
    if (!(in >> left)) {
        return false;
    }
    if (left <= 1) {
        fs::remove(faultFile(fault));
        return true;
    }
    std::ofstream(faultFile(fault)) << left - 1;
    return false;
}

// FUSE says which thread calls.
int caller() {
    const int thread = fuse_get_context()->pid;
    std::ifstream status("/proc/" + std::to_string(thread) + "/status");
    for (std::string word; status >> word;) {
        if (word == "Tgid:") {
            int process = 0;
            status >> process;
            return process;
        }
    }
    return thread;
}

void noteCreation(const char* path) {
    creations()[path] = {.process = caller(), .at = Clock::now()};
}

bool isHidden(const std::string& path) {
    const auto found = creations().find(path);
    return found != creations().end() && has("late") && Clock::now() < found->second.at + lateness &&
           found->second.process != caller();
}

int answer(int64_t result) {
    return result < 0 ? -errno : static_cast<int>(result);
}

int keep(fuse_file_info* file, int descriptor) {
    file->fh = static_cast<uint64_t>(descriptor);
    return descriptor < 0 ? -errno : 0;
}

// What the file system does, under the names that libfuse has.
struct Calls {
    static void* begin(fuse_conn_info* /*connection*/, fuse_config* config) {
        config->entry_timeout = 0.0;
        config->attr_timeout = 0.0;
        config->negative_timeout = 0.0;
        return nullptr;
    }

    static int getattr(const char* path, struct stat* status, fuse_file_info* /*file*/) {
        return isHidden(path) ? -ENOENT : answer(::lstat(real(path).c_str(), status));
    }

    static int readdir(const char* path, void* buffer, fuse_fill_dir_t fill, off_t /*offset*/, fuse_file_info* /*file*/,
                       fuse_readdir_flags /*flags*/) {
        std::error_code error;
        const std::string folder = std::string(path) == "/" ? "/" : std::string(path) + "/";
        for (const auto& entry : fs::directory_iterator(real(path), error)) {
            const std::string name = entry.path().filename().string();
            if (!isHidden(folder + name)) {
                fill(buffer, name.c_str(), nullptr, 0, fuse_fill_dir_flags{});
            }
        }
        return -error.value();
    }

    static int mkdir(const char* path, mode_t mode) {
        noteCreation(path);
        return answer(::mkdir(real(path).c_str(), mode));
    }

    static int rmdir(const char* path) { return answer(::rmdir(real(path).c_str())); }

    static int unlink(const char* path) { return answer(::unlink(real(path).c_str())); }

    static int rename(const char* from, const char* to, unsigned flags) {
        if (flags != 0) {
            return -EINVAL;
        }
        if (takeFault("rename")) {
            return -EIO;
        }
        noteCreation(to);
        return answer(::rename(real(from).c_str(), real(to).c_str()));
    }

    static int link(const char* from, const char* to) {
        if (has("nolink")) {
            return -EPERM;
        }
        const int done = answer(::link(real(from).c_str(), real(to).c_str()));
        if (done == 0) {
            noteCreation(to);
        }
        return done;
    }

    static int truncate(const char* path, off_t size, fuse_file_info* /*file*/) {
        return answer(::truncate(real(path).c_str(), size));
    }

    static int open(const char* path, fuse_file_info* file) {
        return isHidden(path) ? -ENOENT : keep(file, ::open(real(path).c_str(), file->flags));
    }

    static int create(const char* path, mode_t mode, fuse_file_info* file) {
        const int done = keep(file, ::open(real(path).c_str(), file->flags, mode));
        if (done == 0) {
            noteCreation(path);
        }
        return done;
    }

    static int read(const char* /*path*/, char* data, size_t size, off_t offset, fuse_file_info* file) {
        return answer(::pread(static_cast<int>(file->fh), data, size, offset));
    }

    static int write(const char* /*path*/, const char* data, size_t size, off_t offset, fuse_file_info* file) {
        return has("full") ? -ENOSPC : answer(::pwrite(static_cast<int>(file->fh), data, size, offset));
    }

    static int release(const char* /*path*/, fuse_file_info* file) {
        return answer(::close(static_cast<int>(file->fh)));
    }

    static int fsync(const char* /*path*/, int /*dataOnly*/, fuse_file_info* file) {
        return takeFault("fsync") ? -EIO : answer(::fsync(static_cast<int>(file->fh)));
    }

    static int statfs(const char* path, struct statvfs* status) {
        return answer(::statvfs(real(path).c_str(), status));
    }
};

}  // namespace

int main(int argc, char** argv) {
    fuse_args arguments{.argc = argc, .argv = argv, .allocated = 0};
    const std::array<fuse_opt, 3> options{{{.templ = "folder=%s", .offset = offsetof(Folder, folder), .value = 0},
                                           {.templ = "faults=%s", .offset = offsetof(Folder, faults), .value = 0},
                                           {.templ = nullptr, .offset = 0, .value = 0}}};
    if (fuse_opt_parse(&arguments, &self(), options.data(), nullptr) != 0 || self().folder == nullptr ||
        self().faults == nullptr) {
        std::fputs("usage: faulty_folder MOUNTPOINT -o folder=FOLDER,faults=FAULTS\n", stderr);
        return 2;
    }
    fuse_operations operations{};
    operations.init = Calls::begin;
    operations.getattr = Calls::getattr;
    operations.readdir = Calls::readdir;
    operations.mkdir = Calls::mkdir;
    operations.rmdir = Calls::rmdir;
    operations.unlink = Calls::unlink;
    operations.rename = Calls::rename;
    operations.link = Calls::link;
    operations.truncate = Calls::truncate;
    operations.open = Calls::open;
    operations.create = Calls::create;
    operations.read = Calls::read;
    operations.write = Calls::write;
    operations.release = Calls::release;
    operations.fsync = Calls::fsync;
    operations.statfs = Calls::statfs;
    fuse_opt_add_arg(&arguments, "-s");  // one call after the other
    const int status = fuse_main(arguments.argc, arguments.argv, &operations, nullptr);
    fuse_opt_free_args(&arguments);
    return status;
}
