// The panel for light.
#include "view/light_panel.h"

#include "scene/default_light.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace reflet {

// The sky follows the sun once it is let go: making its image takes longer than a frame.
void LightPanel::skyFollowsSun(bool moved) {
    sunMoved_ = sunMoved_ || moved;
    View& view = work_.state.view;
    if (!sunMoved_ || ImGui::IsAnyItemActive()) {
        return;
    }
    sunMoved_ = false;
    if (view.environment.imageFile == "sky") {
        const float intensity = view.environment.intensity;
        view.hasDefaultSun = false;  // it was placed here
        chooseEnvironment(view, {.name = "sky", .base = {}, .keepsSun = true});
        view.environment.intensity = intensity;
    }
}

void LightPanel::sun() {
    View& view = work_.state.view;
    ImGui::TextUnformatted("Sun");
    const bool dragged = dragDirection("sun direction", view.sun.direction);
    if (dragged) {
        view.sun.node = -1;
    }
    work_.places.note("sun direction");
    tooltip("Drag the sun: zenith in the centre, horizon at the rim, +X to the right, +Z down.");
    ImGui::SameLine();
    ImGui::BeginGroup();
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.55F);
    const vec3 toSun = -view.sun.direction;
    float elevation = glm::degrees(std::asin(std::clamp(toSun.y, -1.0F, 1.0F)));
    float azimuth = glm::degrees(std::atan2(toSun.x, toSun.z));
    const bool turned = ImGui::SliderFloat("azimuth", &azimuth, -180.0F, 180.0F, "%.1f°");
    const bool raised = ImGui::SliderFloat("elevation", &elevation, -89.9F, 89.9F, "%.1f°");
    if (turned || raised) {
        const float e = glm::radians(elevation);
        const float a = glm::radians(azimuth);
        view.sun.direction = -glm::normalize(vec3(std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)));
        view.sun.node = -1;
    }
    skyFollowsSun(dragged || turned || raised);
    ImGui::DragFloat3("irradiance", &view.sun.irradiance.x, 0.05F, 0.0F, 1e4F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    tooltip("W/m² on a surface that faces the sun: red, green, blue.");
    float diameter = glm::degrees(view.sun.angularDiameter);
    if (ImGui::SliderFloat("diameter", &diameter, 0.0F, 10.0F, "%.2f°", ImGuiSliderFlags_AlwaysClamp)) {
        view.sun.angularDiameter = glm::radians(diameter);
    }
    tooltip("Angular diameter; the real sun has 0.53°. Larger: softer shadows, with shadow.filter=pcss.");
    ImGui::PopItemWidth();
    ImGui::EndGroup();
}

void LightPanel::lamps() {
    View& view = work_.state.view;
    const std::vector<Lamp>& lamps = work_.scene().lamps;
    if (!lamps.empty() && ImGui::TreeNode("lamps", "Lamps (%zu)", lamps.size())) {
        for (uint32_t i = 0; i < lamps.size(); ++i) {
            const auto place = std::ranges::lower_bound(view.lampsOff, i);
            bool on = place == view.lampsOff.end() || *place != i;
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Checkbox(fmt::format("{} {}", i, lamps[i].name).c_str(), &on)) {
                if (on) {
                    view.lampsOff.erase(place);
                } else {
                    view.lampsOff.insert(place, i);
                }
            }
            work_.places.note(fmt::format("lamp {}", i));
            ImGui::PopID();
        }
        ImGui::TreePop();
    }
}

void LightPanel::environment() {
    View& view = work_.state.view;
    ImGui::TextUnformatted("Environment");
    for (const char* name : {"sky", "studio", "none"}) {
        ImGui::SameLine();
        if (ImGui::Button(name)) {
            chooseEnvironment(view, {.name = name, .base = {}, .keepsSun = false});
        }
        work_.places.note(fmt::format("environment {}", name));
    }
    if (view.environment.image) {
        ImGui::SliderFloat("intensity", &view.environment.intensity, 0.0F, 10.0F, "%.3f", ImGuiSliderFlags_AlwaysClamp);
        ImGui::SliderAngle("rotation", &view.environment.rotation, -180.0F, 180.0F);
    } else {
        ImGui::ColorEdit3("radiance", &view.environment.radiance.x,
                          ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
        view.environment.radiance = glm::clamp(view.environment.radiance, 0.0F, 1e6F);
        tooltip("Uniform from all directions, W/(m² sr).");
    }
}

void LightPanel::background() {
    View& view = work_.state.view;
    int mode = static_cast<int>(view.background.mode);
    if (ImGui::Combo("background", &mode, "environment\0blurred environment\0colour\0transparent\0")) {
        view.background.mode = static_cast<Background::Mode>(mode);
    }
    work_.places.note("background");
    tooltip("What is seen where there is no surface. Lighting and reflections do not change.");
    if (view.background.mode == Background::Mode::color) {
        ImGui::ColorEdit3("colour", &view.background.color.x);
    }
}

void LightPanel::draw() {
    sun();
    lamps();
    environment();
    background();
    if (ImGui::Button("reset light")) {
        const View& first = work_.opened.firstView;
        View& view = work_.state.view;
        view.sun = first.sun;
        view.environment = first.environment;
        view.background = first.background;
        view.lampsOff = first.lampsOff;
        view.lampRadius = first.lampRadius;
    }
    work_.places.note("own light");
}

}  // namespace reflet
