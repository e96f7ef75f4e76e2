// Draws the list of files with Dear ImGui.
#include "view/file_browser.h"

#include "base/ascii.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <tuple>

namespace reflet {

namespace {

namespace fs = std::filesystem;

bool canOpen(const fs::path& file) {
    constexpr std::array<const char*, 5> extensions{".gltf", ".glb", ".exr", ".hdr", ".json"};
    return std::ranges::find(extensions, inLowerCase(file.extension().string())) != extensions.end();
}

}  // namespace

void FileBrowser::open(const fs::path& folder) {
    enter(folder_.empty() ? folder : folder_);
    opens_ = true;
}

void FileBrowser::enter(const fs::path& folder) {
    std::error_code error;
    const fs::path absolute = fs::weakly_canonical(folder, error);
    fs::directory_iterator files(error ? folder : absolute, fs::directory_options::skip_permission_denied, error);
    if (error) {
        problem_ = folder.string() + ": " + error.message();
        return;
    }
    problem_.clear();
    filter_.clear();
    folder_ = absolute;
    entries_.clear();
    for (; files != fs::directory_iterator(); files.increment(error)) {
        const std::string name = files->path().filename().string();
        std::error_code unknown;  // such as a link to nothing
        const bool isFolder = files->is_directory(unknown);
        if (!name.starts_with('.') && (isFolder || canOpen(files->path()))) {
            entries_.push_back({name, isFolder});
        }
    }
    std::ranges::sort(entries_, [](const Entry& a, const Entry& b) {
        return std::tuple(!a.isFolder, inLowerCase(a.name)) < std::tuple(!b.isFolder, inLowerCase(b.name));
    });
}

std::optional<std::string> FileBrowser::draw(ControlPlaces& places) {
    constexpr const char* title = "Open a file";
    if (opens_) {
        ImGui::OpenPopup(title);
        opens_ = false;
    }
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({0.7F * whole.x, 0.8F * whole.y}, ImGuiCond_Appearing);
    ImGui::SetNextWindowPos({0.5F * whole.x, 0.5F * whole.y}, ImGuiCond_Appearing, {0.5F, 0.5F});
    bool stays = true;
    if (!ImGui::BeginPopupModal(title, &stays, ImGuiWindowFlags_NoSavedSettings)) {
        return std::nullopt;
    }
    std::optional<std::string> chosen;
    std::optional<fs::path> next;
    if (ImGui::Button("up")) {
        next = folder_.parent_path();
    }
    places.note("browser up");
    ImGui::SameLine();
    ImGui::TextUnformatted(folder_.string().c_str());
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##filter", "part of a name", &filter_);
    places.note("browser filter");
    if (!problem_.empty()) {
        ImGui::TextUnformatted(problem_.c_str());
    }
    ImGui::BeginChild("files", {0.0F, -1.5F * ImGui::GetFrameHeight()}, true);
    const std::string wanted = inLowerCase(filter_);
    for (const Entry& entry : entries_) {
        if (inLowerCase(entry.name).find(wanted) == std::string::npos) {
            continue;
        }
        const std::string label = entry.isFolder ? entry.name + "/" : entry.name;
        if (ImGui::Selectable(label.c_str())) {
            if (entry.isFolder) {
                next = folder_ / entry.name;
            } else {
                chosen = (folder_ / entry.name).string();
            }
        }
        places.note("file " + label);
    }
    ImGui::EndChild();
    if (ImGui::Button("cancel") || chosen || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
        ImGui::CloseCurrentPopup();
    }
    places.note("browser cancel");
    ImGui::SameLine();
    ImGui::TextDisabled("scenes .gltf .glb, environments .hdr, comparisons .exr, settings and views .json");
    ImGui::EndPopup();
    if (next) {
        enter(*next);
    }
    return chosen;
}

}  // namespace reflet
