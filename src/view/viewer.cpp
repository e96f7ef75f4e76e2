// The viewer's main loop: events, user interface, frame, window; idle while nothing changes.
#include "view/viewer.h"

#include "base/error.h"
#include "base/interrupt.h"
#include "base/json.h"
#include "cli/device_options.h"
#include "gpu/pipeline.h"
#include "renderer/presets.h"
#include "renderer/shaders.h"
#include "scene/focus.h"
#include "scene/view_file.h"
#include "view/saved_state.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <thread>
#include <tuple>

namespace reflet {

namespace {

// Seconds.
constexpr double idleWait = 0.25;
constexpr double movesFor = 0.3;     // after the last change
constexpr double playsEvery = 0.04;  // redraws while animations play
constexpr double drawEvery = 0.025;
constexpr double drawMovingEvery = 0.045;  // leaves more for the image  // on a CPU, which also renders
constexpr double saveEvery = 2.0;
constexpr int settlingRedraws = 3;
constexpr size_t keptFrameTimes = 160;

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

gpu::DeviceOptions deviceOptions(const ViewerOptions& options, std::atomic<size_t>& messages) {
    return {.select = options.device,
            .validation = options.validate,
            .onMessage =
                [&messages](const std::string& message) {
                    ++messages;
                    printWarning(message);
                },
            .shaders = {effectShaders(), rendererShaders()},
            .windowExtensions = Window::vulkanExtensions()};
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

Viewer::Viewer(const ViewerOptions& options)
    : options_(options),
      state_(initialState(options)),
      window_("Reflet", state_.window),
      render_(deviceOptions(options, messages_), options.shaders.empty() ? REFLET_SHADER_SOURCES : options.shaders),
      device_(deviceOptions(options, messages_)),
      presenter_(device_, window_.surface(device_.instance())) {
    now_.live = std::make_shared<const Shown>();
    if (!options.pick.empty()) {
        toPick_ = parsePixel(options.pick);
    }
    uvec2 fontSize(0);
    const std::span<const uint8_t> font = Window::font(fontSize);
    canvas_ = std::make_unique<Canvas>(device_, fontSize, font, presenter_.isSwapped());
    open(options.scene, !options.fresh);
}

Viewer::~Viewer() = default;

Viewer::PictureRect Viewer::pictureRect() const {
    const vec2 window(window_.size());
    const float left = state_.panels ? std::min(state_.panelWidth * window_.scale(), 0.8F * window.x) : 0.0F;
    return {{left, 0.0F}, glm::max(window - vec2(left, 0.0F), vec2(1.0F))};
}

uvec2 Viewer::renderSize() const {
    const vec2 perUnit = vec2(window_.pixels()) / glm::max(vec2(window_.size()), vec2(1.0F));
    const vec2 size = pictureRect().size * perUnit * state_.scale;
    return glm::clamp(uvec2(glm::round(size)), uvec2(16), uvec2(device_.limits().maxImageDimension2D));
}

double Viewer::timeToWait() const {
    if (redraws_ > 0) {
        return 0.0;
    }
    if (state_.plays && state_.running != Running::paused) {
        return playsEvery;
    }
    return moving_ ? movesFor : idleWait;
}

bool Viewer::atRest() const {
    const Shown& shown = *now_.live;
    return opened_.scene && render_.rests() && published_ == render_.published() && !moving_ && redraws_ == 0 &&
           shown.frames >= shown.framesToConverge;
}

// Carries out --pick and --window-picture once the image has converged.
void Viewer::finishPicture() {
    if (!atRest()) {
        return;
    }
    if (toPick_) {
        const uvec2 pixel = glm::min(*toPick_, renderSize() - 1U);
        toPick_.reset();
        opensPixel_ = true;
        pickPixel(pixel, false);
    } else if (picked_ && picked_->change != now_.live->changes && isPickedView()) {
        pickPixel(picked_->pixel, false);
    } else if (!options_.windowPicture.empty()) {
        if (now_.live->rendered == 0) {
            fail("{}", now_.live->problem);
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
    const std::shared_ptr<const Shown> before = now_.live;
    const uint32_t reloads = now_.reloads;
    const std::string shaderProblem = now_.shaderProblem;
    now_ = render_.state();
    if (!now_.live || now_.scene != scene_) {
        now_.live = before;
        now_.right = nullptr;
    }
    if (now_.live->rendered != before->rendered) {
        noteTimes();
    }
    if (now_.reloads != reloads) {
        compare_.forget();
        tell(fmt::format("Recompiled: {}", fmt::join(now_.reloaded, ", ")));
    }
    redraws_ = std::max(redraws_, now_.shaderProblem == shaderProblem ? 1 : settlingRedraws);
}

void Viewer::takeFinished() {
    for (const RenderThread::Finish& finish : render_.takeFinished()) {
        if (opened_.scene) {
            attempt(finish);
        } else {
            finish();  // without a scene there is nothing to go on with
        }
    }
}

// Tells the thread what is to be rendered.
void Viewer::want() {
    const uvec2 size = renderSize();
    const bool changed = seen_ && (!(seen_->view == state_.view) || seen_->size != size ||
                                   !sameSettings(seen_->settings, state_.settings));
    if (changed) {
        lastChange_ = Clock::now();
    }
    if (changed || !seen_) {
        seen_ = Seen{state_.view, state_.settings, size};
    }
    moving_ = secondsSince(lastChange_) < movesFor || (state_.plays && state_.running != Running::paused);
    render_.want({.scene = scene_,
                  .state = state_,
                  .size = window_.pixels().x == 0 ? uvec2(0) : size,
                  .moving = moving_,
                  .values = CompareView::wantsValues(state_),
                  .steps = steps_,
                  .right = CompareView::rendered(state_)});
}

void Viewer::noteTimes() {
    constexpr float weight = 0.1F;
    const uint64_t rendered = now_.live->rendered;
    for (const gpu::PassTime& pass : now_.live->passes) {
        const auto known = std::ranges::find(passes_, pass.name, &PassHistory::name);
        const auto ms = static_cast<float>(pass.ms);
        if (known == passes_.end()) {
            passes_.push_back({pass.name, ms, rendered});
        } else {
            known->mean = known->lastFrame + 1 == rendered ? glm::mix(known->mean, ms, weight) : ms;
            known->lastFrame = rendered;
        }
    }
    std::erase_if(passes_, [&](const PassHistory& pass) { return pass.lastFrame != rendered; });
    frameTimes_.push_back(static_cast<float>(now_.live->milliseconds));
    if (frameTimes_.size() > keptFrameTimes) {
        frameTimes_.pop_front();
    }
}

void Viewer::present() {
    const PictureRect rect = pictureRect();
    const uvec2 pixels = window_.pixels();
    const vec2 perUnit = vec2(pixels) / glm::max(vec2(window_.size()), vec2(1.0F));
    Layout layout{pixels, rect.min * perUnit, rect.size * perUnit};
    const bool compares = state_.compare.with != CompareWith::nothing && compare_.picture();
    if (compares) {
        layout.divider = layout.corner.x + state_.compare.divider * layout.extent.x;
    }
    layout.linear = now_.effort.isReduced();
    const gpu::Image window =
        canvas_->draw(now_.live->picture, compares ? compare_.picture() : nullptr, layout, window_.endUi());
    if (!presenter_.present(window, pixels)) {
        redraws_ = settlingRedraws;
    }
    ++drawn_;
}

void Viewer::attempt(const std::function<void()>& work) {
    try {
        work();
        problem_.clear();
    } catch (const std::runtime_error& error) {  // std::filesystem throws others than Error
        problem_ = error.what();
    } catch (const std::bad_alloc&) {
        problem_ = "not enough memory";
    }
    redraws_ = settlingRedraws;
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

void Viewer::drawWindow() {
    redraws_ = std::max(redraws_ - 1, 0);
    window_.beginUi();
    handlePointer();
    handleKeys();  // after the pointer, so that a screenshot has the current view
    flyByKeys();
    if (state_.plays && state_.running != Running::paused) {
        state_.view.time = std::min(state_.view.time + elapsed_, View::largestTime);
    }
    drawUi();
    want();
    present();
    writeStatus();
    finishPicture();
}

void Viewer::loop() {
    const bool sharesCpu = device_.description().kind == "CPU";
    lastLoop_ = Clock::now();
    while (!window_.closing() && !InterruptNote::arrived()) {
        Window::waitForEvents(timeToWait());
        const double pause = moving_ ? drawMovingEvery : drawEvery;
        if (const double early = pause - secondsSince(lastDraw_); sharesCpu && early > 0.0) {
            std::this_thread::sleep_for(std::chrono::duration<double>(early));
            Window::waitForEvents(0.0);
        }
        elapsed_ = secondsSince(lastLoop_);
        lastLoop_ = Clock::now();
        if (window_.takeEvents()) {
            redraws_ = settlingRedraws;
        }
        takeFinished();
        if (window_.pixels().x == 0 || window_.pixels().y == 0) {  // minimised
            redraws_ = 0;
            want();
            continue;
        }
        if (!opened_.scene) {
            waitForScene();
            continue;
        }
        for (const std::string& file : window_.takeDroppedFiles()) {
            attempt([&] { openFile(file); });
        }
        takeFrames();
        const auto shown = [&] {
            return std::tuple(compare_.message(), compare_.samples(), compare_.progress(),
                              compare_.error() ? compare_.error()->flip : -1.0, compare_.picture());
        };
        const auto before = shown();
        compare_.update({.state = state_,
                         .opened = opened_,
                         .live = *now_.live,
                         .right = now_.right.get(),
                         .size = renderSize(),
                         .mayTrace = state_.running != Running::paused && !moving_});
        const bool plays = state_.plays && state_.running != Running::paused;
        if (moving_ && secondsSince(lastChange_) >= movesFor) {
            redraws_ = std::max(redraws_, 1);  // it comes to rest
        }
        if (redraws_ == 0 && !plays && shown() == before && !wasBusy_) {
            continue;
        }
        drawWindow();
        wasBusy_ = !render_.busyWith().empty();
        lastDraw_ = Clock::now();
        if (secondsSince(lastSave_) > saveEvery) {  // so that little is lost if the display goes away
            save();
        }
    }
}

}  // namespace reflet
