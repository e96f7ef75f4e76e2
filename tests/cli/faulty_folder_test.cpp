// Sequences on a file system that fails, fills up, has no hard links, or shows files late: what is there is whole, and
// the same command goes on to the same bytes.
#include "cli/program.h"

#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <thread>

namespace reflet::faulty_folder_test {

namespace {

namespace fs = std::filesystem;
using Bytes = std::map<std::string, std::string>;

class FaultyFolder : public ProgramTest {
protected:
    void SetUp() override {
#ifdef REFLET_FAULTY_FOLDER
        for (const char* folder : {"m", "folder", "faults", "right"}) {
            fs::create_directory(path(folder));
        }
        const Outcome mounted = runOther(
            REFLET_FAULTY_FOLDER,
            {path("m").string(), "-o", "folder=" + path("folder").string() + ",faults=" + path("faults").string()});
        isMounted_ = mounted.status == 0;
        if (!isMounted_) {
            GTEST_SKIP() << "FUSE cannot mount here: " << mounted.err;
        }
#else
        GTEST_SKIP() << "built without libfuse3";
#endif
    }
    void TearDown() override {
        if (isMounted_) {
            EXPECT_TRUE(quietSuccess(runOther("fusermount3", {"-u", path("m").string()})));
        }
    }

    static Arguments frames(const std::string& folder, const Arguments& more = {}) {
        Arguments all{"render", "builtin:cubes",    "--preset", "plain",     "--size", "32x18",    "--frames",
                      "6",      "--path",           "orbit",    "--segment", "2",      "--warmup", "0",
                      "-o",     folder + "/a_#.png"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    /// What a folder has, without the temporary files of processes that run. Not through the file system under test.
    [[nodiscard]] Bytes contents(const std::string& folder) const {
        Bytes all;
        for (const auto& entry : fs::directory_iterator(path(folder))) {
            const std::string name = entry.path().filename().string();
            all[name] = read(folder + "/" + name);
        }
        return all;
    }
    /// What an undisturbed run writes.
    [[nodiscard]] Bytes right() const {
        EXPECT_TRUE(quietSuccess(run(frames("right"))));
        Bytes all = contents("right");
        EXPECT_EQ(all.size(), 7U) << "six frames and a record";
        return all;
    }
    /// All that is there is whole, and less than everything.
    void isAPartOf(const Bytes& whole) const {
        const Bytes now = contents("folder");
        EXPECT_LT(now.size(), whole.size());
        for (const auto& [name, bytes] : now) {
            EXPECT_TRUE(whole.contains(name) && whole.at(name) == bytes) << name;
        }
    }
    void goesOnTo(const Bytes& whole) const {
        EXPECT_TRUE(quietSuccess(run(frames("m"))));
        EXPECT_TRUE(contents("folder") == whole);  // not EXPECT_EQ, which prints both
    }
    [[nodiscard]] Arguments share(const std::string& which) const {
        return frames("m", {"--share", which});
    }

private:
    bool isMounted_ = false;
};

// Over 5 s: five runs of the program, which each compile their shaders. So has the next.
TEST_F(FaultyFolder, AfterAFailedCallTheSequenceGoesOn) {
    const Bytes whole = right();
    for (const char* call : {"rename", "fsync"}) {
        write(std::string("faults/") + call, "3");
        EXPECT_TRUE(refused(run(frames("m")), 1, {"m/a_", "cannot be written", "Input/output error"})) << call;
        EXPECT_FALSE(fs::exists(path(std::string("faults/") + call))) << "it was never called";
        isAPartOf(whole);
        goesOnTo(whole);
        for (const auto& [name, bytes] : whole) {
            fs::remove(path("folder/" + name));
        }
    }
}

TEST_F(FaultyFolder, AfterAFullDiskItGoesOn) {
    const Bytes whole = right();
    const int process = begin(frames("m"));
    while (!fs::exists(path("folder/a_1.png")) && useOf(process).residentMiB > 0.0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    write("faults/full", "");
    EXPECT_TRUE(refused(finish(process), 1, {"m/a_", "cannot be written", "No space left on device"}));
    isAPartOf(whole);
    EXPECT_TRUE(refused(run(frames("m")), 1, {"No space left on device"}));
    isAPartOf(whole);
    fs::remove(path("faults/full"));
    goesOnTo(whole);
}

TEST_F(FaultyFolder, HardLinksAreNotNeeded) {
    const Bytes whole = right();
    write("faults/nolink", "");
    goesOnTo(whole);
}

// Over 5 s: files are late by two seconds.
TEST_F(FaultyFolder, ProcessesThatSeeEachOthersFilesLateShareASequence) {
    const Bytes whole = right();
    write("faults/late", "");
    const int first = begin(share("1/2"));
    const int second = begin(share("2/2"));
    EXPECT_TRUE(quietSuccess(finish(first)));
    EXPECT_TRUE(quietSuccess(finish(second)));
    goesOnTo(whole);
}

TEST_F(FaultyFolder, APictureThatCannotBeRenamedLeavesTheOldOne) {
    write("folder/old.png", "old");
    write("faults/rename", "1");
    EXPECT_TRUE(refused(render("builtin:cubes", {"-o", "m/old.png"}), 1, {"m/old.png", "Input/output error"}));
    EXPECT_EQ(contents("folder"), (Bytes{{"old.png", "old"}}));
}

}  // namespace

}  // namespace reflet::faulty_folder_test
