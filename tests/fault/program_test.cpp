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
