// Text of panels.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

namespace reflet {

inline const ImVec4 problemColor(1.0F, 0.45F, 0.4F, 1.0F);
inline const ImVec4 changedColor(1.0F, 0.78F, 0.35F, 1.0F);
inline const ImVec4 quietColor(0.65F, 0.68F, 0.72F, 1.0F);

void wrappedText(const std::string& text);
void wrappedText(const ImVec4& color, const std::string& text);

std::vector<std::string> presetNames();

}  // namespace reflet
