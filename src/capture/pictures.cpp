// Copies images of a frame to the host and writes them.
#include "capture/pictures.h"

#include "base/error.h"
#include "base/image_file.h"
#include "capture/texels.h"
#include "effects/exposure/exposure.h"
#include "renderer/view_params.h"
#include "scene/image_camera.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace reflet {

bool isExr(const std::string& file) {
    return std::filesystem::path(file).extension() == ".exr";
}

std::optional<CoverageReadback> requestCoverage(gpu::Frame& f, const FrameImages& images) {
    if (!images.coverage) {
        return std::nullopt;
    }
    return CoverageReadback{f.readback(images.coverage), images.coverage.format, images.coverage.size};
}

FloatImage CoverageReadback::fetch(const gpu::Frame& f) const {
    FloatImage coverage{size.x, size.y, {"Y"}, {}};
    for (const vec4& texel : decodeTexels(format, f.bytes(copy))) {
        coverage.data.push_back(std::clamp(texel.x, 0.0F, 1.0F));
    }
    return coverage;
}

FloatImage withAlpha(const FloatImage& colors, const FloatImage& coverage) {
    REFLET_CHECK(colors.channels.size() == 3 && colors.data.size() == 3 * coverage.data.size(), "{} values, {} alphas",
                 colors.data.size(), coverage.data.size());
    FloatImage result{colors.width, colors.height, {"R", "G", "B", "A"}, {}};
    result.data.reserve(4 * coverage.data.size());
    for (size_t i = 0; i < coverage.data.size(); ++i) {
        const float* c = &colors.data[3 * i];
        result.data.insert(result.data.end(), {c[0], c[1], c[2], coverage.data[i]});
    }
    return result;
}

Pictures::Pictures(const std::string& show, const std::vector<std::string>& aovs) : main_(&findShow(show)) {
    for (const std::string& name : aovs) {
        const Show* aov = &findShow(name);
        if (std::ranges::find(aovs_, aov) == aovs_.end()) {
            aovs_.push_back(aov);
        }
    }
    const auto ownSize = [](const Show* s) { return s->is(ShowProperty::ownSize); };
    if (const auto found = std::ranges::find_if(aovs_, ownSize); found != aovs_.end()) {
        failUsage("--aov {0}: its size differs from the frame's; render it alone with --show {0}", (*found)->name);
    }
    if (main_->is(ShowProperty::ownSize) && !aovs_.empty()) {
        failUsage("--show {}: its size differs from the frame's, so it cannot share a file with --aov", main_->name);
    }
}

void Pictures::prepare(Settings& settings) const {
    const auto needs = [&](ShowProperty property) {
        return main_->is(property) || std::ranges::any_of(aovs_, [&](const Show* s) { return s->is(property); });
    };
    if (needs(ShowProperty::countsSteps)) {
        settings.traceScreen.countSteps = 1;
    }
    if (needs(ShowProperty::countsHits)) {
        settings.traceScreen.countHits = 1;
    }
    settings.composite.layers = contains("indirect_diffuse") || contains("indirect_specular") ? 1 : 0;
}

bool Pictures::contains(std::string_view show) const {
    return main_->name == show || std::ranges::find(aovs_, show, &Show::name) != aovs_.end();
}

void Pictures::request(gpu::Frame& f, const FrameImages& images, bool rays) {
    std::vector<const Show*> wanted = aovs_;
    wanted.push_back(main_);
    if (rays) {
        for (const char* name : {"diffuse_steps", "specular_steps", "diffuse_confidence", "specular_confidence"}) {
            wanted.push_back(&findShow(name));
        }
    }
    readbacks_.clear();
    for (const Show* show : wanted) {
        if (!readbacks_.contains(show)) {
            readbacks_.emplace(show, requestShow(f, images, *show));
        }
    }
    display_ = f.readback(images.display);
    transparent_ = images.transparent;
    coverage_ = requestCoverage(f, images);
    exposure_ = images.exposure ? std::optional(f.readback(images.exposure)) : std::nullopt;
}

std::optional<float> Pictures::autoExposure(const gpu::Frame& f) const {
    return exposure_ ? std::optional(exposureOf(f, *exposure_)) : std::nullopt;
}

nlohmann::ordered_json Pictures::rayStatistics(const gpu::Frame& f, const ViewParams& view) const {
    nlohmann::ordered_json json;
    for (const std::string lobe : {"diffuse", "specular"}) {
        const FloatImage steps = fetchValues(f, readbacks_.at(&findShow(lobe + "_steps")), view);
        const FloatImage hits = fetchValues(f, readbacks_.at(&findShow(lobe + "_confidence")), view);
        double pixels = 0.0;
        double stepSum = 0.0;
        double hitSum = 0.0;
        for (size_t i = 0; i < steps.data.size(); ++i) {
            pixels += steps.data[i] > 0.0F ? 1.0 : 0.0;  // other pixels traced no rays
            stepSum += steps.data[i];
            hitSum += hits.data[i];
        }
        json[lobe] = {{"steps", stepSum / std::max(pixels, 1.0)}, {"hits", hitSum / std::max(pixels, 1.0)}};
    }
    return json;
}

void Pictures::write(const std::string& file, const gpu::Frame& f, const View& view, uvec2 size) const {
    const ViewParams params = makeViewParams(view.camera, size, 0, 0);
    if (isExr(file)) {
        writeExrFile(file, f, params, imageCamera(view, size));
    } else {
        writePng(file, bitmap(f, params));
    }
}

Bitmap Pictures::bitmap(const gpu::Frame& f, const ViewParams& view) const {
    return main_->picture == nullptr ? fetchDisplay(f, display_, view.size, transparent_)
                                     : makePicture(*main_, fetchValues(f, readbacks_.at(main_), view));
}

// The final image has an alpha channel where surfaces do not cover all of it.
FloatImage Pictures::valuesOf(const Show& show, const gpu::Frame& f, const ViewParams& view) const {
    FloatImage values = fetchValues(f, readbacks_.at(&show), view);
    if (!coverage_ || show.name != "final") {
        return values;
    }
    return withAlpha(values, coverage_->fetch(f));
}

// The --show image under plain channel names, so that every viewer opens it; then a named layer for each AOV.
void Pictures::writeExrFile(const std::string& file, const gpu::Frame& f, const ViewParams& view,
                            const ImageCamera& camera) const {
    std::vector<ImageLayer> layers{{"", valuesOf(*main_, f, view), PixelType::float32}};
    for (const Show* aov : aovs_) {
        layers.push_back({std::string(aov->name), valuesOf(*aov, f, view), PixelType::float32});
    }
    writeExr(file, layers, camera);
}

}  // namespace reflet
