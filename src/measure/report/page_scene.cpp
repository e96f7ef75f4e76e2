// Writes a scene of the report's page: two images under a divider, the tables, and all images.
#include "measure/report/page_scene.h"

#include "measure/report/page_table.h"
#include "measure/report/text.h"
#include "measure/report/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace reflet {

namespace {

// page.js finds an image by `of`, the index of its choice, and by `kind`.
struct Picture {
    size_t of;
    const char* kind;
    std::string file;
    std::string alt;
    std::string label;
};

// A row of the gallery.
struct Row {
    std::string heading;
    std::string note;  ///< HTML
    std::vector<Picture> pictures;
};

constexpr const char* truthMapLabel = "error against the ground truth";
constexpr const char* visibleMapLabel = "error against visible-only";

Row referenceRow(const ReportScene& scene) {
    const std::string& name = scene.name;
    return {"references",
            "path traced",
            {{0, "picture", scene.truth.picture, name + ", path traced: the ground truth", "ground truth"},
             {1, "picture", scene.visible.picture, name + ", path traced with visible-only light", "visible-only"},
             {1, "truth", scene.visibleErrorMap,
              fmt::format("{}, error map of visible-only against the ground truth, mean FLIP {}", name,
                          flipText(scene.visibleError.flip)),
              "light from off-screen and occluded surfaces: visible-only against the ground truth"}}};
}

Row variantRow(const ReportScene& scene, size_t index) {
    const ReportVariant& v = scene.variants[index];
    const size_t of = index + 2;  // after ground truth and visible-only
    const auto map = [&](const char* against, const ReportError& error) {
        return fmt::format("{}, error map of {} against {}, mean FLIP {}", scene.name, v.name, against,
                           flipText(error.flip));
    };
    return {v.name,
            v.settings.empty() ? "all settings at their defaults" : fmt::format("<code>{}</code>", xmlText(v.settings)),
            {{of, "picture", v.picture, fmt::format("{}, variant {}", scene.name, v.name), "picture"},
             {of, "truth", v.truthErrorMap, map("the ground truth", v.againstTruth), truthMapLabel},
             {of, "visible", v.visibleErrorMap, map("visible-only", v.againstVisible), visibleMapLabel}}};
}

std::string image(const Picture& picture, uvec2 size, std::string_view attributes) {
    return fmt::format(R"(<img {} src="{}" alt="{}" width="{}" height="{}">)", attributes, xmlText(picture.file),
                       xmlText(picture.alt), size.x, size.y);
}

std::string galleryRow(const Row& row, uvec2 size) {
    std::string html =
        fmt::format("<div class=\"row\">\n<h4>{}</h4>\n<p class=\"note\">{}</p>\n", xmlText(row.heading), row.note);
    for (const Picture& picture : row.pictures) {
        const std::string attributes = fmt::format(R"(data-of="{}" data-kind="{}")", picture.of, picture.kind);
        html += fmt::format("<figure><a href=\"{}\">{}</a><figcaption>{}</figcaption></figure>\n",
                            xmlText(picture.file), image(picture, size, attributes), picture.label);
    }
    return html + "</div>\n";
}

std::string choices(const ReportScene& scene, size_t selected) {
    std::vector<std::string> names{"ground truth", "visible-only"};
    std::ranges::transform(scene.variants, std::back_inserter(names), &ReportVariant::name);
    std::string html;
    for (size_t i = 0; i < names.size(); ++i) {
        html +=
            fmt::format("<option value=\"{}\"{}>{}</option>", i, i == selected ? " selected" : "", xmlText(names[i]));
    }
    return html;
}

// Starts with the ground truth and the first variant. Hidden until page.js activates it.
std::string comparison(const ReportScene& scene, uvec2 size) {
    const Picture left = referenceRow(scene).pictures[0];
    const Picture right = scene.variants.empty() ? referenceRow(scene).pictures[1] : variantRow(scene, 0).pictures[0];
    return fmt::format(
        R"(<div class="compare" role="group" aria-label="Two images of {name} under a divider" hidden>
<div class="controls">
<label>Left <select class="left">{leftChoices}</select></label>
<label>Right <select class="right">{rightChoices}</select></label>
<label>Show <select class="kind"><option value="picture" selected>images</option><option value="truth">{truthMap}</option><option value="visible">{visibleMap}</option></select></label>
</div>
<div class="fit" style="--width:{width};--height:{height}">
<div class="stage">
{leftImage}
{rightImage}
<span class="tag left" aria-hidden="true"></span>
<span class="tag right" aria-hidden="true"></span>
<span class="divider" aria-hidden="true"></span>
</div>
<input type="range" min="0" max="100" step="0.5" value="50" aria-label="Position of the divider between the images">
</div>
</div>
)",
        fmt::arg("name", xmlText(scene.name)), fmt::arg("leftChoices", choices(scene, left.of)),
        fmt::arg("rightChoices", choices(scene, right.of)), fmt::arg("truthMap", truthMapLabel),
        fmt::arg("visibleMap", visibleMapLabel), fmt::arg("width", size.x), fmt::arg("height", size.y),
        fmt::arg("leftImage", image(left, size, R"(class="left" draggable="false")")),
        fmt::arg("rightImage", image(right, size, R"(class="right" draggable="false")")));
}

std::string facts(const ReportScene& scene) {
    const auto of = [](const ReportReference& r) {
        return fmt::format("{} per pixel, noise {:.4f}", countText(r.samples, "sample"), r.noise);
    };
    const double noise = std::max(scene.truth.noise, scene.visible.noise);
    const std::string exposure =
        scene.exposure ? fmt::format(" Exposure {:+.2f} stops, that of the ground truth.", *scene.exposure) : "";
    return fmt::format(
        "<p class=\"facts\">{}</p>\n<p class=\"facts\">Ground truth: {}; visible-only: {}. Differences in relative MSE "
        "below {} are noise of these references.{}</p>\n",
        xmlText(scene.description), of(scene.truth), of(scene.visible), relativeMseText(noise * noise), exposure);
}

}  // namespace

std::string sceneSection(const ReportScene& scene, uvec2 size, const std::string& id) {
    std::string html =
        fmt::format("<section class=\"scene\" id=\"{}\">\n<h2>{}</h2>\n{}", id, xmlText(scene.name), facts(scene));
    html += comparison(scene, size) + errorTable(scene);
    html += "<h3>Images and error maps</h3>\n<div class=\"gallery\">\n" + galleryRow(referenceRow(scene), size);
    for (size_t i = 0; i < scene.variants.size(); ++i) {
        html += galleryRow(variantRow(scene, i), size);
    }
    return html + "</div>\n" + passTable(scene) + "</section>\n";
}

}  // namespace reflet
