// A fictitious report.
#include "support/sample_report.h"

#include <limits>

namespace reflet::test {

namespace {

ReportVariant makeVariant(const std::string& prefix, const std::string& name, const std::string& file, double error,
                          double ms) {
    return {name,
            "diffuse.rays=1 trace_screen.max_steps=16",
            prefix + file + ".png",
            prefix + file + "-error.png",
            prefix + file + "-method-error.png",
            {error, 2 * error, 30.0 - error},
            {0.5 * error, error, 33.0 - error},
            ms,
            {{"gbuffer", 0.25 * ms}, {"shadow_map", 0.125 * ms}, {"tonemap", 0.0625 * ms}}};
}

ReportScene makeScene(const std::string& name, const std::string& prefix) {
    ReportScene scene;
    scene.name = name;
    scene.source = "scenes/" + name + ".glb";
    scene.description = "one \"thing\" & <another>";
    scene.truth = {prefix + "truth.png", 64, 0.01};
    scene.visible = {prefix + "visible-only.png", 32, 0.02};
    scene.visibleErrorMap = prefix + "visible-only-error.png";
    scene.visibleError = {0.03, 0.05, 28.0};
    scene.variants = {makeVariant(prefix, "a <b> & 'c'", "a-b-c", 0.5, 1.0),
                      makeVariant(prefix, "quality", "quality", 0.125, 16.0),
                      makeVariant(prefix, "wide|open", "wide-open", 0.25, 8.0)};
    scene.variants[1].passes = {{"gbuffer", 4.0}, {"diffuse.trace_screen", 8.0}, {"tonemap", 1.0}};
    scene.variants[1].againstVisible.psnr = std::numeric_limits<double>::infinity();
    return scene;
}

}  // namespace

ReportPage sampleReport() {
    ReportPage page;
    page.version = "1.2.3";
    page.command = "reflet report 'a <scene>.glb' -o out";
    page.device = "A <device> & co";
    page.size = {64, 36};
    page.frames = 6;
    page.errorScale = "error-scale.png";
    page.plotSvg = R"(<svg viewBox="0 0 4 3" role="img" aria-label="plot"><circle r="1"/></svg>)";
    page.scenes = {makeScene("cubes", "cubes-"), makeScene("<script>alert(\"1\")</script>", "script-")};
    return page;
}

std::vector<std::string> pictureFiles(const ReportPage& page) {
    std::vector<std::string> files{page.errorScale};
    for (const ReportScene& scene : page.scenes) {
        files.insert(files.end(), {scene.truth.picture, scene.visible.picture, scene.visibleErrorMap});
        for (const ReportVariant& variant : scene.variants) {
            files.insert(files.end(), {variant.picture, variant.truthErrorMap, variant.visibleErrorMap});
        }
    }
    return files;
}

}  // namespace reflet::test
