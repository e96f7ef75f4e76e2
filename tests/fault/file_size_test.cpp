// Disks that become full while an output is written: at every byte of small files, by a limit on the size of files,
// which also makes writes short; and with the program on a small file system.
#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "base/json_text.h"
#include "cli/program.h"

#include <sys/resource.h>

#include <csignal>
#include <nlohmann/json.hpp>

namespace reflet::file_size_test {
namespace {

namespace fs = std::filesystem;

class FileSize : public ProgramTest {
protected:
    using Writer = std::function<void(const fs::path&)>;

    /// Writes while files may have so many bytes. Returns the error; empty: none.
    [[nodiscard]] static std::string writeLimited(const Writer& writer, const fs::path& file, size_t most) {
        std::string text;
        rlimit before{};
        ::getrlimit(RLIMIT_FSIZE, &before);
        const auto handler = ::signal(SIGXFSZ, SIG_IGN);  // as the program does
        const rlimit limit{most, before.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            writer(file);
        } catch (const Error& error) {
            text = error.what();
        } catch (...) {
            text = "another exception";
        }
        ::setrlimit(RLIMIT_FSIZE, &before);
        ::signal(SIGXFSZ, handler);
        return text;
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
const std::vector<ImageLayer> values{{"", {2, 2, {"R", "G"}, std::vector<float>(8, 0.5F)}}};

TEST_F(FileSize, APictureIsWrittenWhollyOrNotAtAll) {
    tryAllLimits([](const fs::path& file) { writePng(file, bitmap); }, "a.png");
}

TEST_F(FileSize, AnExrIsWrittenWhollyOrNotAtAll) {
    tryAllLimits([](const fs::path& file) { writeExr(file, values); }, "a.exr");
}

TEST_F(FileSize, JsonIsWrittenWhollyOrNotAtAll) {
    const std::string text = jsonText(nlohmann::json{{"name", "value"}, {"list", {1, 2, 3}}}, 2);
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
                              [](const fs::path& file) { writeExr(file, values); },
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
