// The panel for comparisons.
#include "view/compare_panel.h"

#include "view/panel_text.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>

namespace reflet {

void ComparePanel::chooseSide() {
    Compare& c = work_.state.compare;
    int with = static_cast<int>(c.with);
    const std::array<const char*, 4> names{"nothing", "preset", "EXR file", "truth"};
    const std::array<const char*, 4> labels{"nothing", "preset", "EXR file", "ground truth"};
    const std::array<const char*, 4> help{"Shows one image.", "Live, with the settings of another preset.",
                                          "An image file, as written by reflet render or reflet reference.",
                                          "This view, path traced in the background."};
    for (int i = 0; i < 4; ++i) {
        ImGui::RadioButton(labels[i], &with, i);
        work_.places.note(fmt::format("compare {}", names[i]));
        tooltip(help[i]);
        if (i < 3) {
            ImGui::SameLine();
        }
    }
    c.with = static_cast<CompareWith>(with);
}

void ComparePanel::samples() {
    Compare& c = work_.state.compare;
    const uint32_t one = 1;
    const uint32_t most = 4096;
    ImGui::SliderScalar("samples", ImGuiDataType_U32, &c.samples, &one, &most, "%u", ImGuiSliderFlags_Logarithmic);
    tooltip("Maximum samples per pixel.");
    if (compare_.samples() < c.samples) {
        const uint32_t next = CompareView::nextSamples(compare_.samples(), c.samples);
        ImGui::ProgressBar(compare_.progress(), {-1.0F, 0.0F},
                           fmt::format("{} samples: {:.0f} %", next, 100.0 * double(compare_.progress())).c_str());
    }
}

void ComparePanel::error() {
    if (!compare_.error()) {
        return;
    }
    ImGui::Text("HDR-FLIP %.4f   relative MSE %.5f   bias %+.1f %%", compare_.error()->flip,
                compare_.error()->relativeMse, 100.0 * compare_.error()->bias);
    tooltip("Error of the left side against the right one, computed in the background.");
    if (const uint32_t samples = compare_.errorSamples(); samples > 0) {
        ImGui::TextColored(quietColor, "against %s per pixel", CompareView::sampleText(samples).c_str());
    }
    ImGui::Checkbox("error map on the right", &work_.state.compare.errorImage);
    work_.places.note("error image");
    tooltip("HDR-FLIP of each pixel in false colours, instead of the right image.");
}

void ComparePanel::draw() {
    Compare& c = work_.state.compare;
    chooseSide();
    if (c.with == CompareWith::nothing) {
        return;
    }
    if (c.with == CompareWith::preset) {
        chooseName("right side", presetNames(), c.preset);
        work_.places.note("right preset");
    } else if (c.with == CompareWith::file) {
        ImGui::InputText("file", &file_);
        if (ImGui::IsItemDeactivatedAfterEdit()) {
            c.file = file_;
        }
    } else {
        samples();
    }
    wrappedText(compare_.failed() ? problemColor : quietColor, compare_.message());
    error();
    ImGui::TextColored(quietColor, "Drag the divider in the image; X shows one side alone.");
}

}  // namespace reflet
