// Renders an open scene.
#include "view/session.h"

#include "base/error.h"
#include "capture/pictures.h"
#include "compare/heat_map.h"
#include "device/upload.h"
#include "effects/exposure/exposure.h"
#include "effects/tonemap/tone_map_image.h"
#include "renderer/history.h"
#include "scene/pose.h"
#include "scene/view_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet {

namespace {

constexpr uint32_t meanSettledAfter = 1024;  // accumulate

uint32_t framesFor(const Settings& settings, const Scene& scene) {
    const HistoryUse use = historyUse(settings, scene);
    const uint32_t exposed = use.exposure ? exposureFrames : 1;
    return use.accumulate ? meanSettledAfter : std::max(framesToSettle(use, settings), exposed);
}

bool isMade(const Show& show, const FrameImages& images) {
    const std::vector<gpu::Image> needed = show.images(images);
    return std::ranges::all_of(needed, [](const gpu::Image& i) { return bool(i); });
}

bool needsValues(const ViewerState& state) {
    return state.falseColor || findShow(state.show).picture != nullptr;
}

}  // namespace

Settings renderedSettings(const ViewerState& state) {
    Settings settings = state.settings;
    Pictures(state.show, {}).prepare(settings);
    return settings;
}

Bitmap shownPicture(const ViewerState& state, const TonemapSettings& tonemap, const FloatImage& values) {
    const Show& show = findShow(state.show);
    if (state.falseColor) {
        FloatImage first{values.width, values.height, {"Y"}, {}};
        const float range = std::max(state.high - state.low, 1e-12F);
        for (size_t i = 0; i < values.data.size(); i += values.channels.size()) {
            first.data.push_back((values.data[i] - state.low) / range);
        }
        return heatMap(first);
    }
    return show.picture == nullptr ? toneMapped(values, tonemap) : makePicture(show, values);
}

gpu::Texture uploadPicture(gpu::Device& device, const Bitmap& bitmap, const std::string& name) {
    std::vector<uint8_t> rgba;
    rgba.reserve(size_t(bitmap.width) * bitmap.height * 4);
    for (size_t i = 0; i < bitmap.data.size(); i += bitmap.channels) {
        rgba.insert(rgba.end(), {bitmap.data[i], bitmap.data[i + 1], bitmap.data[i + 2], 255});
    }
    return gpu::uploadTexture(device, {bitmap.width, bitmap.height}, rgba, false, false, name);
}

Session::Session(gpu::Device& device, ViewerState& state)
    : device_(device),
      scene_(std::make_shared<const Scene>(loadScene(state.source))),
      firstView_(loadView(state.source, *scene_)),
      renderer_(device, *scene_, printWarning) {
    state.view = firstView_;
}

Session::Session(gpu::Device& device, const Session& other)
    : device_(device), scene_(other.scene_), firstView_(other.firstView_), renderer_(device, *scene_, printWarning) {}

uint32_t Session::framesToConverge(const ViewerState& state) const {
    return framesFor(renderedSettings(state), *scene_);
}

bool Session::wantsFrame(const ViewerState& state, uvec2 size) const {
    if (!asked_ || state.plays) {
        return true;
    }
    const Settings settings = renderedSettings(state);
    return !(asked_->view == state.view) || asked_->size != size || !sameSettings(asked_->settings, settings) ||
           frames_ < framesFor(settings, *scene_);
}

FrameImages Session::renderFrame(const ViewerState& state, const View& view, uvec2 size, const Settings& settings,
                                 const std::function<void(gpu::Frame&, const FrameImages&)>& after) {
    params_ = makeViewParams(posed(view, *scene_).camera, size, 0, state.source.seed);
    size_ = size;
    return renderer_.render(view, size, state.source.seed, settings, after);
}

void Session::render(const ViewerState& state, uvec2 size, bool keepValues) {
    const Settings settings = renderedSettings(state);
    if (!asked_ || !(asked_->view == state.view) || asked_->size != size || !sameSettings(asked_->settings, settings)) {
        asked_ = Asked{state.view, settings, size};
        ++changes_;
        frames_ = 0;
    }
    const Show& show = findShow(state.show);
    const bool values = keepValues || needsValues(state);
    std::optional<ShowReadback> readback;
    std::optional<gpu::Readback> exposure;
    problem_.clear();
    const FrameImages images =
        renderFrame(state, state.view, size, settings, [&](gpu::Frame& f, const FrameImages& made) {
            if (!isMade(show, made)) {
                problem_ = fmt::format("Image '{}' is not available with this scene and these settings: {}.", show.name,
                                       show.description);
            } else if (values) {
                readback = requestShow(f, made, show);
            }
            exposure = made.exposure ? std::optional(f.readback(made.exposure)) : std::nullopt;
        });
    exposure_ = exposure ? std::optional(exposureOf(frame(), *exposure)) : std::nullopt;
    ++frames_;
    values_ = readback ? std::make_shared<const FloatImage>(fetchValues(frame(), *readback, params_)) : nullptr;
    picture_ = problem_.empty() ? images.display : gpu::Image{};
    if (needsValues(state)) {
        refreshPicture(state);
    }
}

TonemapSettings Session::shownTonemap(const ViewerState& state) const {
    TonemapSettings tonemap = state.settings.tonemap;
    tonemap.autoExposure = AutoExposure::off;
    tonemap.exposure += exposure_.value_or(0.0F);
    return tonemap;
}

void Session::refreshPicture(const ViewerState& state) {
    if (values_) {
        uploaded_ = uploadPicture(device_, shownPicture(state, shownTonemap(state), *values_), "shown");
        picture_ = uploaded_.image();
    }
}

void Session::resetHistory() {
    renderer_.restart(0);
    asked_.reset();
    frames_ = 0;
}

bool Session::isDefaultView(const ViewerState& state, uvec2 size) const {
    return state.view == firstView_ && (!scene_->cameras.empty() || size == parseSize(state.source.size));
}

// Uses a separate renderer without history, as `reflet render` does; the live image is unaffected.
void Session::screenshot(const ViewerState& state, uvec2 size, const std::string& file) {
    Pictures pictures(state.show, {});
    const Settings settings = renderedSettings(state);
    const uint32_t frames = framesToSettle(historyUse(settings, *scene_), settings);
    // A changed view goes through its JSON form, as in the copied command line: directions may differ in the last bit.
    View view = firstView_;
    if (!isDefaultView(state, size)) {
        applyViewJson(nlohmann::json(viewJson(state.view)), "view", view);
    }
    Renderer renderer(device_, *scene_, printWarning);
    bool made = true;
    for (uint32_t i = 0; i < frames; ++i) {
        renderer.render(view, size, state.source.seed, settings, [&](gpu::Frame& f, const FrameImages& images) {
            made = isMade(findShow(state.show), images);
            if (made && i + 1 == frames) {
                pictures.request(f, images, false);
            }
        });
    }
    if (!made) {
        fail("image '{}' is not available with this scene and these settings", state.show);
    }
    pictures.write(file, renderer.frame(), makeViewParams(view.camera, size, 0, state.source.seed));
}

Picked Session::pick(const ViewerState& state, uvec2 size, uvec2 pixel) {
    Settings settings = renderedSettings(state);
    settings.composite.layers = 1;
    std::vector<ShowReadback> readbacks;
    gpu::Readback ray;
    const FrameImages images =
        renderFrame(state, state.view, size, settings, [&](gpu::Frame& f, const FrameImages& made) {
            for (const Show& show : shows()) {
                if (isMade(show, made) && !hasOwnSize(show)) {
                    readbacks.push_back(requestShow(f, made, show));
                }
            }
            ray = recordRay(f, recordRay_, {made.g, made.backDepth, made.pyramid}, made.view, settings.traceScreen,
                            pixel * made.g.depth.size / size);
        });
    Picked picked{pixel, {}, recordedRay(frame(), ray), params_, changes_};
    for (const ShowReadback& readback : readbacks) {
        picked.values.push_back(
            {std::string(readback.show->name), readback.show->channels, fetchValue(frame(), readback, params_, pixel)});
    }
    if (!needsValues(state)) {
        picture_ = images.display;
    }
    return picked;
}

}  // namespace reflet
