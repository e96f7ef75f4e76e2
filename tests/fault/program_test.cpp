// The program with a Vulkan call that fails. REFLET_FAULT_ALL: with many (tests/fault/all.sh).
#include "cli/desktop.h"
#include "fault/effort.h"
#include "fault/sweep.h"

namespace reflet::fault {
namespace {

class Faulty : public ProgramTest {
protected:
    [[nodiscard]] Command command(const Arguments& arguments, std::vector<std::string> outputs) const {
        return {arguments.front(), [this, arguments](const Variables& with) { return run(arguments, with); },
                path("x").parent_path(), std::move(outputs)};
    }
};

// Over 5 s: some thirty processes. So that they take no longer, without most effects, whose pipelines take most of the
// time: preset direct calls every function that preset plain does.
TEST_F(Faulty, RenderSaysWhatFailedAndLeavesNothing) {
    const char* preset = testsAll() ? "plain" : "direct";
    sweep(command({"render", "builtin:cubes", "--preset", preset, "--size", "32x18", "-o", "a.png", "-o", "a.exr"},
                  {"a.png", "a.exr"}));
}

// Over 5 s: six processes.
TEST_F(Faulty, ASequenceGoesOnAfterALostDevice) {
    const auto rendered = [&](const std::string& name, const Variables& with) {
        return run({"render", "builtin:cubes", "--preset", "direct", "--size", "32x18", "--frames", "6", "--segment",
                    "2", "--warmup", "1", "--quiet", "-o", name + "-####.png"},
                   with);
    };
    ASSERT_EQ(rendered("whole", {}).status, 0);
    uint32_t number = 0;
    for (const char* fault : {"vkQueueSubmit2:11:VK_ERROR_DEVICE_LOST", "vkWaitSemaphores:14:VK_ERROR_DEVICE_LOST"}) {
        const std::string name = "lost" + std::to_string(++number);
        const Outcome lost = rendered(name, layerEnvironment(path("report.txt"), fault));
        const Report report = readReport(path("report.txt"));
        EXPECT_TRUE(report.hit && report.ended && report.complaints.empty()) << fault << report.complaints;
        EXPECT_EQ(lost.status, 1) << fault;
        EXPECT_NE(lost.err.find("the device was lost"), std::string::npos) << lost.err;
        EXPECT_NE(lost.err.find("frames are written: run the same command again to continue"), std::string::npos)
            << lost.err;
        EXPECT_FALSE(std::filesystem::exists(path(name + "-0005.png"))) << fault << " came too late";
        EXPECT_EQ(rendered(name, {}).status, 0);
        size_t files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(path("x").parent_path())) {
            files += entry.path().filename().string().starts_with(name) ? 1 : 0;
        }
        EXPECT_EQ(files, 7U) << "six frames and their record";
        for (int frame = 0; frame < 6; ++frame) {
            const std::string suffix = "-000" + std::to_string(frame) + ".png";
            EXPECT_EQ(read(name + suffix), read("whole" + suffix)) << fault << suffix;
        }
    }
}

TEST_F(Faulty, BenchSaysWhatFailedAndLeavesNothing) {
    Command bench = command({"bench",          "builtin:cubes",
                             "--size",         "16x16",
                             "--frames",       "1",
                             "--warmup",       "0",
                             "--first",        "1",
                             "--motion",       "0",
                             "--rest",         "0",
                             "--no-bandwidth", "--truth",
                             "none",           "--preset",
                             "plain",          "--json",
                             "out.json"},
                            {"out.json"});
    bench.few = {"vkGetQueryPoolResults:2:VK_ERROR_DEVICE_LOST", "vkMapMemory:3:VK_ERROR_MEMORY_MAP_FAILED"};
    sweep(bench);
}

class FaultyWindow : public DesktopTest {
protected:
    /// Opens the window, waits until the image has converged, writes a picture of the window and ends.
    [[nodiscard]] Command command() const {
        const auto open = [this](const Variables& with) {
            Variables all = environment();
            all.insert(with.begin(), with.end());
            return run({"view", "builtin:cubes", "--fresh", "--preset", "plain", "--size", "64x64", "--window-picture",
                        "w.png"},
                       all);
        };
        return {"view", open, path("x").parent_path(), {"w.png"}};
    }
};

// Over 5 s: five windows.
TEST_F(FaultyWindow, TheWindowComesBackOrSaysWhyNot) {
    Command view = command();
    view.few = {"vkQueuePresentKHR:2:VK_ERROR_OUT_OF_DATE_KHR", "vkAcquireNextImageKHR:3:VK_ERROR_SURFACE_LOST_KHR",
                "vkQueueSubmit2:40:VK_ERROR_DEVICE_LOST",           // of one of two devices
                "vkCreateImage:20:VK_ERROR_OUT_OF_DEVICE_MEMORY"};  // of the image's first frame
    sweep(view);
}

}  // namespace
}  // namespace reflet::fault
