// Text of panels.
#include "view/panel_text.h"

#include "renderer/presets.h"

#include <algorithm>

namespace reflet {

void wrappedText(const std::string& text) {
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
}

void wrappedText(const ImVec4& color, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    wrappedText(text);
    ImGui::PopStyleColor();
}

std::vector<std::string> presetNames() {
    std::vector<std::string> names;
    std::ranges::transform(presets(), std::back_inserter(names), &Preset::name);
    return names;
}

}  // namespace reflet
