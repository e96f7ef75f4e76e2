// The viewer's main loop: events, user interface, frame, window; idle while nothing changes.
#include "view/viewer.h"

#include "base/error.h"
#include "base/file.h"
#include "base/interrupt.h"
#include "cli/device_options.h"
#include "gpu/pipeline.h"
#include "renderer/presets.h"
#include "view/saved_state.h"
#include "view/status.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <charconv>
#include <thread>
#include <tuple>

namespace reflet {

namespace {

// Seconds.
constexpr double idleWait = 0.25;
constexpr double movesFor = 0.3;     // after the last change
constexpr double playsEvery = 0.04;  // redraws while animations play
constexpr double drawEvery = 0.025;
constexpr double drawMovingEvery = 0.045;  // on a CPU, which also renders: leaves more for the image

// The state given by the command line, with the window's last size.
ViewerState initialState(const ViewerOptions& options) {
    ViewerState state;
    state.source = options.scene;
    state.preset = options.scene.preset.empty() ? std::string(defaultPreset) : options.scene.preset;
    applyPreset(state.ofPreset, state.preset);
    state.settings = loadSettings(options.scene);
    if (!options.fresh) {
        try {
            restoreState(state, {.view = false, .settings = false});
        } catch (const Error&) {  // open() reports it
        }
    }
    if (state.window == uvec2(0)) {
        state.window = parseSize(options.scene.size) + uvec2(static_cast<uint32_t>(state.panelWidth), 0);
    }
    return state;
}

// Of the device that renders.
gpu::DeviceOptions deviceOptions(const ViewerOptions& options, std::atomic<size_t>& messages) {
    gpu::DeviceOptions device = programDevice(options.device, options.validate);
    device.onMessage = [&messages](const std::string& message) {
        ++messages;
        printWarning(message);
    };
    device.onCompile = {};  // the window tells
    device.windowExtensions = Window::vulkanExtensions();
    return device;
}

// Of the device that draws the window, with a handful of shaders.
gpu::DeviceOptions windowDeviceOptions(const ViewerOptions& options, std::atomic<size_t>& messages) {
    gpu::DeviceOptions device = deviceOptions(options, messages);
    device.pipelineFolder.clear();
    return device;
}

uvec2 parsePixel(const std::string& text) {
    uvec2 pixel(0);
    const char* end = text.data() + text.size();
    const auto x = std::from_chars(text.data(), end, pixel.x);
    if (x.ec == std::errc() && x.ptr != end && *x.ptr == ',') {
        const auto y = std::from_chars(x.ptr + 1, end, pixel.y);
        if (y.ec == std::errc() && y.ptr == end) {
            return pixel;
        }
    }
    failUsage("--pick must be X,Y in pixels from the image's upper left, is '{}'", text);
}

}  // namespace

Viewer::Viewer(const ViewerOptions& options) : Viewer(options, initialState(options)) {}

Viewer::Viewer(const ViewerOptions& options, const ViewerState& first)
    : options_(options),
      window_("Reflet", first.window),
      render_(deviceOptions(options, messages_), options.shaders.empty() ? REFLET_SHADER_SOURCES : options.shaders),
      device_(windowDeviceOptions(options, messages_)),
      presenter_(device_, window_.surface(device_.instance())),
      work_(first, window_, device_.limits().maxImageDimension2D),
      saver_(work_, window_),
      opener_(work_, render_, saver_, [this] { forgetScene(); }),
      pixel_(work_, render_),
      actions_(work_, render_, window_),
      input_(work_, window_, actions_, pixel_),
      panels_(work_, {window_, render_, actions_, opener_, pixel_, compare_, times_}),
      overlay_(work_, window_, compare_, pixel_) {
    if (!options.pick.empty()) {
        toPick_ = parsePixel(options.pick);
    }
    uvec2 fontSize(0);
    const std::span<const uint8_t> font = Window::font(fontSize);
    canvas_ = std::make_unique<Canvas>(device_, fontSize, font, presenter_.isSwapped());
    opener_.open(options.scene, !options.fresh);
}

Viewer::~Viewer() = default;

// What belongs to the scene before the open one.
void Viewer::forgetScene() {
    compare_.forget();
    seen_.reset();
    pixel_.forget();
    window_.setTitle(fmt::format("Reflet: {}", work_.state.source.scene));
}

double Viewer::timeToWait() const {
    if (work_.redraws() > 0) {
        return 0.0;
    }
    if (work_.isPlaying()) {
        return playsEvery;
    }
    return moving_ ? movesFor : idleWait;
}

bool Viewer::atRest() const {
    const RenderedImage& shown = work_.live();
    return work_.opened.scene && render_.rests() && published_ == render_.published() && !moving_ &&
           work_.redraws() == 0 && shown.frames >= shown.framesToConverge;
}

// Carries out --pick and --window-picture once the image has converged.
void Viewer::finishPicture() {
    if (!atRest()) {
        return;
    }
    if (toPick_) {
        const uvec2 pixel = glm::min(*toPick_, work_.renderSize() - 1U);
        toPick_.reset();
        pixel_.openPanel();
        pixel_.pick(pixel, false);
    } else if (!pixel_.update() && !options_.windowPicture.empty()) {
        if (work_.live().rendered == 0) {
            fail("{}", work_.live().problem);
        }
        writePng(options_.windowPicture, canvas_->picture());
        window_.close();
    }
}

// What the thread has published since the last call.
void Viewer::takeFrames() {
    const uint64_t published = render_.published();
    if (published == published_) {
        return;
    }
    published_ = published;
    const std::shared_ptr<const RenderedImage> before = work_.published.live;
    const uint32_t reloads = work_.published.reloads;
    const std::string shaderProblem = work_.published.shaderProblem;
    work_.published = render_.state();
    if (!work_.published.live || work_.published.scene != work_.sceneNumber) {
        work_.published.live = before;
        work_.published.right = nullptr;
    }
    if (work_.live().rendered != before->rendered) {
        times_.note(work_.live());
    }
    if (work_.published.reloads != reloads) {
        compare_.forget();
        work_.tell(fmt::format("Recompiled: {}", fmt::join(work_.published.reloaded, ", ")));
    }
    if (work_.published.shaderProblem == shaderProblem) {
        work_.redraw(1);
    } else {
        work_.redrawUntilSettled();
    }
}

void Viewer::takeFinished() {
    for (const RenderThread::Finish& finish : render_.takeFinished()) {
        if (work_.opened.scene) {
            work_.attempt(finish);
        } else {
            finish();  // without a scene there is nothing to go on with
        }
    }
}

// Tells the thread what is to be rendered.
void Viewer::want() {
    const uvec2 size = work_.renderSize();
    const bool changed = seen_ && (!(seen_->view == work_.state.view) || seen_->size != size ||
                                   !sameSettings(seen_->settings, work_.state.settings));
    if (changed) {
        lastChange_ = Clock::now();
    }
    if (changed || !seen_) {
        seen_ = Seen{work_.state.view, work_.state.settings, size};
    }
    moving_ = secondsSince(lastChange_) < movesFor || work_.isPlaying();
    render_.want({.scene = work_.sceneNumber,
                  .state = work_.state,
                  .size = window_.pixels().x == 0 ? uvec2(0) : size,
                  .moving = moving_,
                  .values = CompareView::wantsValues(work_.state),
                  .steps = work_.steps,
                  .right = CompareView::rendered(work_.state)});
}

void Viewer::present() {
    const PictureRect rect = work_.pictureRect();
    const uvec2 pixels = window_.pixels();
    const vec2 perUnit = vec2(pixels) / glm::max(vec2(window_.size()), vec2(1.0F));
    Layout layout{pixels, rect.min * perUnit, rect.size * perUnit};
    const bool compares = work_.state.compare.with != CompareWith::nothing && compare_.picture();
    if (compares) {
        layout.divider = layout.corner.x + work_.state.compare.divider * layout.extent.x;
    }
    layout.linear = work_.published.effort.isReduced();
    const gpu::Image window =
        canvas_->draw(work_.live().picture, compares ? compare_.picture() : nullptr, layout, window_.endUi());
    if (!presenter_.present(window, pixels)) {
        work_.redrawUntilSettled();
    }
    ++drawn_;
}

// Draws only that the scene is being opened: everything else needs it.
void Viewer::waitForScene() {
    for (const KeyPress& press : window_.takeKeys()) {
        if (press.control && press.key == GLFW_KEY_Q) {
            window_.close();
        }
    }
    window_.beginUi();
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::Begin("Opening", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::TextUnformatted(render_.busyWith().c_str());
    ImGui::End();
    present();
}

void Viewer::writeStatus() const {
    if (!options_.status.empty()) {
        const WindowStatus status{.work = work_,
                                  .compare = compare_,
                                  .picked = pixel_.picked(),
                                  .window = window_.size(),
                                  .pointer = window_.pointer(),
                                  .inputs = window_.inputs(),
                                  .busyWith = render_.busyWith(),
                                  .drawn = drawn_,
                                  .moving = moving_,
                                  .atRest = atRest()};
        writeFileAtomically(options_.status, statusText(status), Lasting::no);
    }
}

void Viewer::drawWindow() {
    work_.noteRedraw();
    window_.beginUi();
    input_.handlePointer();
    input_.handleKeys();  // after the pointer, so that a screenshot has the current view
    input_.fly(elapsed_);
    if (work_.isPlaying()) {
        work_.state.view.time = std::min(work_.state.view.time + elapsed_, View::largestTime);
    }
    work_.places.clear();
    if (work_.state.panels) {
        panels_.draw();
    }
    panels_.drawBrowser();
    overlay_.draw();
    want();
    present();
    writeStatus();
    finishPicture();
}

// Returns whether anything has changed that is drawn.
bool Viewer::updateComparison() {
    const auto shown = [&] {
        return std::tuple(compare_.message(), compare_.samples(), compare_.progress(),
                          compare_.error() ? compare_.error()->flip : -1.0, compare_.picture());
    };
    const auto before = shown();
    compare_.update({.state = work_.state,
                     .opened = work_.opened,
                     .live = work_.live(),
                     .right = work_.published.right.get(),
                     .size = work_.renderSize(),
                     .mayTrace = work_.state.running != Running::paused && !moving_});
    return shown() != before;
}

void Viewer::waitForEvents() {
    Window::waitForEvents(timeToWait());
    const bool sharesCpu = device_.description().kind == "CPU";
    const double pause = moving_ ? drawMovingEvery : drawEvery;
    if (const double early = pause - secondsSince(lastDraw_); sharesCpu && early > 0.0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(early));
        Window::waitForEvents(0.0);
    }
    elapsed_ = secondsSince(lastLoop_);
    lastLoop_ = Clock::now();
    if (window_.takeEvents()) {
        work_.redrawUntilSettled();
    }
}

// Of the open scene.
void Viewer::update() {
    for (const std::string& file : window_.takeDroppedFiles()) {
        work_.attempt([&] { opener_.openFile(file); });
    }
    takeFrames();
    const bool hasChanged = updateComparison();
    if (moving_ && secondsSince(lastChange_) >= movesFor) {
        work_.redraw(1);  // it comes to rest
    }
    if (work_.redraws() == 0 && !work_.isPlaying() && !hasChanged && !wasBusy_) {
        return;
    }
    drawWindow();
    wasBusy_ = !render_.busyWith().empty();
    lastDraw_ = Clock::now();
    saver_.saveIfDue();
}

void Viewer::loop() {
    lastLoop_ = Clock::now();
    while (!window_.closing() && !InterruptNote::arrived()) {
        waitForEvents();
        takeFinished();
        if (window_.pixels().x == 0 || window_.pixels().y == 0) {  // minimised
            work_.forgetRedraws();
            want();
        } else if (!work_.opened.scene) {
            waitForScene();
        } else {
            update();
        }
    }
}

}  // namespace reflet
