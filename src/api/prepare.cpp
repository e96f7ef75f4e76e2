// Pipelines before the first frame, and what a host may look at: times and intermediate images.
#include "api/calls.h"
#include "api/camera.h"
#include "api/frame.h"

#include <algorithm>
#include <array>

namespace reflet::api {

namespace {

constexpr uint32_t allEffects = 2 * REFLET_EFFECT_DEPTH_OF_FIELD - 1;

// Stand-ins for the host's images: passes that are only prepared never read them.
class StandIns {
public:
    explicit StandIns(RefletView_T& view) : view_(view) {}

    gpu::Image make(uvec2 size) {
        gpu::ImageState& state = view_.hostImages.emplace_back();
        state.external = true;
        state.layout = VK_IMAGE_LAYOUT_GENERAL;
        return {&state, -1, VK_FORMAT_R16G16B16A16_SFLOAT, size, 1, 1};
    }
    gpu::Image makeIfGiven(const RefletImage& image) {
        return image.image != VK_NULL_HANDLE ? make(view_.renderSize) : gpu::Image{};
    }

private:
    RefletView_T& view_;
};

void prepareFrame(RefletView_T& view, const Settings& settings, const RefletPrepareInfo& info,
                  const RefletGBuffer& gbuffer) {
    StandIns standIns(view);
    const auto asked = [&](RefletEffect effect) { return (info.effects & effect) != 0; };
    Frame frame;
    frame.size = view.renderSize;
    frame.context.view.size = vec2(view.renderSize);
    HostSurfaces surfaces = hostSurfaces(gbuffer, [&](const RefletImage& i) { return standIns.makeIfGiven(i); });
    surfaces.depth = standIns.make(view.renderSize);
    surfaces.normal = standIns.make(view.renderSize);
    recordImport(view, frame, surfaces, {});
    if (asked(REFLET_EFFECT_SUN_SHADOW)) {
        SunInputs sun;
        sun.map = standIns.make(uvec2(info.shadowMapSide > 0 ? info.shadowMapSide : 2048));
        sun.reversed = info.shadowDepthKind == REFLET_DEPTH_REVERSED;
        sun.sun.count = std::clamp(info.cascades, 1U, maxCascades);
        sun.contact = asked(REFLET_EFFECT_CONTACT_SHADOWS);
        recordSunShadow(view, frame, settings, sun);
    }
    if (asked(REFLET_EFFECT_AMBIENT_OCCLUSION)) {
        recordAmbientOcclusion(view, frame, settings);
    }
    EnvironmentInputs environment;
    environment.image = info.hasEnvironmentImage != 0 ? standIns.make(uvec2(256)) : gpu::Image{};
    const gpu::Image color = standIns.make(view.renderSize);
    // With a composite, what comes after it needs no picture of the host's.
    const bool composes = asked(REFLET_EFFECT_COMPOSITE);
    const auto pictureOr = [&](uvec2 size) { return composes ? gpu::Image{} : standIns.make(size); };
    if (asked(REFLET_EFFECT_DIFFUSE_GI)) {
        recordLobe(view, frame, settings, lobeDiffuse, color, environment);
    }
    if (asked(REFLET_EFFECT_REFLECTIONS)) {
        recordLobe(view, frame, settings, lobeSpecular, color, environment);
    }
    if (asked(REFLET_EFFECT_DENOISE)) {
        Frame denoised = frame;
        recordDenoise(view, denoised, settings, lobeDiffuse, color);
        recordDenoise(view, denoised, settings, lobeSpecular, color);
    }
    if (asked(REFLET_EFFECT_COMPOSITE)) {
        recordComposite(view, frame, settings, frame.light ? gpu::Image{} : color);
    }
    if (asked(REFLET_EFFECT_TEMPORAL)) {
        recordTemporal(view, frame, settings, composes ? gpu::Image{} : color);
    }
    if (asked(REFLET_EFFECT_DEPTH_OF_FIELD)) {
        for (const uint32_t blades : {0U, 6U}) {  // round apertures, and polygons
            recordDepthOfField(view, frame, settings, {.apertureRadius = 1.0F, .blades = blades},
                               pictureOr(outputSizeOf(view)));
        }
    }
    if (asked(REFLET_EFFECT_TONE_MAP)) {
        recordToneMap(view, frame, settings, pictureOr(outputSizeOf(view)), info.autoExposure != 0);
    }
    if (info.changesSize != 0) {
        recordRescaling(view);
    }
}

void prepareOnce(RefletView_T& view, const Settings& settings, const RefletPrepareInfo& info,
                 const RefletGBuffer& gbuffer, std::vector<gpu::PipelineInfo>& missing) {
    view.hostImages.clear();
    view.last.reset();  // its images belong to the frame that is prepared now
    view.recorder.setSizes(sizesOf(view, view.renderSize));
    view.recorder.prepare(missing);
    try {
        prepareFrame(view, settingsOfFrame(view, settings, {}), info, gbuffer);
    } catch (...) {
        view.recorder.drop();
        view.recorder.end();
        throw;
    }
    view.recorder.end();
}

struct Named {
    const char* name;
    gpu::Image image;
};

std::vector<Named> imagesOf(const Frame& frame) {
    const auto radiance = [](const std::optional<LobeLight>& lobe) { return lobe ? lobe->radiance : gpu::Image{}; };
    const auto source = [](const std::optional<LobeLight>& lobe) { return lobe ? lobe->source : gpu::Image{}; };
    return {{"depth", frame.g.depth},
            {"normal", frame.g.normal},
            {"geometric_normal", frame.g.geometricNormal},
            {"base_color", frame.g.baseColor},
            {"material", frame.g.material},
            {"motion", frame.g.motion},
            {"pyramid", frame.pyramid},
            {"light", frame.light},
            {"sun_visibility", frame.sunVisibility},
            {"ambient_occlusion", frame.ambientOcclusion},
            {"circle_of_confusion", frame.circleOfConfusion},
            {"diffuse", radiance(frame.diffuse)},
            {"specular", radiance(frame.specular)},
            {"diffuse_confidence", source(frame.diffuse)},
            {"specular_confidence", source(frame.specular)}};
}

}  // namespace

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletPrepare(RefletView view, RefletSettings settings, const RefletPrepareInfo* info,
                           uint32_t maxPipelines, uint32_t* remaining) {
    return onView(view, [&] {
        const RefletPrepareInfo given = adopted(info, "RefletPrepareInfo", offsetof(RefletPrepareInfo, changesSize));
        if (settings == nullptr || remaining == nullptr) {
            failArgument("{}: is NULL", settings == nullptr ? "settings" : "remaining");
        }
        const RefletGBuffer gbuffer = adopted(given.gbuffer, "RefletPrepareInfo.gbuffer");
        checkBoolean(given.hasEnvironmentImage, "RefletPrepareInfo.hasEnvironmentImage");
        checkBoolean(given.autoExposure, "RefletPrepareInfo.autoExposure");
        checkBoolean(given.changesSize, "RefletPrepareInfo.changesSize");
        checkDepthKind(given.shadowDepthKind, "RefletPrepareInfo.shadowDepthKind");
        if (given.effects == 0 || (given.effects & ~allEffects) != 0) {
            failArgument("RefletPrepareInfo.effects: is {:#x}; must be a combination of RefletEffect", given.effects);
        }
        if (view->frame) {
            failArgument("view: a frame has begun; prepare before refletBeginFrame or after refletEndFrame");
        }
        std::vector<gpu::PipelineInfo> missing;
        prepareOnce(*view, settings->values, given, gbuffer, missing);
        if (view->recorder.counts().plans > 0) {  // now all histories exist: the rest goes around them
            view->recorder.tidy();
            prepareOnce(*view, settings->values, given, gbuffer, missing);
        }
        const size_t made = std::min<size_t>(missing.size(), maxPipelines);
        for (size_t i = 0; i < made; ++i) {
            view->owner.gpu->pipelines().get(missing[i]);
        }
        *remaining = static_cast<uint32_t>(missing.size() - made);
    });
}

RefletResult refletPassTimes(RefletView view, uint32_t* count, RefletPassTime* times) {
    return onView(view, [&] {
        if (count == nullptr) {
            failArgument("count: is NULL");
        }
        if (!view->timesPasses) {
            failArgument("view: measures no times; make it with REFLET_VIEW_PASS_TIMES in RefletViewInfo.flags");
        }
        const std::vector<gpu::PassTime>& known = view->recorder.passTimes();
        const auto all = static_cast<uint32_t>(known.size());
        for (uint32_t i = 0; times != nullptr && i < std::min(*count, all); ++i) {
            times[i] = {known[i].name.c_str(), known[i].ms};
        }
        *count = all;
    });
}

RefletResult refletFindImage(RefletView view, const char* name, RefletImage* image) {
    return onView(view, [&] {
        if (name == nullptr || image == nullptr) {
            failArgument("{}: is NULL", name == nullptr ? "name" : "image");
        }
        const auto& frame = view->frame ? view->frame : view->last;
        if (!frame) {
            failArgument("view: no frame has been recorded yet");
        }
        const std::vector<Named> images = imagesOf(*frame);
        const auto found = std::ranges::find(images, std::string_view(name), &Named::name);
        if (found == images.end() || !found->image) {
            std::vector<std::string> there;
            for (const Named& one : images) {
                if (one.image) {
                    there.emplace_back(one.name);
                }
            }
            failArgument("name: no image of this frame is called '{}'; there are: {}", name, fmt::join(there, ", "));
        }
        *image = resultOf(found->image);
    });
}
