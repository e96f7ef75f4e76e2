// The viewer's main loop: events, user interface, frame, window; idle while nothing changes.
#include "view/viewer.h"

#include "base/error.h"
#include "base/file.h"
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

namespace reflet {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double idleWait = 0.25;   // seconds between checks of the shader files
constexpr double watchEvery = 0.5;  // seconds
constexpr double saveEvery = 2.0;   // seconds
constexpr int settlingRedraws = 3;
constexpr size_t keptFrameTimes = 160;

double secondsSince(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

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

gpu::DeviceOptions deviceOptions(const ViewerOptions& options) {
    return {.select = options.device,
            .validation = options.validate,
            .onMessage = printWarning,
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

bool givesView(const SceneOptions& source) {
    return !source.camera.empty() || !source.viewFile.empty() || !source.environment.empty() ||
           !source.background.empty() || source.time.has_value();
}

bool givesSettings(const SceneOptions& source) {
    return !source.preset.empty() || !source.settingsFiles.empty() || !source.set.empty();
}

}  // namespace

Viewer::Viewer(const ViewerOptions& options)
    : options_(options),
      state_(initialState(options)),
      window_("Reflet", state_.window),
      device_(deviceOptions(options)),
      presenter_(device_, window_.surface(device_.instance())),
      compare_(device_),
      shaders_(device_.shaders(), options.shaders.empty() ? REFLET_SHADER_SOURCES : options.shaders) {
    if (!options.pick.empty()) {
        toPick_ = parsePixel(options.pick);
    }
    uvec2 fontSize(0);
    const std::span<const uint8_t> font = Window::font(fontSize);
    canvas_ = std::make_unique<Canvas>(device_, fontSize, font);
    open(options.scene, !options.fresh);
}

Viewer::~Viewer() = default;

void Viewer::open(const SceneOptions& source, bool restores) {
    ViewerState next = state_;
    next.source = source;
    auto session = std::make_unique<Session>(device_, next);
    if (restores) {
        try {
            ViewerState restored = next;
            restoreState(restored, {.view = !givesView(source), .settings = !givesSettings(source)});
            checkFocus(restored.view.camera, session->scene(), "camera.focus of the saved state");
            next = restored;
        } catch (const Error& error) {
            printWarning(fmt::format("{}; the scene opens without its saved state", error.what()));
        }
    }
    if (session_) {
        save();
    }
    next.window = state_.window;
    state_ = next;
    session_ = std::move(session);
    compare_.forget();
    picked_.reset();
    window_.setTitle(fmt::format("Reflet: {}", source.scene));
}

void Viewer::openFile(const std::string& file) {
    const fs::path path = fs::absolute(file);
    const std::string extension = path.extension().string();
    if (extension == ".exr") {
        state_.compare.with = CompareWith::file;
        state_.compare.file = path.string();
        tell(fmt::format("{}: shown on the right side", path.filename().string()));
    } else if (extension == ".hdr") {
        applyViewJson({{"environment", {{"image", path.string()}}}}, path, state_.view);
        tell(fmt::format("{}: used as environment", path.filename().string()));
    } else if (extension == ".json") {
        const nlohmann::json json = parseJsonFile(path);
        const std::array<const char*, 6> viewKeys{"camera", "sun", "lamps", "time", "probes", "background"};
        const bool isView = std::ranges::any_of(viewKeys, [&](const char* key) { return json.contains(key); }) ||
                            (json.contains("environment") &&
                             (json["environment"].is_string() || json["environment"].contains("radiance") ||
                              json["environment"].contains("image")));
        if (isView) {
            View changed = state_.view;
            applyViewJson(json, path, changed);
            checkFocus(changed.camera, session_->scene(), path.string() + ": camera.focus");
            state_.view = changed;
        } else {
            Settings changed = state_.settings;
            applySettingsJson(changed, json, path.string());
            state_.settings = changed;
        }
        tell(fmt::format("{}: {} loaded", path.filename().string(), isView ? "view" : "settings"));
    } else {
        SceneOptions source;
        source.scene = file.starts_with("builtin:") ? file : path.string();
        source.size = state_.source.size;
        source.strict = state_.source.strict;
        open(source, true);
        tell(fmt::format("{}: opened", source.scene));
    }
}

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

// Also true if the values of the converged image are needed but were not kept.
bool Viewer::wantsLiveFrame() const {
    const bool lacksValues =
        CompareView::wantsValues(state_) && !session_->shownValues() && session_->showProblem().empty();
    return stepsOnce_ || lacksValues || session_->wantsFrame(state_, renderSize());
}

bool Viewer::wantsFrame() const {
    switch (state_.running) {
        case Running::paused:
            return stepsOnce_;
        case Running::continuous:
            return true;
        default:
            return wantsLiveFrame() || compare_.wantsFrame(state_, renderSize());
    }
}

// Seconds until the frame rate limit allows another frame.
double Viewer::timeToFrame() const {
    return state_.mostFrames > 0.0F ? std::max(1.0 / double(state_.mostFrames) - secondsSince(lastFrame_), 0.0) : 0.0;
}

double Viewer::timeToWait() const {
    if (redraws_ > 0) {
        return 0.0;
    }
    if (window_.pixels().x == 0 || !wantsFrame()) {
        return idleWait;
    }
    return timeToFrame();
}

bool Viewer::atRest() const {
    return session_->frames() >= session_->framesToConverge(state_) && redraws_ == 0 &&
           !session_->wantsFrame(state_, renderSize()) && !compare_.wantsFrame(state_, renderSize());
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
        attempt([&] { pickPixel(pixel); });
    } else if (picked_ && picked_->change != session_->changes() && isPickedView()) {
        attempt([&] { pickPixel(picked_->pixel); });
    } else if (!options_.windowPicture.empty()) {
        writePng(options_.windowPicture, canvas_->picture());
        window_.close();
    }
}

void Viewer::renderScene() {
    const uvec2 size = renderSize();
    if (state_.plays) {
        state_.view.time = std::min(state_.view.time + elapsed_, View::largestTime);
    }
    if (state_.running == Running::continuous || wantsLiveFrame()) {
        session_->render(state_, size, CompareView::wantsValues(state_));
        noteTimes();
        ++rendered_;
    }
    lastFrame_ = Clock::now();
    stepsOnce_ = false;
}

void Viewer::noteTimes() {
    constexpr float weight = 0.1F;
    for (const gpu::PassTime& pass : session_->frame().passTimes()) {
        const auto known = std::ranges::find(passes_, pass.name, &PassHistory::name);
        const auto ms = static_cast<float>(pass.ms);
        if (known == passes_.end()) {
            passes_.push_back({pass.name, ms, rendered_});
        } else {
            known->mean = known->lastFrame + 1 == rendered_ ? glm::mix(known->mean, ms, weight) : ms;
            known->lastFrame = rendered_;
        }
    }
    std::erase_if(passes_, [&](const PassHistory& pass) { return pass.lastFrame != rendered_; });
    frameTimes_.push_back(static_cast<float>(session_->frame().submittedMs()));
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
    const gpu::Image window =
        canvas_->draw(session_->picture(), compares ? compare_.picture() : gpu::Image{}, layout, window_.endUi());
    if (!presenter_.present(window, pixels)) {
        redraws_ = settlingRedraws;
    }
    ++drawn_;
}

void Viewer::watchShaders() {
    if (!shaders_.watches() || secondsSince(lastWatch_) < watchEvery) {
        return;
    }
    lastWatch_ = Clock::now();
    const std::string before = shaders_.problem();
    if (shaders_.update()) {
        device_.pipelines().clear();
        session_->resetHistory();
        compare_.forget();
        tell(fmt::format("Recompiled: {}", fmt::join(shaders_.replaced(), ", ")));
        redraws_ = settlingRedraws;
    }
    if (shaders_.problem() != before) {
        redraws_ = settlingRedraws;
    }
}

void Viewer::attempt(const std::function<void()>& work) {
    try {
        work();
        problem_.clear();
    } catch (const Error& error) {
        problem_ = error.what();
    } catch (const std::bad_alloc&) {
        problem_ = "not enough memory";
    }
    redraws_ = settlingRedraws;
}

void Viewer::save() {
    if (window_.size().x > 0) {
        state_.window = window_.size();
    }
    lastSave_ = Clock::now();
    const std::string text = stateText(state_);
    if (text == saved_) {
        return;
    }
    const fs::path file = stateFile(state_.source.scene);
    std::error_code ignored;  // writing the file reports it better
    fs::create_directories(file.parent_path(), ignored);
    saved_ = text;
    try {
        writeFileAtomically(file, text);
    } catch (const Error& error) {
        tell(fmt::format("The state cannot be saved: {}", error.what()));
        if (!warnedOfSaving_) {
            printWarning(notice_);
        }
        warnedOfSaving_ = true;
    }
}

void Viewer::loop() {
    const InterruptNote note;
    lastLoop_ = Clock::now();
    while (!window_.closing() && !InterruptNote::arrived()) {
        Window::waitForEvents(timeToWait());
        elapsed_ = secondsSince(lastLoop_);
        lastLoop_ = Clock::now();
        if (window_.takeEvents()) {
            redraws_ = settlingRedraws;
        }
        for (const std::string& file : window_.takeDroppedFiles()) {
            attempt([&] { openFile(file); });
        }
        watchShaders();
        if (window_.pixels().x == 0 || window_.pixels().y == 0) {  // minimised
            redraws_ = 0;
            continue;
        }
        const auto shown = [&] {
            return std::tuple(compare_.message(), compare_.samples(), compare_.progress(),
                              compare_.error() ? compare_.error()->flip : -1.0, compare_.picture().view);
        };
        const auto before = shown();
        const bool mayRender = state_.running != Running::paused || stepsOnce_;
        compare_.update(state_, *session_, renderSize(), mayRender);
        const bool renders = wantsFrame() && timeToFrame() <= 0.0;
        if (!renders && redraws_ == 0 && shown() == before) {
            continue;
        }
        redraws_ = std::max(redraws_ - 1, 0);
        window_.beginUi();
        handlePointer();
        handleKeys();  // after the pointer, so that a screenshot has the current view
        flyByKeys();
        drawUi();
        if (wantsFrame() && timeToFrame() <= 0.0) {
            renderScene();
        }
        present();
        writeStatus();
        finishPicture();
        if (secondsSince(lastSave_) > saveEvery) {  // so that little is lost if the display goes away
            save();
        }
    }
}

void Viewer::run() {
    try {
        loop();
    } catch (...) {
        save();
        throw;
    }
    save();
    if (options_.validate && !device_.validationMessages().empty()) {
        fail("the validation layers reported {} messages", device_.validationMessages().size());
    }
}

}  // namespace reflet
