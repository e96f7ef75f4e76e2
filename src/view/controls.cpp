// Draws controls with Dear ImGui.
#include "view/controls.h"

#include "base/error.h"
#include "view/panel_text.h"
#include "view/setting_search.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace reflet {

namespace {

std::string effectOf(const SettingEntry& entry) {
    return entry.name.substr(0, entry.name.find('.'));
}

bool isChanged(const Settings& settings, const Settings& standard, const SettingEntry& entry) {
    return std::memcmp(reinterpret_cast<const char*>(&settings) + entry.info.offset,
                       reinterpret_cast<const char*>(&standard) + entry.info.offset, sizeof(uint32_t)) != 0;
}

void choiceControl(uint32_t& value, const SettingInfo& info) {
    const auto now = std::ranges::find(info.options, value, &SettingOption::value);
    if (ImGui::BeginCombo("##value", now == info.options.end() ? "?" : now->name.c_str())) {
        for (const SettingOption& option : info.options) {
            if (ImGui::Selectable(option.name.c_str(), option.value == value)) {
                value = option.value;
            }
        }
        ImGui::EndCombo();
    }
}

void valueControl(Settings& settings, const SettingInfo& info) {
    char* place = reinterpret_cast<char*>(&settings) + info.offset;
    const bool wide = info.lowest > 0.0 ? info.highest / info.lowest > 100.0 : info.highest > 1000.0;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
    switch (info.type) {
        case SettingType::real: {
            const auto lowest = static_cast<float>(info.lowest);
            const auto highest = static_cast<float>(info.highest);
            ImGui::SliderFloat("##value", reinterpret_cast<float*>(place), lowest, highest, "%.4g",
                               flags | ImGuiSliderFlags_NoRoundToFormat);
            break;
        }
        case SettingType::integer: {
            const auto lowest = static_cast<uint32_t>(info.lowest);
            const auto highest = static_cast<uint32_t>(info.highest);
            ImGui::SliderScalar("##value", ImGuiDataType_U32, place, &lowest, &highest, "%u", flags);
            break;
        }
        case SettingType::toggle: {
            auto& value = *reinterpret_cast<uint32_t*>(place);
            bool on = value != 0;
            if (ImGui::Checkbox("##value", &on)) {
                value = on ? 1 : 0;
            }
            break;
        }
        case SettingType::choice:
            choiceControl(*reinterpret_cast<uint32_t*>(place), info);
            break;
    }
}

void settingControl(Settings& settings, const Settings& standard, const SettingEntry& entry, ControlPlaces& places) {
    ImGui::PushID(entry.name.c_str());
    const bool changed = isChanged(settings, standard, entry);
    const float width = ImGui::GetContentRegionAvail().x;
    const float button = ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(width * 0.5F);
    valueControl(settings, entry.info);
    places.note(entry.name);
    const std::string standardText = settingText(standard, entry);
    tooltip(fmt::format("{}\n\n{} = {}\n{}; with this preset {}. Ctrl+click to type a value.", entry.info.help,
                        entry.name, settingText(settings, entry), rangeText(entry.info), standardText));
    ImGui::SameLine();
    if (changed) {
        if (ImGui::Button("x", {button, button})) {
            setSetting(settings, entry.name, standardText);
        }
        places.note(entry.name + " reset");
        tooltip(fmt::format("Reset to {}", standardText));
    } else {
        ImGui::Dummy({button, button});
    }
    ImGui::SameLine();
    if (changed) {
        ImGui::TextColored(changedColor, "%s", entry.info.name.c_str());
    } else {
        ImGui::TextUnformatted(entry.info.name.c_str());
    }
    tooltip(entry.info.help);
    ImGui::PopID();
}

}  // namespace

void ControlPlaces::note(const std::string& name) {
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    const float top = ImGui::GetWindowPos().y;
    const float middle = 0.5F * (low.y + high.y);
    if (ImGui::IsItemVisible() && middle > top && middle < top + ImGui::GetWindowHeight()) {
        places_[name] = {{low.x, low.y}, {high.x, high.y}};
    }
}

std::string valuesText(const std::vector<float>& values) {
    std::string all;
    for (const float value : values) {
        all += fmt::format("{}{:.4g}", all.empty() ? "" : "  ", value);
    }
    return all;
}

void tooltip(const std::string& text) {
    if (ImGui::IsItemHovered()) {
        // Beside the row, which it would hide; below it where there is no room.
        const float width = ImGui::GetFontSize() * 28.0F;
        const float beside = ImGui::GetWindowPos().x + ImGui::GetWindowWidth() + ImGui::GetStyle().ItemSpacing.x;
        const ImVec2 screen = ImGui::GetIO().DisplaySize;
        const bool fits = beside + width < screen.x;
        const ImVec2 low = ImGui::GetItemRectMin();
        const ImVec2 high = ImGui::GetItemRectMax();
        const bool hangs = high.y < 0.6F * screen.y;  // from there on it stands
        const ImVec2 at = fits ? ImVec2(beside, hangs ? low.y : high.y) : ImVec2(low.x, hangs ? high.y : low.y);
        ImGui::SetNextWindowPos(at, ImGuiCond_Always, {0.0F, hangs ? 0.0F : 1.0F});
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0F);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
}

bool chooseName(const char* label, const std::vector<std::string>& names, std::string& chosen) {
    bool other = false;
    if (ImGui::BeginCombo(label, chosen.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const std::string& name : names) {
            if (ImGui::Selectable(name.c_str(), name == chosen)) {
                other = name != chosen;
                chosen = name;
            }
        }
        ImGui::EndCombo();
    }
    return other;
}

void settingControls(Settings& settings, const Settings& standard, const std::string& filter, ControlPlaces& places) {
    const std::vector<SettingEntry>& entries = settingEntries();
    for (size_t i = 0; i < entries.size();) {
        const std::string effect = effectOf(entries[i]);
        size_t end = i;
        size_t changed = 0;
        std::vector<const SettingEntry*> shown;
        for (; end < entries.size() && effectOf(entries[end]) == effect; ++end) {
            changed += isChanged(settings, standard, entries[end]) ? 1 : 0;
            if (isFound(entries[end], filter)) {
                shown.push_back(&entries[end]);
            }
        }
        i = end;
        if (shown.empty()) {
            continue;
        }
        // Separate ids keep the sections opened by the search apart from those opened by the user.
        const std::string title =
            fmt::format("{}{}###{}{}", effect, changed > 0 ? fmt::format(" ({} changed)", changed) : "", effect,
                        filter.empty() ? "" : " found");
        if (!filter.empty()) {
            ImGui::SetNextItemOpen(true);
        }
        if (changed > 0) {
            ImGui::PushStyleColor(ImGuiCol_Text, changedColor);
        }
        const bool open = ImGui::TreeNodeEx(title.c_str(), ImGuiTreeNodeFlags_SpanAvailWidth);
        if (changed > 0) {
            ImGui::PopStyleColor();
        }
        places.note(effect);
        if (open) {
            for (const SettingEntry* entry : shown) {
                settingControl(settings, standard, *entry, places);
            }
            ImGui::TreePop();
        }
    }
}

bool dragDirection(const char* name, vec3& light) {
    const float size = ImGui::GetFontSize() * 7.0F;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(name, {size, size});
    const vec2 middle(corner.x + 0.5F * size, corner.y + 0.5F * size);
    const float radius = 0.5F * size - 2.0F;
    bool changed = false;
    if (ImGui::IsItemActive()) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        vec2 at = (vec2(mouse.x, mouse.y) - middle) / radius;
        const float length = std::min(glm::length(at), 1.0F);
        at = length > 0.0F ? glm::normalize(at) : vec2(0.0F);
        // Equidistant from the zenith to the horizon. Seen from above: +X to the right, +Z down.
        const float zenith = length * glm::half_pi<float>();
        const vec3 toSun(std::sin(zenith) * at.x, std::cos(zenith), std::sin(zenith) * at.y);
        light = -glm::normalize(toSun);
        changed = true;
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddCircleFilled({middle.x, middle.y}, radius, IM_COL32(45, 55, 75, 255), 48);
    draw.AddCircle({middle.x, middle.y}, radius * 0.5F, IM_COL32(90, 100, 120, 255), 48);
    draw.AddCircle({middle.x, middle.y}, radius, IM_COL32(140, 150, 170, 255), 48);
    const vec3 toSun = -light;
    const float level = glm::length(vec2(toSun.x, toSun.z));
    const float away = std::acos(std::clamp(toSun.y, -1.0F, 1.0F)) / glm::half_pi<float>();
    const vec2 way = level > 0.0F ? vec2(toSun.x, toSun.z) / level : vec2(0.0F);
    const vec2 at = middle + radius * std::min(away, 1.0F) * way;
    const bool below = toSun.y < 0.0F;
    draw.AddCircleFilled({at.x, at.y}, 5.0F, below ? IM_COL32(120, 110, 90, 255) : IM_COL32(255, 220, 120, 255), 16);
    return changed;
}

}  // namespace reflet
