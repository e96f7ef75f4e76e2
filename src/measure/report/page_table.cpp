// Writes the tables of a scene in the report's page.
#include "measure/report/page_table.h"

#include "measure/report/text.h"
#include "measure/report/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace reflet {

namespace {

struct Column {
    const char* title;
    double (*value)(const ReportVariant&);
    std::string (*text)(double);
    bool highIsGood = false;
};

constexpr Column columns[] = {
    {"relative MSE", [](const ReportVariant& v) { return v.againstTruth.relativeMse; }, relativeMseText},
    {"FLIP", [](const ReportVariant& v) { return v.againstTruth.flip; }, flipText},
    {"PSNR, dB", [](const ReportVariant& v) { return v.againstTruth.psnr; }, psnrText, true},
    {"relative MSE", [](const ReportVariant& v) { return v.againstVisible.relativeMse; }, relativeMseText},
    {"FLIP", [](const ReportVariant& v) { return v.againstVisible.flip; }, flipText},
    {"PSNR, dB", [](const ReportVariant& v) { return v.againstVisible.psnr; }, psnrText, true},
    {"ms per frame", [](const ReportVariant& v) { return v.frameMs; }, millisecondsText},
};

// The column's texts, and the best of them; empty if all are equal.
struct ColumnTexts {
    std::vector<std::string> texts;
    std::string best;
};

ColumnTexts textsOf(const Column& column, const std::vector<ReportVariant>& variants) {
    ColumnTexts result;
    std::ranges::transform(variants, std::back_inserter(result.texts),
                           [&](const ReportVariant& variant) { return column.text(column.value(variant)); });
    const auto worse = [&](const ReportVariant& a, const ReportVariant& b) {
        return column.highIsGood ? column.value(a) < column.value(b) : column.value(a) > column.value(b);
    };
    const auto best = std::ranges::max_element(variants, worse);
    if (best != variants.end() && std::ranges::count(result.texts, column.text(column.value(*best))) !=
                                      static_cast<ptrdiff_t>(result.texts.size())) {
        result.best = column.text(column.value(*best));
    }
    return result;
}

std::string valueCell(const std::string& text, bool best) {
    return best ? fmt::format("<td class=\"best\"><small>best</small> <strong>{}</strong></td>", text)
                : fmt::format("<td>{}</td>", text);
}

std::string rowStart(std::string_view name) {
    return fmt::format("<tr><th scope=\"row\">{}</th>", xmlText(name));
}

std::string errorHead() {
    std::string head =
        "<thead>\n<tr><th rowspan=\"2\" scope=\"col\">variant</th>"
        "<th colspan=\"3\" scope=\"colgroup\">error against the ground truth</th>"
        "<th colspan=\"3\" scope=\"colgroup\">error against visible-only</th>"
        "<th scope=\"colgroup\">time</th></tr>\n<tr>";
    for (const Column& column : columns) {
        head += fmt::format("<th scope=\"col\">{}</th>", column.title);
    }
    return head + "</tr>\n</thead>\n";
}

// Rows to judge the numbers above by: visible-only and the noise of the references.
std::string yardsticks(const ReportScene& scene) {
    const ReportError& e = scene.visibleError;
    const auto noise = [](const ReportReference& r) { return relativeMseText(r.noise * r.noise); };
    return fmt::format(
        "<tbody class=\"yardstick\">\n"
        "{}<td>{}</td><td>{}</td><td>{}</td><td></td><td></td><td></td><td></td></tr>\n"
        "{}<td>{}</td><td></td><td></td><td>{}</td><td></td><td></td><td></td></tr>\n</tbody>\n",
        rowStart("visible-only"), relativeMseText(e.relativeMse), flipText(e.flip), psnrText(e.psnr),
        rowStart("reference noise"), noise(scene.truth), noise(scene.visible));
}

std::string scrolled(const std::string& caption, const char* style, const std::string& table) {
    return fmt::format(
        "<div class=\"scroll\" role=\"region\" aria-label=\"{0}\" tabindex=\"0\">\n<table class=\"{1}\">\n"
        "<caption>{0}</caption>\n{2}</table>\n</div>\n",
        caption, style, table);
}

// Names of all variants' passes. A pass that only some variants have comes after its predecessor there.
std::vector<std::string> passNames(const std::vector<ReportVariant>& variants) {
    std::vector<std::string> names;
    for (const ReportVariant& variant : variants) {
        auto place = names.begin();
        for (const ReportPass& pass : variant.passes) {
            auto found = std::ranges::find(names, pass.name);
            if (found == names.end()) {
                found = names.insert(place, pass.name);
            }
            place = std::next(found);
        }
    }
    return names;
}

std::string passCell(const ReportVariant& variant, const std::string& name) {
    const auto found = std::ranges::find(variant.passes, name, &ReportPass::name);
    if (found == variant.passes.end()) {
        return "<td></td>";
    }
    const double share = variant.frameMs > 0.0 ? std::clamp(found->ms / variant.frameMs, 0.0, 1.0) : 0.0;
    return fmt::format("<td style=\"--share:{:.3f}\">{}</td>", share, millisecondsText(found->ms));
}

}  // namespace

std::string errorTable(const ReportScene& scene) {
    std::vector<ColumnTexts> values;
    std::ranges::transform(columns, std::back_inserter(values),
                           [&](const Column& column) { return textsOf(column, scene.variants); });
    std::string body = "<tbody>\n";
    for (size_t i = 0; i < scene.variants.size(); ++i) {
        body += rowStart(scene.variants[i].name);
        for (const ColumnTexts& column : values) {
            body += valueCell(column.texts[i], column.texts[i] == column.best);
        }
        body += "</tr>\n";
    }
    return scrolled(fmt::format("Errors and times, {}", xmlText(scene.name)), "errors",
                    errorHead() + body + "</tbody>\n" + yardsticks(scene));
}

std::string passTable(const ReportScene& scene) {
    std::string table = "<thead>\n<tr><th scope=\"col\">pass</th>";
    std::string total = rowStart("frame");
    for (const ReportVariant& variant : scene.variants) {
        table += fmt::format("<th scope=\"col\">{}</th>", xmlText(variant.name));
        total += fmt::format("<td>{}</td>", millisecondsText(variant.frameMs));
    }
    table += "</tr>\n</thead>\n<tbody>\n";
    for (const std::string& name : passNames(scene.variants)) {
        table += rowStart(name);
        for (const ReportVariant& variant : scene.variants) {
            table += passCell(variant, name);
        }
        table += "</tr>\n";
    }
    table += fmt::format("</tbody>\n<tfoot>\n{}</tr>\n</tfoot>\n", total);
    return scrolled(fmt::format("Milliseconds per pass, {}", xmlText(scene.name)), "passes", table);
}

}  // namespace reflet
