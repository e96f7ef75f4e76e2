// The panels for light and camera.
#include "view/viewer.h"

#include "base/error.h"
#include "scene/default_light.h"
#include "scene/pose.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace reflet {

// The sky follows the sun once it is let go: making its image takes longer than a frame.
void Viewer::skyFollowsSun(bool moved) {
    sunMoved_ = sunMoved_ || moved;
    View& view = state_.view;
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

void Viewer::environmentPanel() {
    View& view = state_.view;
    ImGui::TextUnformatted("Environment");
    for (const char* name : {"sky", "studio", "none"}) {
        ImGui::SameLine();
        if (ImGui::Button(name)) {
            chooseEnvironment(view, {.name = name, .base = {}, .keepsSun = false});
        }
        places_.note(fmt::format("environment {}", name));
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
    int mode = static_cast<int>(view.background.mode);
    if (ImGui::Combo("background", &mode, "environment\0blurred environment\0colour\0transparent\0")) {
        view.background.mode = static_cast<Background::Mode>(mode);
    }
    places_.note("background");
    tooltip("What is seen where there is no surface. Lighting and reflections do not change.");
    if (view.background.mode == Background::Mode::color) {
        ImGui::ColorEdit3("colour", &view.background.color.x);
    }
}

void Viewer::lampsPanel() {
    View& view = state_.view;
    const std::vector<Lamp>& lamps = scene().lamps;
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
            places_.note(fmt::format("lamp {}", i));
            ImGui::PopID();
        }
        ImGui::TreePop();
    }
}

void Viewer::lightPanel() {
    View& view = state_.view;
    ImGui::TextUnformatted("Sun");
    const bool dragged = dragDirection("sun direction", view.sun.direction);
    if (dragged) {
        view.sun.node = -1;
    }
    places_.note("sun direction");
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
    lampsPanel();
    environmentPanel();
    if (ImGui::Button("reset light")) {
        view.sun = opened_.firstView.sun;
        view.environment = opened_.firstView.environment;
        view.background = opened_.firstView.background;
        view.lampsOff = opened_.firstView.lampsOff;
        view.lampRadius = opened_.firstView.lampRadius;
    }
    places_.note("own light");
}

void Viewer::lensPanel() {
    Camera& camera = state_.view.camera;
    constexpr auto flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic;
    ImGui::SliderFloat("aperture", &camera.apertureRadius, 0.0F, 1.0F, "%.4f m", flags);
    places_.note("aperture");
    tooltip("Radius of the lens. 0: a pinhole, everything is sharp. Larger: less depth of field.");
    if (camera.apertureRadius <= 0.0F) {
        return;
    }
    float distance = posed(state_.view, scene()).camera.focusDistance;
    if (ImGui::SliderFloat("focus", &distance, 0.01F, 1000.0F, "%.3f m", flags)) {
        focusAt(distance);
    }
    places_.note("focus");
    tooltip("Distance of the plane of focus along the view axis. Alt+click on the image focuses there.");
    int blades = static_cast<int>(camera.blades);
    if (ImGui::SliderInt("blades", &blades, 0, Camera::mostBlades, "%d", ImGuiSliderFlags_AlwaysClamp)) {
        const bool round = blades < static_cast<int>(Camera::fewestBlades) && blades < static_cast<int>(camera.blades);
        camera.blades = blades == 0 || round ? 0 : std::max(static_cast<uint32_t>(blades), Camera::fewestBlades);
    }
    places_.note("blades");
    tooltip("Of the aperture, 3 or more: blurred lights are polygons. 0: disks.");
    if (camera.blades > 0) {
        ImGui::SliderAngle("blade rotation", &camera.bladeRotation, -180.0F, 180.0F);
    }
}

void Viewer::cameraPanel() {
    Camera& camera = state_.view.camera;
    if (ImGui::Button("frame all (F)")) {
        handleKey({'F'});
    }
    places_.note("frame all");
    ImGui::SameLine();
    if (ImGui::Button("reset (R)")) {
        handleKey({'R'});
    }
    places_.note("reset camera");
    const std::vector<Camera>& cameras = scene().cameras;
    for (size_t i = 0; i < cameras.size(); ++i) {
        const std::string name = cameras[i].name.empty() ? fmt::format("camera {}", i) : cameras[i].name;
        if (ImGui::Button(fmt::format("{}##{}", name, i).c_str())) {
            camera = cameras[i];
        }
        places_.note(fmt::format("camera {}", i));
        if (i + 1 < cameras.size()) {
            ImGui::SameLine();
        }
    }
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.6F);
    ImGui::DragFloat3("position", &camera.position.x, 0.01F, 0.0F, 0.0F, "%.3f");
    ImGui::DragFloat3("target", &camera.target.x, 0.01F, 0.0F, 0.0F, "%.3f");
    if (camera.orthographicHeight <= 0.0F) {
        float fov = glm::degrees(camera.fovY);
        if (ImGui::SliderFloat("field of view", &fov, 5.0F, 150.0F, "%.1f°", ImGuiSliderFlags_AlwaysClamp)) {
            camera.fovY = glm::radians(fov);
        }
        tooltip("Vertical, from the lower to the upper edge.");
    }
    lensPanel();
    ImGui::PopItemWidth();
}

}  // namespace reflet
