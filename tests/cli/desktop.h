// A desktop without a screen (Xvfb), and a hand on its mouse and keys (xdotool): tests use windows as people do.
#pragma once

#include "cli/program.h"

#include <nlohmann/json.hpp>

#include <array>
#include <functional>
#include <string>

namespace reflet {

/// A test of `reflet view` on a desktop of its own, skipped where Xvfb or xdotool are not installed.
class DesktopTest : public ProgramTest {
protected:
    void SetUp() override;
    void TearDown() override;

    /// Opens the viewer with --status, and waits until its picture is at rest.
    void openViewer(const Arguments& arguments);
    /// Ends it as its user would (Ctrl+Q).
    [[nodiscard]] Outcome quit();
    /// Takes the display away from it, and waits for its end.
    [[nodiscard]] Outcome endDesktop();
    void openDesktop();

    /// What the window says it shows.
    [[nodiscard]] nlohmann::json status() const;
    /// Waits until the window says so; false if it never does.
    [[nodiscard]] bool shows(const std::function<bool(const nlohmann::json&)>& wanted) const;
    [[nodiscard]] bool atRest() const;

    /// A real click on a control of the panels, by its name, which are scrolled until it can be seen.
    void click(const std::string& control) const;
    void clickAt(double x, double y) const;
    void drag(double fromX, double fromY, double toX, double toY) const;
    /// Key names as xdotool has them: "space", "ctrl+q".
    void press(const std::string& keys) const;
    void type(const std::string& text) const;
    void resize(uint32_t width, uint32_t height) const;

    [[nodiscard]] int viewer() const { return viewer_; }
    [[nodiscard]] Environment environment() const;

private:
    void settle() const;
    void reveal(const std::string& control) const;
    void use(const Arguments& arguments) const;

    int desktop_ = 0;
    int viewer_ = 0;
    std::string display_;
};

}  // namespace reflet
