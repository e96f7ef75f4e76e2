// How `reflet view` ends: while the device is busy, and before its scene is open.
#include "cli/desktop.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

namespace reflet::view_end_test {

namespace {

using nlohmann::json;

class ViewEnd : public DesktopTest {
protected:
    /// Opens a window whose only long pass takes 20 s on two fast cores, and waits until the device is in it.
    void startLongPass(const Arguments& more) {
        Arguments all{"builtin:cubes",
                      "--size",
                      "240x400",
                      "--preset",
                      "direct",
                      "--set",
                      "shadow.filter=none",
                      "--set",
                      "diffuse.rays=256",
                      "--set",
                      "diffuse.method=slices",
                      "--set",
                      "diffuse.slice_steps=64",
                      "--set",
                      "trace_screen.max_steps=4096"};
        all.insert(all.end(), more.begin(), more.end());
        startViewer(all);
        ASSERT_TRUE(shows([](const json& now) { return now["answered"].get<bool>(); }));
        const double before = cpuSeconds(viewer());
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (cpuSeconds(viewer()) < before + 1.0 && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }

    /// The saved states, one after another.
    [[nodiscard]] std::string saved() const {
        std::string all;
        const std::filesystem::path folder = path("config/reflet/view");
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            EXPECT_EQ(entry.path().extension(), ".json") << "a temporary file";
            all += read(std::filesystem::relative(entry.path(), path(".")).string());
        }
        return all;
    }

    /// What is expected of the end of a window with a long pass.
    [[nodiscard]] Outcome endsSoon(const std::function<Outcome()>& end) const {
        const auto start = std::chrono::steady_clock::now();
        Outcome ended = end();
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15)) << "it waited for the pass";
        EXPECT_NE(saved().find("4096"), std::string::npos) << saved();
        return ended;
    }
};

// A screenshot that would take as long is told to be lost, and nothing of it is left.
TEST_F(ViewEnd, CtrlQDoesNotWaitForThePassThatTheDeviceHasBegun) {
    startLongPass({});
    press("ctrl+s");
    const Outcome ended = endsSoon([&] { return quit(); });
    EXPECT_EQ(ended.err,
              "reflet: warning: screenshots not written, as the device is busy: 1; close the window after them\n");
    EXPECT_FALSE(std::filesystem::exists(path("cubes-1.png")));
}

TEST_F(ViewEnd, NeitherDoesASignalAndUnderTheValidationLayers) {
    startLongPass({"--validate"});
    EXPECT_EQ(endsSoon([&] { return endBy(SIGTERM); }).err, "");
}

TEST_F(ViewEnd, ASceneThatDoesNotOpenKeepsItsSavedState) {
    const Arguments view{"view", "scene.gltf", "--size", "64x64", "--window-picture", "w.png", "--preset", "direct"};
    write("scene.gltf", triangleAnd(R"("nodes": [{"mesh": 0}])"));
    Arguments changed = view;
    changed.insert(changed.end(), {"--set", "tonemap.exposure=1.25"});
    EXPECT_EQ(run(changed, environment()).status, 0);
    const std::string before = saved();
    EXPECT_NE(before.find("1.25"), std::string::npos);
    write("scene.gltf", "{");
    EXPECT_EQ(run(view, environment()).status, 1);
    EXPECT_EQ(saved(), before);
}

}  // namespace

}  // namespace reflet::view_end_test
