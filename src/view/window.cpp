// Implements the window with GLFW and its user interface with Dear ImGui.
#include "gpu/vulkan.h"  // before GLFW, which then declares its Vulkan functions
//
#include "view/window.h"

#include "base/error.h"
#include "base/file.h"
#include "base/visible_text.h"
#include "cli/last_resort.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <dlfcn.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

namespace reflet {

namespace {

std::string& lastGlfwError() {
    static std::string text;
    return text;
}

Window& windowOf(GLFWwindow* handle) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

// Xlib answers the loss of its display by exit(), which destroys static objects that other threads, of the program and
// of the driver, still use. GLFW does not offer its handler.
void endWithTheDisplay() {
    using Handler = int (*)(void* display);
    void* library = ::dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    void* function = library == nullptr ? nullptr : ::dlsym(library, "XSetIOErrorHandler");
    if (function == nullptr) {
        return;  // another window system
    }
    reinterpret_cast<Handler (*)(Handler)>(function)([](void*) -> int {
        constexpr std::string_view message = "reflet: the display is gone\n";
        removeTemporaryFiles();
        std::fwrite(message.data(), 1, message.size(), stderr);
        ::_exit(exitFailed);
    });
}

// DejaVu Sans, where Debian (fonts-dejavu-core) and other distributions install it.
void addFont(float pixels) {
    const std::array<const char*, 3> files{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                           "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                           "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"};
    static const std::array<ImWchar, 9> letters{0x20, 0xFF, 0x2010, 0x2027, 0x2190, 0x21FF, 0x25A0, 0x25FF, 0};
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    for (const char* file : files) {
        if (std::filesystem::exists(file)) {
            fonts.AddFontFromFileTTF(file, pixels, nullptr, letters.data());
            return;
        }
    }
    ImFontConfig plain;
    plain.SizePixels = std::floor(pixels);
    fonts.AddFontDefault(&plain);
}

// The size, or what of it the screen has room for.
uvec2 withinScreen(uvec2 size) {
    GLFWmonitor* screen = glfwGetPrimaryMonitor();
    if (screen == nullptr) {
        return size;
    }
    std::array<int, 4> free{};  // without bars and docks
    glfwGetMonitorWorkarea(screen, &free[0], &free[1], &free[2], &free[3]);
    vec2 scale(1.0F);
    glfwGetMonitorContentScale(screen, &scale.x, &scale.y);
    constexpr float titleBar = 40.0F;  // desktop units, for what the desktop draws around the window
    const vec2 room = vec2(free[2], free[3]) / glm::max(scale, vec2(1.0F)) - vec2(0.0F, titleBar);
    return room.x < 1.0F || room.y < 1.0F ? size : glm::min(size, uvec2(room));
}

// From ImGui 1.87 on a frame may take only a few of the waiting key presses and clicks: the others need more frames.
bool hasQueuedInput() {
#if IMGUI_VERSION_NUM >= 18700
    return !ImGui::GetCurrentContext()->InputEventsQueue.empty();
#else
    return false;
#endif
}

}  // namespace

Window::Window(const std::string& title, uvec2 size) {
    glfwSetErrorCallback([](int, const char* text) { lastGlfwError() = text; });
    if (glfwInit() == GLFW_FALSE) {
        fail("no window can be opened ({}); `reflet render` needs none", lastGlfwError());
    }
    endWithTheDisplay();
    if (glfwVulkanSupported() == GLFW_FALSE) {
        glfwTerminate();
        fail("Vulkan cannot present to a window here; `reflet render` needs none");
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    size = withinScreen(size);
    window_ = glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), visibleText(title).c_str(), nullptr,
                               nullptr);
    if (window_ == nullptr) {
        glfwTerminate();
        fail("no window can be opened ({}); `reflet render` needs none", lastGlfwError());
    }
    glfwSetWindowUserPointer(window_, this);
    glfwSetDropCallback(window_, [](GLFWwindow* handle, int count, const char** files) {
        Window& self = windowOf(handle);
        self.happened_ = true;
        self.dropped_.assign(files, files + count);
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* handle, double x, double y) {
        Window& self = windowOf(handle);
        self.happened_ = true;
        self.pointer_ = {x, y};
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* handle, int, int action, int) {
        Window& self = windowOf(handle);
        self.countInput();
        if (action == GLFW_PRESS) {
            self.pressedAt_ = self.pointer_;
        }
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* handle, double, double) { windowOf(handle).countInput(); });
    glfwSetCharCallback(window_, [](GLFWwindow* handle, unsigned) { windowOf(handle).happened_ = true; });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* handle, int, int) { windowOf(handle).happened_ = true; });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* handle) { windowOf(handle).happened_ = true; });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* handle, int) { windowOf(handle).happened_ = true; });

    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the viewer saves its state in its own file
    ImGui::StyleColorsDark();
    float across = 1.0F;
    glfwGetWindowContentScale(window_, &scale_, &across);
    // If a desktop unit has several pixels, the desktop scales by itself; glyphs are rasterized at pixel resolution.
    const float pixelsPerUnit = static_cast<float>(pixels().x) / static_cast<float>(std::max(this->size().x, 1U));
    scale_ /= std::max(pixelsPerUnit, 1.0F);
    ImGui::GetStyle().ScaleAllSizes(scale_);
    ImGui::GetStyle().WindowRounding = 0.0F;
    addFont(15.0F * scale_ * pixelsPerUnit);
    ImGui::GetIO().FontGlobalScale = 1.0F / std::max(pixelsPerUnit, 1.0F);
    ImGui_ImplGlfw_InitForVulkan(window_, true);
    glfwSetKeyCallback(window_, [](GLFWwindow* handle, int key, int code, int action, int mods) {
        windowOf(handle).countInput();
        windowOf(handle).takeKey({key, code, action, mods});
    });
}

void Window::countInput() {
    happened_ = true;
    ++inputs_;
}

// Text fields (before ImGui 1.87) poll which keys are down, and would lose a key that is pressed and released between
// two frames: once a key is pressed, releases are deferred until after the next frame.
void Window::takeKey(const KeyEvent& event) {
    if (event.action == GLFW_RELEASE) {
        shortcuts_.erase(event.key);
    } else if ((event.mods & GLFW_MOD_CONTROL) != 0) {
        shortcuts_.insert(event.key);
    }
    if (event.action == GLFW_RELEASE && pressed_) {
        released_.push_back(event);
        return;
    }
    if (event.action == GLFW_PRESS) {
        pressed_ = true;
        if (!ImGui::GetIO().WantTextInput) {
            keys_.push_back({event.key, (event.mods & GLFW_MOD_CONTROL) != 0});
        }
    }
    ImGui_ImplGlfw_KeyCallback(window_, event.key, event.code, event.action, event.mods);
}

Window::~Window() {
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::vector<const char*> Window::vulkanExtensions() {
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr) {
        fail("Vulkan cannot present to windows of this desktop ({}); `reflet render` needs none", lastGlfwError());
    }
    return {names, names + count};
}

VkSurfaceKHR_T* Window::surface(VkInstance_T* instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(instance, window_, nullptr, &surface) != VK_SUCCESS) {
        fail("Vulkan cannot present to this window ({})", lastGlfwError());
    }
    return surface;
}

void Window::waitForEvents(double seconds) {
    if (seconds > 0.0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
}

void Window::wake() {
    glfwPostEmptyEvent();
}

bool Window::takeEvents() {
    return std::exchange(happened_, false);
}

std::vector<KeyPress> Window::takeKeys() {
    return std::exchange(keys_, {});
}

std::vector<std::string> Window::takeDroppedFiles() {
    return std::exchange(dropped_, {});
}

bool Window::isHeld(int key) const {
    return !ImGui::GetIO().WantTextInput && !shortcuts_.contains(key) && glfwGetKey(window_, key) == GLFW_PRESS;
}

bool Window::closing() const {
    return glfwWindowShouldClose(window_) != 0;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::hide() {
    glfwHideWindow(window_);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_, visibleText(title).c_str());
}

void Window::copyText(const std::string& text) {
    glfwSetClipboardString(window_, text.c_str());
}

uvec2 Window::pixels() const {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {width, height};
}

uvec2 Window::size() const {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window_, &width, &height);
    return {width, height};
}

std::span<const uint8_t> Window::font(uvec2& size) {
    unsigned char* texels = nullptr;
    int width = 0;
    int height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&texels, &width, &height);
    size = {width, height};
    return {texels, size_t(width) * size_t(height) * 4};
}

void Window::beginUi() {
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    if (hasQueuedInput()) {
        happened_ = true;
        wake();
    }
}

const ImDrawData& Window::endUi() {
    ImGui::Render();
    pressed_ = false;
    for (const KeyEvent& event : std::exchange(released_, {})) {
        happened_ = true;
        takeKey(event);
    }
    return *ImGui::GetDrawData();
}

}  // namespace reflet
