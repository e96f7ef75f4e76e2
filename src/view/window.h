// A desktop window with a user interface. Only one can exist at a time.
#pragma once

#include "base/math.h"

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

struct GLFWwindow;
struct ImDrawData;
struct VkInstance_T;
struct VkSurfaceKHR_T;

namespace reflet {

/// A key pressed while no text field had the keyboard focus.
struct KeyPress {
    int key = 0;  ///< GLFW_KEY_…
    bool control = false;
};

class Window {
public:
    /// Throws Error without a display. size: in desktop units.
    Window(const std::string& title, uvec2 size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Instance extensions that `surface` needs. Requires a window.
    [[nodiscard]] static std::vector<const char*> vulkanExtensions();
    /// Creates this window's Vulkan surface. Throws Error.
    [[nodiscard]] VkSurfaceKHR_T* surface(VkInstance_T* instance) const;

    /// Waits for an event, for at most this many seconds; 0: returns immediately.
    static void waitForEvents(double seconds);
    /// Ends waitForEvents(). May be called from any thread.
    static void wake();
    /// Whether there were events since the last call.
    bool takeEvents();
    std::vector<KeyPress> takeKeys();
    std::vector<std::string> takeDroppedFiles();

    [[nodiscard]] bool isHeld(int key) const;
    /// Position of the pointer at the last button press.
    [[nodiscard]] vec2 pressedAt() const { return pressedAt_; }
    /// Where the pointer is, in desktop units from the window's upper left.
    [[nodiscard]] vec2 pointer() const { return pointer_; }
    /// Presses and releases of keys and buttons, and steps of the wheel, in total.
    [[nodiscard]] uint64_t inputs() const { return inputs_; }
    [[nodiscard]] bool closing() const;
    void close();
    void hide();
    void setTitle(const std::string& title);
    void copyText(const std::string& text);
    [[nodiscard]] uvec2 pixels() const;                   ///< 0 while minimised
    [[nodiscard]] uvec2 size() const;                     ///< in desktop units
    [[nodiscard]] float scale() const { return scale_; }  ///< text scale of this display

    /// The font atlas as RGBA8.
    static std::span<const uint8_t> font(uvec2& size);
    /// Begin and end a frame of the user interface.
    void beginUi();
    const ImDrawData& endUi();

private:
    struct KeyEvent {  // as reported by GLFW
        int key = 0;
        int code = 0;
        int action = 0;
        int mods = 0;
    };

    void countInput();
    void takeKey(const KeyEvent& event);

    GLFWwindow* window_ = nullptr;
    bool pressed_ = false;  ///< a key was pressed since the last frame of the user interface
    std::vector<KeyEvent> released_;
    vec2 pointer_{0.0F};
    vec2 pressedAt_{0.0F};
    float scale_ = 1.0F;
    bool happened_ = true;
    uint64_t inputs_ = 0;
    std::vector<KeyPress> keys_;
    std::set<int> shortcuts_;  ///< keys pressed with Control, which may be released before them
    std::vector<std::string> dropped_;
};

}  // namespace reflet
