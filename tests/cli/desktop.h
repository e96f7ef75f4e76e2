// A virtual desktop (Xvfb) with simulated mouse and keyboard input (xdotool).
#pragma once

#include "cli/program.h"

#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <functional>
#include <string>

namespace reflet {

/// A test of `reflet view` on its own desktop, skipped if Xvfb or xdotool is not installed.
class DesktopTest : public ProgramTest {
protected:
    void SetUp() override;
    void TearDown() override;

    /// Opens the viewer with --status.
    void startViewer(const Arguments& arguments);
    /// The same, and waits until it has finished rendering.
    void openViewer(const Arguments& arguments);
    /// Quits it by Ctrl+Q.
    [[nodiscard]] Outcome quit();
    /// Ends it by a signal.
    [[nodiscard]] Outcome endBy(int signal);
    /// Ends the display, and waits for the viewer to exit.
    [[nodiscard]] Outcome endDesktop();
    void openDesktop();

    /// The window's own status report.
    [[nodiscard]] nlohmann::json status() const;
    /// Waits until the status satisfies `wanted`; false on timeout, which follows how fast this machine is.
    [[nodiscard]] bool shows(const std::function<bool(const nlohmann::json&)>& wanted) const;
    [[nodiscard]] bool atRest() const;

    // Input. Each function returns when the window has drawn what the input changed, or after six seconds (longer with
    // a sanitizer, or where opening the window took long).

    /// Clicks a control of the panels by its name, after scrolling it into view.
    void click(const std::string& control) const;
    void clickAt(double x, double y) const;
    void drag(double fromX, double fromY, double toX, double toY) const;
    /// keys: xdotool's names, such as "space" or "ctrl+q".
    void press(const std::string& keys) const;
    void type(const std::string& text) const;
    void resize(uint32_t width, uint32_t height) const;
    [[nodiscard]] int viewer() const { return viewer_; }  ///< process id
    [[nodiscard]] Variables environment() const;

private:
    void reveal(const std::string& control) const;
    void use(const Arguments& arguments) const;  ///< xdotool, without waiting
    /// xdotool, until the window has answered so many presses, releases and steps of the wheel.
    void act(const Arguments& arguments, size_t inputs) const;
    void point(double x, double y) const;
    void answers(const std::function<bool(const nlohmann::json&)>& wanted) const;

    std::chrono::milliseconds patience_{0};  ///< longest wait, by the time that opening the viewer took
    int desktop_ = 0;
    int viewer_ = 0;
    std::string display_;
};

}  // namespace reflet
