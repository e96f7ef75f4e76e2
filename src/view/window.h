// A window of the desktop with a user interface in it. One at a time.
#pragma once

#include "base/math.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

struct GLFWwindow;
struct ImDrawData;
struct VkInstance_T;
struct VkSurfaceKHR_T;

namespace reflet {

/// A key that went down while no text field had the keyboard.
struct KeyPress {
    int key = 0;  ///< GLFW_KEY_…
    bool control = false;
};

class Window {
public:
    /// Throws Error where there is no display. size: in the desktop's units.
    Window(const std::string& title, uvec2 size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// What Vulkan's instance must be able to do for `surface`. There has to be a window.
    [[nodiscard]] static std::vector<const char*> vulkanExtensions();
    /// Of this window. Throws Error.
    [[nodiscard]] VkSurfaceKHR_T* surface(VkInstance_T* instance) const;

    /// Returns after an event or so many seconds; 0: at once.
    static void waitForEvents(double seconds);
    /// Makes another thread's news end the wait. May be called from any thread.
    static void wake();
    /// Whether anything has happened since it was asked last.
    bool takeEvents();
    std::vector<KeyPress> takeKeys();
    std::vector<std::string> takeDroppedFiles();

    [[nodiscard]] bool isHeld(int key) const;
    /// Where the pointer was when a button went down last; by now it may be elsewhere.
    [[nodiscard]] vec2 pressedAt() const { return pressedAt_; }
    [[nodiscard]] bool closing() const;
    void close();
    void setTitle(const std::string& title);
    void copyText(const std::string& text);
    [[nodiscard]] uvec2 pixels() const;                   ///< 0 while minimised
    [[nodiscard]] uvec2 size() const;                     ///< in the desktop's units
    [[nodiscard]] float scale() const { return scale_; }  ///< by which text is larger on this display

    /// The letters as RGBA8.
    static std::span<const uint8_t> font(uvec2& size);
    /// Begins and ends a description of the user interface.
    static void beginUi();
    const ImDrawData& endUi();

private:
    struct KeyEvent {  // as GLFW tells it
        int key = 0;
        int code = 0;
        int action = 0;
        int mods = 0;
    };

    void takeKey(const KeyEvent& event);

    GLFWwindow* window_ = nullptr;
    bool pressed_ = false;  ///< a key, since the last frame of the user interface
    std::vector<KeyEvent> released_;
    vec2 pointer_{0.0F};
    vec2 pressedAt_{0.0F};
    float scale_ = 1.0F;
    bool happened_ = true;
    std::vector<KeyPress> keys_;
    std::vector<std::string> dropped_;
};

}  // namespace reflet
