// The panel for the camera.
#include "view/camera_panel.h"

#include "scene/pose.h"

#include <imgui.h>

#include <algorithm>

namespace reflet {

namespace {

// In the coordinates of the scene's file.
void dragPosition(const char* label, vec3& position, const glm::dvec3& origin) {
    glm::dvec3 shown = origin + glm::dvec3(position);
    if (ImGui::DragScalarN(label, ImGuiDataType_Double, &shown.x, 3, 0.01F, nullptr, nullptr, "%.3f")) {
        position = shown - origin;
    }
}

}  // namespace

void CameraPanel::lens() {
    Camera& camera = work_.state.view.camera;
    constexpr auto flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic;
    ImGui::SliderFloat("aperture", &camera.apertureRadius, 0.0F, 1.0F, "%.4f m", flags);
    work_.places.note("aperture");
    tooltip("Radius of the lens. 0: a pinhole, everything is sharp. Larger: less depth of field.");
    if (camera.apertureRadius <= 0.0F) {
        return;
    }
    float distance = posed(work_.state.view, work_.scene()).camera.focusDistance;
    if (ImGui::SliderFloat("focus", &distance, 0.01F, 1000.0F, "%.3f m", flags)) {
        work_.focusAt(distance);
    }
    work_.places.note("focus");
    tooltip("Distance of the plane of focus along the view axis. Alt+click on the image focuses there.");
    int blades = static_cast<int>(camera.blades);
    if (ImGui::SliderInt("blades", &blades, 0, Camera::mostBlades, "%d", ImGuiSliderFlags_AlwaysClamp)) {
        const bool round = blades < static_cast<int>(Camera::fewestBlades) && blades < static_cast<int>(camera.blades);
        camera.blades = blades == 0 || round ? 0 : std::max(static_cast<uint32_t>(blades), Camera::fewestBlades);
    }
    work_.places.note("blades");
    tooltip("Of the aperture, 3 or more: blurred lights are polygons. 0: disks.");
    if (camera.blades > 0) {
        ImGui::SliderAngle("blade rotation", &camera.bladeRotation, -180.0F, 180.0F);
    }
}

void CameraPanel::draw() {
    Camera& camera = work_.state.view.camera;
    if (ImGui::Button("frame all (F)")) {
        actions_.frameAll();
    }
    work_.places.note("frame all");
    ImGui::SameLine();
    if (ImGui::Button("reset (R)")) {
        actions_.resetCamera();
    }
    work_.places.note("reset camera");
    const std::vector<Camera>& cameras = work_.scene().cameras;
    for (size_t i = 0; i < cameras.size(); ++i) {
        const std::string name = cameras[i].name.empty() ? fmt::format("camera {}", i) : cameras[i].name;
        if (ImGui::Button(fmt::format("{}##{}", name, i).c_str())) {
            camera = cameras[i];
        }
        work_.places.note(fmt::format("camera {}", i));
        if (i + 1 < cameras.size()) {
            ImGui::SameLine();
        }
    }
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.6F);
    dragPosition("position", camera.position, work_.state.view.origin);
    dragPosition("target", camera.target, work_.state.view.origin);
    if (camera.orthographicHeight <= 0.0F) {
        float fov = glm::degrees(camera.fovY);
        if (ImGui::SliderFloat("field of view", &fov, 5.0F, 150.0F, "%.1f°", ImGuiSliderFlags_AlwaysClamp)) {
            camera.fovY = glm::radians(fov);
        }
        tooltip("Vertical, from the lower to the upper edge.");
    }
    lens();
    ImGui::PopItemWidth();
}

}  // namespace reflet
