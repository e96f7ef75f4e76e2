// What a host may look at: times and intermediate images.
#include "api/calls.h"
#include "api/frame.h"
#include "api/live.h"

#include <algorithm>

namespace reflet::api {

namespace {

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
            {"lamp_visibility", frame.lampVisibility},
            {"ambient_occlusion", frame.ambientOcclusion},
            {"exposure", frame.exposure},
            {"circle_of_confusion", frame.circleOfConfusion},
            {"velocity_tiles", frame.velocityTiles},
            {"diffuse", radiance(frame.diffuse)},
            {"specular", radiance(frame.specular)},
            {"diffuse_confidence", source(frame.diffuse)},
            {"specular_confidence", source(frame.specular)}};
}

}  // namespace

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

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
