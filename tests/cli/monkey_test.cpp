// Random input to the window under the validation layers: it neither ends, hangs, complains nor grows. Longer runs are
// better made by a user who may not write much: a monkey may well save a view over a file that it found.
// REFLET_MONKEY: for how many seconds [0: skipped]; REFLET_MONKEY_SEED: with which input [1].
#include "cli/desktop.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <random>
#include <thread>

namespace reflet::monkey_test {

namespace {

uint32_t numberOf(const char* variable, uint32_t standard) {
    const char* text = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): one thread
    return text == nullptr ? standard : static_cast<uint32_t>(std::strtoul(text, nullptr, 10));
}

// Keys of the window and of its text fields. Not Ctrl+Q, which the end is left to.
constexpr std::array<const char*, 48> keys{
    "1",     "2",       "3",       "4",         "5",      "w",       "a",         "s",         "d",     "q",
    "e",     "shift+w", "shift+s", "Escape",    "f",      "r",       "space",     "period",    "c",     "p",
    "x",     "Tab",     "F1",      "ctrl+s",    "ctrl+c", "ctrl+a",  "ctrl+v",    "Return",    "Up",    "Down",
    "Left",  "Right",   "Page_Up", "Page_Down", "Home",   "End",     "Delete",    "BackSpace", "minus", "comma",
    "slash", "alt+F4",  "ctrl+z",  "F5",        "F11",    "Super_L", "shift+Tab", "ctrl+Tab"};
constexpr std::array<const char*, 14> texts{
    "ssr",        "1e9",      "-1",     "nan", "../..", "/proc/version", "no/such/folder/a.json",
    "scene.gltf", "a b\\\"c", "%s%n%x", "0.5", "gi",    "cubes.png",     ""};

class Monkey : public DesktopTest {
protected:
    uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }
    std::string x() { return std::to_string(below(width_ + 20)); }
    std::string y() { return std::to_string(below(height_ + 20)); }

    // xdotool's words for one thing that a monkey does.
    Arguments something() {
        Arguments words{"mousemove", x(), y()};
        const auto add = [&](const Arguments& more) { words.insert(words.end(), more.begin(), more.end()); };
        switch (below(8)) {
            case 0:
                add({"key", keys.at(below(keys.size()))});
                break;
            case 1:
                add({"key", keys.at(below(keys.size())), "key", keys.at(below(keys.size()))});
                break;
            case 2:
                add({"click", std::to_string(1 + below(5))});
                break;
            case 3: {
                const std::string button = std::to_string(1 + below(3));
                add({"mousedown", button, "mousemove", x(), y(), "mousemove", x(), y(), "mouseup", button});
                break;
            }
            case 4:
                add({"click", "--repeat", std::to_string(1 + below(12)), below(2) == 0 ? "4" : "5"});
                break;
            case 5:
                add({"keydown", below(2) == 0 ? "ctrl" : "alt", "click", "1", "keyup", "ctrl", "keyup", "alt"});
                break;
            case 6:
                add({"click", "1", "type", "--delay", "1", "--", texts.at(below(texts.size()))});
                break;
            default:
                if (below(6) == 0) {
                    width_ = 40 + below(1500);
                    height_ = 40 + below(900);
                    words = {
                        "search", "--name", "^Reflet", "windowsize", std::to_string(width_), std::to_string(height_)};
                } else {
                    add({"click", "1"});
                }
        }
        return words;
    }

    // A click on a control by its name: random places rarely hit one of the many.
    Arguments control() {
        const nlohmann::json now = status();
        const nlohmann::json controls = now.contains("controls") ? now["controls"] : nlohmann::json();
        if (!controls.is_object() || controls.empty()) {
            return something();
        }
        const nlohmann::json place = std::next(controls.begin(), below(static_cast<uint32_t>(controls.size()))).value();
        const double across = 0.05 + 0.9 * static_cast<double>(below(100)) / 100.0;
        const double at = place[0].get<double>() + across * (place[2].get<double>() - place[0].get<double>());
        const double height = 0.5 * (place[1].get<double>() + place[3].get<double>());
        const auto inWindow = [](double d) { return std::to_string(static_cast<int>(std::max(d, 0.0))); };
        return {"mousemove", inWindow(at), inWindow(height), "click", "1"};
    }

    [[nodiscard]] bool isRunning() const { return useOf(viewer()).residentMiB > 0.0; }  // the dead have no memory

    std::mt19937 random_{numberOf("REFLET_MONKEY_SEED", 1)};
    uint32_t width_ = 640;
    uint32_t height_ = 400;
};

// Over 5 s: for as long as it is asked to.
TEST_F(Monkey, PlaysWithTheWindow) {
    const uint32_t seconds = numberOf("REFLET_MONKEY", 0);
    if (seconds == 0) {
        GTEST_SKIP() << "REFLET_MONKEY says for how many seconds";
    }
    openViewer({"builtin:moving", "--size", "200x160", "--preset", "plain", "--fresh", "--validate"});
    const auto start = std::chrono::steady_clock::now();
    const auto since = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
    double nextLook = 0.0;
    uint32_t inputs = 0;
    while (since() < seconds && isRunning()) {
        const Outcome did = runOther("xdotool", below(3) == 0 ? control() : something(), environment());
        ASSERT_TRUE(did.status == 0 || !isRunning() || did.err.find("windowsize") != std::string::npos) << did.err;
        ++inputs;
        std::this_thread::sleep_for(std::chrono::milliseconds(below(8) == 0 ? 300 : 20));
        if (since() > nextLook) {
            EXPECT_TRUE(shows([](const nlohmann::json& now) { return now["answered"].get<bool>(); }));
            nextLook += 60.0;
            std::cout << static_cast<int>(since()) << " s, " << inputs << " inputs: " << useOf(viewer()) << std::endl;
        }
    }
    ASSERT_TRUE(isRunning()) << finish(viewer()).err;
    // Without a window manager keys go to the window under the pointer.
    const Arguments atRest{"mousemove", "20", "20", "keyup", "ctrl", "keyup", "alt", "keyup", "shift", "mouseup", "1"};
    (void)runOther("xdotool", atRest, environment());
    const Outcome ended = quit();
    EXPECT_EQ(ended.status, 0) << ended.err;
    // The last ones may take longer than the window waits.
    EXPECT_TRUE(ended.err.empty() || ended.err.starts_with("reflet: warning: screenshots not written")) << ended.err;
    EXPECT_LE(std::ranges::count(ended.err, '\n'), 1) << ended.err;
    EXPECT_GT(inputs, seconds);
}

}  // namespace

}  // namespace reflet::monkey_test
