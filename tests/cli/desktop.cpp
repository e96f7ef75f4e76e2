// Starts Xvfb and controls it with xdotool.
#include "cli/desktop.h"

#include "base/error.h"
#include "base/json_text.h"
#include "support/sanitizer.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <thread>

namespace reflet {

namespace {

using std::chrono::milliseconds;
// Waits end there only if the window hangs. Beyond the least, in times of opening the first window of a test: that
// compiles the pipelines of a preset and renders it to its rest, as the longest of what a test waits for.
constexpr std::chrono::seconds leastPatience(60 * test::slowness);
constexpr int openings = 6;
constexpr milliseconds betweenLooks(20);

}  // namespace

void DesktopTest::SetUp() {
    if (!isInstalled("Xvfb") || !isInstalled("xdotool")) {
        GTEST_SKIP() << "Xvfb and xdotool are not both installed";
    }
    openDesktop();
}

void DesktopTest::openDesktop() {
    display_.clear();
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    const std::string number = std::to_string(ends[1]);
    std::array<const char*, 9> words{"Xvfb",         "-displayfd", number.c_str(), "-screen", "0",
                                     "1600x1000x24", "-nolisten",  "tcp",          nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int error =
        ::posix_spawnp(&child, "Xvfb", &actions, nullptr, const_cast<char* const*>(words.data()), ::environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    ASSERT_EQ(error, 0);
    desktop_ = child;
    char c = 0;
    while (::read(ends[0], &c, 1) == 1 && c != '\n') {
        display_ += c;
    }
    ::close(ends[0]);
    ASSERT_FALSE(display_.empty()) << "Xvfb does not start";
    display_ = ":" + display_;
}

void DesktopTest::TearDown() {
    for (const int process : {viewer_, desktop_}) {
        if (process > 0) {
            ::kill(process, SIGKILL);
            ::waitpid(process, nullptr, 0);
        }
    }
}

Variables DesktopTest::environment() const {
    // Without a folder for its sockets, newer versions of GLFW print that there is no Wayland.
    return {
        {"DISPLAY", display_}, {"XDG_CONFIG_HOME", path("config").string()}, {"XDG_RUNTIME_DIR", path(".").string()}};
}

void DesktopTest::use(const Arguments& arguments) const {
    const Outcome outcome = runOther("xdotool", arguments, environment());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
}

void DesktopTest::startViewer(const Arguments& arguments) {
    Arguments all{"view", "--status", "status.json"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::filesystem::remove(path("status.json"));
    patience_ = 5 * leastPatience;  // nothing is known about the machine yet
    viewer_ = begin(all, environment());
}

void DesktopTest::openViewer(const Arguments& arguments) {
    const auto start = std::chrono::steady_clock::now();
    startViewer(arguments);
    ASSERT_TRUE(atRest());
    const auto took = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - start);
    patience_ = std::max<milliseconds>(leastPatience, openings * took);
}

Outcome DesktopTest::quit() {
    use({"key", "ctrl+q"});
    Outcome outcome = finish(viewer_);
    viewer_ = 0;
    return outcome;
}

Outcome DesktopTest::endBy(int signal) {
    ::kill(viewer_, signal);
    Outcome outcome = finish(viewer_);
    viewer_ = 0;
    return outcome;
}

Outcome DesktopTest::endDesktop() {
    ::kill(desktop_, SIGKILL);
    ::waitpid(desktop_, nullptr, 0);
    desktop_ = 0;
    Outcome outcome = finish(viewer_);
    viewer_ = 0;
    return outcome;
}

nlohmann::json DesktopTest::status() const {
    const std::filesystem::path file = path("status.json");
    return std::filesystem::exists(file) ? parseJson(read("status.json")) : nlohmann::json();
}

bool DesktopTest::shows(const std::function<bool(const nlohmann::json&)>& wanted) const {
    const auto end = std::chrono::steady_clock::now() + patience_;
    while (std::chrono::steady_clock::now() < end) {
        if (const nlohmann::json now = status(); !now.is_null() && wanted(now)) {
            return true;
        }
        std::this_thread::sleep_for(betweenLooks);
    }
    ADD_FAILURE() << "timed out; the window's status is: " << jsonText(status(), 1);
    return false;
}

bool DesktopTest::atRest() const {
    return shows([](const nlohmann::json& now) { return now["at_rest"].get<bool>(); });
}

void DesktopTest::reveal(const std::string& control) const {
    constexpr int mostTurns = 12;
    for (const char* wheel : {"5", "4"}) {  // down, then up
        for (int i = 0; i < mostTurns && !status()["controls"].contains(control); ++i) {
            point(30.0, 200.0);
            act({"click", "--repeat", "3", wheel}, 3);
        }
    }
}

// Until the window has drawn all that it was told. Positions of controls are outdated while it scrolls, and before
// ImGui 1.87 a press counts where the pointer is at the next redraw.
void DesktopTest::answers(const std::function<bool(const nlohmann::json&)>& wanted) const {
    const auto end = std::chrono::steady_clock::now() + std::max<milliseconds>(leastPatience / 10, patience_);
    while (std::chrono::steady_clock::now() < end) {
        if (const nlohmann::json now = status(); now["answered"].get<bool>() && wanted(now)) {
            return;
        }
        std::this_thread::sleep_for(betweenLooks);
    }
}

void DesktopTest::act(const Arguments& arguments, size_t inputs) const {
    const auto before = status()["inputs"].get<size_t>();
    use(arguments);
    answers([&](const nlohmann::json& now) { return now["inputs"].get<size_t>() >= before + inputs; });
}

void DesktopTest::point(double x, double y) const {
    const std::array<int, 2> place{int(x), int(y)};
    use({"mousemove", std::to_string(place[0]), std::to_string(place[1])});
    answers([&](const nlohmann::json& now) { return now["pointer"] == nlohmann::json(place); });
}

void DesktopTest::click(const std::string& control) const {
    reveal(control);
    ASSERT_TRUE(shows([&](const nlohmann::json& now) { return now["controls"].contains(control); })) << control;
    const nlohmann::json place = status()["controls"][control];
    // Near the left edge, because the middle of a wide control may not be clickable.
    clickAt(place[0].get<double>() + 8.0, 0.5 * (place[1].get<double>() + place[3].get<double>()));
}

void DesktopTest::clickAt(double x, double y) const {
    point(x, y);
    act({"mousedown", "1"}, 1);
    act({"mouseup", "1"}, 1);
}

void DesktopTest::drag(double fromX, double fromY, double toX, double toY) const {
    point(fromX, fromY);
    act({"mousedown", "1"}, 1);
    point(0.5 * (fromX + toX), 0.5 * (fromY + toY));
    point(toX, toY);
    act({"mouseup", "1"}, 1);
}

void DesktopTest::press(const std::string& keys) const {
    act({"key", keys}, 2 * (1 + std::ranges::count(keys, '+')));
}

void DesktopTest::type(const std::string& text) const {
    act({"type", "--delay", "15", text}, 2 * text.size());
}

void DesktopTest::resize(uint32_t width, uint32_t height) const {
    use({"search", "--name", "^Reflet", "windowsize", std::to_string(width), std::to_string(height)});
}

}  // namespace reflet
