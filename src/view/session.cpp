// Renders an open scene.
#include "view/session.h"

#include "base/error.h"
#include "capture/pictures.h"
#include "compare/heat_map.h"
#include "effects/exposure/exposure.h"
#include "effects/tonemap/tone_map_image.h"
#include "renderer/history.h"
#include "scene/pose.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

// Pictures at rest converge without end; eight times the frames of a settled history.
constexpr uint32_t convergedAfter = 256;

uint32_t framesFor(const Settings& settings, const Scene& scene) {
    const HistoryUse use = historyUse(settings, scene);
    const uint32_t exposed = use.exposure ? exposureFrames : 1;
    const bool converges = use.accumulate || use.denoise;  // what has no noise settles sooner
    return std::max({converges ? convergedAfter : 1U, framesToSettle(use, settings), exposed});
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

bool OpenScene::isDefaultView(const ViewerState& state, uvec2 size) const {
    return state.view == firstView && (!scene->cameras.empty() || size == parseSize(state.source.size));
}

Session::Session(gpu::Device& device, const SceneOptions& source)
    : device_(device),
      opened_{std::make_shared<const Scene>(loadScene(source)), {}},
      renderer_(device, *opened_.scene, printWarning) {
    opened_.firstView = loadView(source, *opened_.scene);
}

Session::Session(gpu::Device& device, const Session& other)
    : device_(device), opened_(other.opened_), renderer_(device, *opened_.scene, printWarning) {}

bool Session::wantsFrame(const ViewerState& state, uvec2 size) const {
    if (!last_ || state.plays || last_->show != state.show) {
        return true;
    }
    const Settings settings = renderedSettings(state);
    return !(last_->view == state.view) || last_->size != size || !sameSettings(last_->settings, settings) ||
           shown_.frames < framesFor(settings, *opened_.scene);
}

FrameImages Session::renderFrame(const ViewerState& state, const View& view, uvec2 size, const Settings& settings,
                                 const std::function<void(gpu::Frame&, const FrameImages&)>& after) {
    shown_.view = makeViewParams(posed(view, *opened_.scene).camera, size, 0, state.source.seed);
    shown_.size = size;
    return renderer_.render(view, size, state.source.seed, settings, after);
}

bool Session::render(const ViewerState& state, uvec2 size, bool keepValues, const std::function<bool()>& stop) {
    const Settings settings = renderedSettings(state);
    if (!last_ || !(last_->view == state.view) || last_->size != size || !sameSettings(last_->settings, settings)) {
        ++shown_.changes;
        shown_.frames = 0;
    }
    last_ = Request{state.view, settings, size, state.show};
    const Show& show = findShow(state.show);
    const bool fromValues = needsValues(state);
    std::optional<ShowReadback> readback;
    std::optional<gpu::Readback> exposure;
    std::optional<gpu::Readback> display;
    std::string problem;
    // The device of a GPU takes less time for a frame than for stopping one.
    renderer_.stopBetweenPasses(device_.description().kind == "CPU" ? stop : std::function<bool()>());
    FrameImages images;
    try {
        images = renderFrame(state, state.view, size, settings, [&](gpu::Frame& f, const FrameImages& made) {
            if (!isMade(show, made)) {
                problem = fmt::format("Image '{}' is not available with this scene and these settings: {}.", show.name,
                                      show.description);
            } else if (keepValues || fromValues) {
                readback = requestShow(f, made, show);
            }
            if (problem.empty() && !fromValues) {
                display = f.readback(made.display);
            }
            exposure = made.exposure ? std::optional(f.readback(made.exposure)) : std::nullopt;
        });
    } catch (const gpu::FrameStopped&) {
        resetHistory();
        return false;
    }
    const gpu::Frame& frame = renderer_.frame();
    shown_.problem = problem;
    shown_.exposure = exposure ? std::optional(exposureOf(frame, *exposure)) : std::nullopt;
    shown_.tonemap = settings.tonemap;
    shown_.tonemap.autoExposure = AutoExposure::off;
    shown_.tonemap.exposure += shown_.exposure.value_or(0.0F);
    ++shown_.frames;
    ++shown_.rendered;
    shown_.framesToConverge = framesFor(settings, *opened_.scene);
    shown_.values = readback ? std::make_shared<const FloatImage>(fetchValues(frame, *readback, shown_.view)) : nullptr;
    shown_.picture =
        display ? std::make_shared<const Bitmap>(fetchDisplay(frame, *display, images.display.size)) : nullptr;
    shown_.passes = frame.passTimes();
    shown_.milliseconds = frame.submittedMs();
    if (fromValues) {
        refreshPicture(state);
    }
    return true;
}

void Session::refreshPicture(const ViewerState& state) {
    if (shown_.values) {
        shown_.picture = std::make_shared<const Bitmap>(shownPicture(state, shown_.tonemap, *shown_.values));
    }
}

void Session::resetHistory() {
    renderer_.restart(0);
    last_.reset();
    shown_.frames = 0;
}

// Uses a separate renderer without history, as `reflet render` does; the live image is unaffected.
void Session::screenshot(const ViewerState& state, uvec2 size, const std::string& file) {
    Pictures pictures(state.show, {});
    const Settings settings = renderedSettings(state);
    const Scene& scene = *opened_.scene;
    const uint32_t frames = framesToSettle(historyUse(settings, scene), settings);
    Renderer renderer(device_, scene, printWarning);
    bool made = true;
    for (uint32_t i = 0; i < frames; ++i) {
        renderer.render(state.view, size, state.source.seed, settings, [&](gpu::Frame& f, const FrameImages& images) {
            made = isMade(findShow(state.show), images);
            if (made && i + 1 == frames) {
                pictures.request(f, images, false);
            }
        });
    }
    if (!made) {
        fail("image '{}' is not available with this scene and these settings", state.show);
    }
    pictures.write(file, renderer.frame(), posed(state.view, scene), size);
}

Picked Session::pick(const ViewerState& state, uvec2 size, uvec2 pixel) {
    Settings settings = renderedSettings(state);
    settings.composite.layers = 1;
    std::vector<ShowReadback> readbacks;
    gpu::Readback ray;
    gpu::Readback hemisphere;
    std::optional<gpu::Readback> shadow;
    PixelScale scale;
    const float sunSlope = std::tan(0.5F * posed(state.view, *opened_.scene).sun.angularDiameter);
    TraceScreenSettings diffuse = settings.traceScreen;
    diffuse.maxDistance = std::min(diffuse.maxDistance, settings.diffuse.maxDistance);
    renderer_.stopBetweenPasses({});
    renderFrame(state, state.view, size, settings, [&](gpu::Frame& f, const FrameImages& made) {
        for (const Show& show : shows()) {
            if (isMade(show, made) && !show.is(ShowProperty::ownSize)) {
                readbacks.push_back(requestShow(f, made, show));
            }
        }
        const RecordRayInputs inputs{made.g, made.backDepth, made.pyramid, settings.traceScene.enabled != 0};
        scale = {made.g.depth.size, size};
        const uvec2 place = scale.toFrame(pixel);
        ray = recordRay(f, inputs, made.view, settings.traceScreen, place);
        if (made.shadowMap && settings.shadow.filter != ShadowFilter::traced) {
            shadow = recordShadow(f, made.g, {{made.shadowMap}, made.shadowRange, {}},
                                  {made.view, made.sun, settings.shadow, sunSlope, place});
        }
        hemisphere = recordHemisphere(f, inputs, made.view, diffuse, place);
    });
    const gpu::Frame& frame = renderer_.frame();
    Picked picked{.pixel = pixel, .view = shown_.view, .change = shown_.changes};
    if (const std::optional<RecordedRay> recorded = recordedRay(frame, ray)) {
        takeRay(picked, *recorded, scale);
        takeHemisphere(picked, recordedHemisphere(frame, hemisphere), scale);
        picked.shadow = shadow ? std::optional(recordedShadow(frame, *shadow)) : std::nullopt;
    }
    for (const ShowReadback& readback : readbacks) {
        picked.values.push_back({std::string(readback.show->name), readback.show->channels,
                                 fetchValue(frame, readback, shown_.view, pixel)});
    }
    return picked;
}

}  // namespace reflet
