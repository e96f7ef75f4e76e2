// Does the long work of a report.
#include "measure/report/scene_work.h"

#include "base/image_file.h"
#include "base/progress.h"
#include "capture/pictures.h"
#include "capture/show.h"
#include "capture/timings.h"
#include "compare/compare.h"
#include "compare/heat_map.h"
#include "effects/exposure/exposure.h"
#include "reference/sample_progress.h"
#include "renderer/background/background.h"
#include "renderer/renderer.h"
#include "renderer/scene_exposure/scene_exposure.h"

#include <fmt/format.h>

namespace reflet {

namespace {

// Writes images of one scene and returns their file names.
class PictureFolder {
public:
    PictureFolder(std::filesystem::path folder, std::string prefix, FileNames& names)
        : folder_(std::move(folder)), prefix_(std::move(prefix)), names_(names) {}

    std::string write(const std::string& name, const Bitmap& picture) {
        std::string file = names_.take(prefix_ + "-" + name) + ".png";
        writePng(folder_ / file, picture);
        return file;
    }

private:
    std::filesystem::path folder_;
    std::string prefix_;
    FileNames& names_;
};

ReferencePicture traceReference(const ReportWork& work, const ReportInput& input, bool visibleOnly) {
    ReferenceOptions options = work.reference;
    options.visibleOnly = visibleOnly;
    SampleProgress progress(fmt::format("{}, {}", input.position, visibleOnly ? "visible-only" : "ground truth"),
                            options, work.size);
    return traceReference(input.scene, input.view, work.size, options, [&](const ReferenceProgress& now) {
        progress.set(now);
        return true;
    });
}

// The last frame of a variant.
struct Rendered {
    FloatImage radiance;
    FloatImage coverage;  ///< empty unless the background needs it
    Timings timings;
};

// Uses a separate renderer, so that earlier variants leave no history.
Rendered renderVariant(const ReportWork& work, const ReportInput& input, const Settings& settings, gpu::Device& device,
                       Progress& progress) {
    Renderer renderer(device, input.scene, printWarning);
    Rendered result;
    ShowReadback radiance;
    std::optional<CoverageReadback> coverage;
    for (uint32_t i = 0; i < work.frames; ++i) {
        renderer.render(input.view, work.size, work.seed, settings, [&](gpu::Frame& f, const FrameImages& images) {
            if (i + 1 == work.frames) {
                radiance = requestShow(f, images, findShow("final"));
                coverage = requestCoverage(f, images);
            }
        });
        result.timings.add(renderer.frame().passTimes());
        progress.advance();
    }
    const ViewParams params = makeViewParams(input.view.camera, work.size, 0, work.seed);
    result.radiance = fetchValues(renderer.frame(), radiance, params);
    result.coverage = coverage ? coverage->fetch(renderer.frame()) : FloatImage{};
    return result;
}

Comparison compareNamed(const FloatImage& picture, const std::string& name, const FloatImage& truth,
                        const std::string& referenceName) {
    CompareOptions options;
    options.imageName = name;
    options.referenceName = referenceName;
    return compareImages(picture, truth, options);
}

ReportError errorOf(const Comparison& comparison) {
    const Difference& d = comparison.difference;
    return {d.relativeMse, d.flip, d.psnr, d.bias};
}

// All pictures of a scene have the ground truth's exposure.
ReportVariant workOnVariant(const Variant& variant, const Rendered& rendered, const FloatImage& truth,
                            const FloatImage& visible, const Background& background, const TonemapSettings& tonemap,
                            PictureFolder& folder) {
    const std::string file = fileNameOf(variant.name);
    const Comparison againstTruth = compareNamed(rendered.radiance, variant.name, truth, "the ground truth");
    const Comparison againstVisible = compareNamed(rendered.radiance, variant.name, visible, "visible-only");
    ReportVariant result;
    result.name = variant.name;
    result.settings = changedSettings(variant.settings);
    result.picture = folder.write(file, displayedOver(rendered.radiance, rendered.coverage, background, tonemap));
    result.truthErrorMap = folder.write(file + "-error", heatMap(againstTruth.flip));
    result.visibleErrorMap = folder.write(file + "-method-error", heatMap(againstVisible.flip));
    result.againstTruth = errorOf(againstTruth);
    result.againstVisible = errorOf(againstVisible);
    result.frameMs = rendered.timings.frameMs();
    for (const gpu::PassTime& pass : rendered.timings.passes()) {
        result.passes.push_back({pass.name, pass.ms});
    }
    return result;
}

}  // namespace

ReportScene workOn(const ReportWork& work, const ReportInput& input, gpu::Device& device, FileNames& names) {
    PictureFolder folder(work.folder, input.filePrefix, names);
    // Frames first: they are fast, and a variant that cannot be rendered fails before the long work.
    std::vector<Rendered> rendered;
    {
        Progress progress(input.position + ": frame", uint64_t(work.variants.size()) * work.frames);
        for (const Variant& variant : work.variants) {
            rendered.push_back(renderVariant(work, input, variant.settings, device, progress));
        }
    }
    const ReferencePicture truth = traceReference(work, input, false);
    const ReferencePicture visible = traceReference(work, input, true);
    const Comparison unknown = compareNamed(visible.final, "visible-only", truth.final, "the ground truth");

    ReportScene result;
    result.name = input.name;
    result.source = input.source;
    result.description = input.description;
    const auto exposed = [&](const TonemapSettings& t) { return exposedAs(t, input.scene, truth.final, truth.depth); };
    const TonemapSettings tonemap = exposed(work.tonemap);
    if (exposesAutomatically(work.tonemap, input.scene)) {
        result.exposure = tonemap.exposure;
    }
    const Background& background = input.view.background;
    const auto displayed = [&](const ReferencePicture& p) {
        return displayedOver(p.final, p.coverage, background, tonemap);
    };
    result.truth = {folder.write("truth", displayed(truth)), truth.samples, truth.noise};
    result.visible = {folder.write("visible-only", displayed(visible)), visible.samples, visible.noise};
    result.visibleErrorMap = folder.write("visible-only-error", heatMap(unknown.flip));
    result.visibleError = errorOf(unknown);
    for (size_t i = 0; i < rendered.size(); ++i) {
        const Variant& variant = work.variants[i];
        result.variants.push_back(workOnVariant(variant, rendered[i], truth.final, visible.final, background,
                                                exposed(variant.settings.tonemap), folder));
    }
    return result;
}

}  // namespace reflet
