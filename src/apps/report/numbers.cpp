// The numbers of a report for other programs (JSON) and for documents (Markdown).
#include "apps/report/page.h"
#include "apps/report/text.h"
#include "base/json_text.h"

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

namespace reflet {

namespace {

using Json = nlohmann::ordered_json;

Json errorJson(const ReportError& error) {
    return {{"relative_mse", error.relativeMse}, {"flip", error.flip}, {"psnr", error.psnr}};
}

Json referenceJson(const ReportReference& reference) {
    return {{"picture", reference.picture}, {"samples", reference.samples}, {"noise", reference.noise}};
}

Json variantJson(const ReportVariant& variant) {
    Json passes = Json::object();
    for (const ReportPass& pass : variant.passes) {
        passes[pass.name] = pass.ms;
    }
    return {{"name", variant.name},
            {"settings", variant.settings},
            {"picture", variant.picture},
            {"truth_error_map", variant.truthErrorMap},
            {"visible_only_error_map", variant.visibleErrorMap},
            {"against_truth", errorJson(variant.againstTruth)},
            {"against_visible_only", errorJson(variant.againstVisible)},
            {"frame_ms", variant.frameMs},
            {"passes", passes}};
}

Json sceneJson(const ReportScene& scene) {
    Json variants = Json::array();
    for (const ReportVariant& variant : scene.variants) {
        variants.push_back(variantJson(variant));
    }
    Json visible = referenceJson(scene.visible);
    visible["truth_error_map"] = scene.visibleErrorMap;
    visible["against_truth"] = errorJson(scene.visibleError);
    return {{"name", scene.name},
            {"source", scene.source},
            {"truth", referenceJson(scene.truth)},
            {"visible_only", visible},
            {"variants", variants}};
}

std::string errorCells(const ReportError& error) {
    return fmt::format("{} | {} | {}", relativeMseText(error.relativeMse), flipText(error.flip), psnrText(error.psnr));
}

void addRows(std::string& table, const ReportScene& scene) {
    constexpr const char* row = "| {} | {} | {} | {} | {} |\n";
    constexpr const char* none = "| |";
    const std::string name = escapeMarkdown(scene.name);
    for (const ReportVariant& variant : scene.variants) {
        table += fmt::format(row, name, escapeMarkdown(variant.name), errorCells(variant.againstTruth),
                             errorCells(variant.againstVisible), millisecondsText(variant.frameMs));
    }
    table += fmt::format(row, name, "*visible-only*", errorCells(scene.visibleError), none, "");
    const auto noise = [](const ReportReference& reference) {
        return fmt::format("{} | |", relativeMseText(reference.noise * reference.noise));
    };
    table += fmt::format(row, name, "*noise of the references*", noise(scene.truth), noise(scene.visible), "");
}

}  // namespace

std::string reportJson(const ReportPage& page) {
    Json scenes = Json::array();
    for (const ReportScene& scene : page.scenes) {
        scenes.push_back(sceneJson(scene));
    }
    const Json all{{"version", page.version},
                   {"command", page.command},
                   {"device", page.device},
                   {"size", {page.size.x, page.size.y}},
                   {"seed", page.seed},
                   {"frames", page.frames},
                   {"bounces", page.bounces ? Json(*page.bounces) : Json("unlimited")},
                   {"scenes", scenes}};
    // Names of files may be no UTF-8, which is no reason to lose the numbers.
    return jsonText(all, 2) + "\n";
}

std::string reportMarkdown(const ReportPage& page) {
    std::string table = fmt::format(
        "{}x{} pixels, seed {}, {} frames a variant, truth with {}, times on {}. Made by reflet {}:\n\n", page.size.x,
        page.size.y, page.seed, page.frames, bouncesText(page.bounces), escapeMarkdown(page.device), page.version);
    table += fmt::format("    {}\n\n", page.command);
    table +=
        "| scene | variant | truth: relative MSE | FLIP | PSNR [dB] | visible-only: relative MSE | FLIP | PSNR [dB] "
        "| ms per frame |\n|---|---|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const ReportScene& scene : page.scenes) {
        addRows(table, scene);
    }
    return table;
}

}  // namespace reflet
