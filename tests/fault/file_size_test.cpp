// Disks that become full while an output is written: at every byte of small files, by a limit on the size of files,
// which also makes writes short; and with the program on a small file system.
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "base/json_text.h"
#include "cli/program.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>

namespace reflet::file_size_test {
namespace {

namespace fs = std::filesystem;

class FileSize : public ProgramTest {
protected:
    using Writer = std::function<void(const fs::path&)>;

    /// Writes in a process that may write so many bytes. Returns the error; empty: none.
    [[nodiscard]] std::string writeLimited(const Writer& writer, const fs::path& file, size_t most) const {
        std::array<int, 2> pipe{};
        EXPECT_EQ(::pipe(pipe.data()), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            ::signal(SIGXFSZ, SIG_IGN);  // as the program does
            const rlimit limit{most, most};
            ::setrlimit(RLIMIT_FSIZE, &limit);
            std::string text;
            try {
                writer(file);
            } catch (const Error& error) {
                text = error.what();
            } catch (...) {
                text = "another exception";
            }
            const ssize_t written = ::write(pipe[1], text.data(), text.size());
            ::_exit(written == static_cast<ssize_t>(text.size()) ? 0 : 1);
        }
        ::close(pipe[1]);
        std::array<char, 1024> text{};
        const ssize_t length = ::read(pipe[0], text.data(), text.size());
        ::close(pipe[0]);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
        return {text.data(), static_cast<size_t>(std::max<ssize_t>(length, 0))};
    }

    void tryAllLimits(const Writer& writer, const std::string& name) {
        writer(path("whole"));
        const std::string whole = read("whole");
        fs::remove(path("whole"));
        ASSERT_LT(whole.size(), 2000U);
        for (const bool exists : {false, true}) {
            for (size_t most = 0; most < whole.size(); ++most) {
                if (exists) {
                    write(name, "old");
                }
                const std::string error = writeLimited(writer, path(name), most);
                ASSERT_TRUE(error.starts_with(path(name).string() + ": cannot be written: File too large")) << error;
                ASSERT_EQ(files(), exists ? std::vector<std::string>{name} : std::vector<std::string>{}) << most;
                ASSERT_TRUE(!exists || read(name) == "old") << most;
            }
            ASSERT_EQ(writeLimited(writer, path(name), whole.size()), "");
            ASSERT_EQ(files(), std::vector<std::string>{name});
            ASSERT_TRUE(read(name) == whole);
            fs::remove(path(name));
        }
    }
};

const Bitmap bitmap{4, 3, 3, std::vector<uint8_t>(36, 77)};
const std::vector<ImageLayer> layers{{"", {2, 2, {"R", "G"}, std::vector<float>(8, 0.5F)}}};

TEST_F(FileSize, APictureIsWrittenWhollyOrNotAtAll) {
    tryAllLimits([](const fs::path& file) { writePng(file, bitmap); }, "a.png");
}

TEST_F(FileSize, AnExrIsWrittenWhollyOrNotAtAll) {
    tryAllLimits([](const fs::path& file) { writeExr(file, layers); }, "a.exr");
}

TEST_F(FileSize, JsonIsWrittenWhollyOrNotAtAll) {
    const std::string text = jsonText({{"name", "value"}, {"list", {1, 2, 3}}}, 2);
    tryAllLimits([&](const fs::path& file) { writeFileAtomically(file, text); }, "a.json");
    tryAllLimits(
        [&](const fs::path& file) {
            fs::exists(file) ? writeFileAtomically(file, text) : void(writeNewFile(file, text));
        },
        "new.json");
}

TEST_F(FileSize, AFullDeviceIsAnErrorOfEachWriter) {
    const fs::path full = "/dev/full";
    const Writer writers[] = {[](const fs::path& file) { writePng(file, bitmap); },
                              [](const fs::path& file) { writeExr(file, layers); },
                              [](const fs::path& file) { writeFileAtomically(file, "text"); }};
    for (const Writer& writer : writers) {
        try {
            writer(full);
            ADD_FAILURE() << "written";
        } catch (const Error& error) {
            EXPECT_STREQ(error.what(), "/dev/full: cannot be written: No space left on device");
        }
    }
    EXPECT_TRUE(fs::is_character_file(full));
}

// In name spaces of its own a process may mount a small file system, where the kernel allows it.
TEST_F(FileSize, AFullDiskIsAFailureOfTheProgramAndLeavesNothing) {
    fs::create_directory(path("disk"));
    const std::string mount = "mount -t tmpfs -o size=16k none disk";
    if (runOther("unshare", {"-Urm", "sh", "-c", mount}).status != 0 &&
        runOther("unshare", {"-m", "sh", "-c", mount}).status != 0) {
        GTEST_SKIP() << "no small file system can be mounted";
    }
    const bool user = runOther("unshare", {"-Urm", "sh", "-c", mount}).status == 0;
    const std::string render =
        " && \"$0\" render builtin:cubes --preset plain --size 160x90 -o disk/a.png; status=$?; ls -A disk; exit "
        "$status";
    for (const bool exists : {false, true}) {
        const std::string before = exists ? " && echo old > disk/a.png" : "";
        const Outcome outcome =
            runOther("unshare", {user ? "-Urm" : "-m", "sh", "-c", mount + before + render, REFLET_PROGRAM});
        EXPECT_EQ(outcome.status, 1) << outcome.out;
        EXPECT_EQ(outcome.err, "reflet: disk/a.png: cannot be written: No space left on device\n");
        EXPECT_EQ(outcome.out, exists ? "a.png\n" : "");
    }
}

}  // namespace
}  // namespace reflet::file_size_test
