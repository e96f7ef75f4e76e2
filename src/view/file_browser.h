// Chooses a file: folders and the files that the window can open.
#pragma once

#include "view/controls.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

class FileBrowser {
public:
    /// Opens the list in the folder that was shown last; the first time, in `folder`.
    void open(const std::filesystem::path& folder);
    /// Draws the list while it is open. Returns a file once one is chosen.
    std::optional<std::string> draw(ControlPlaces& places);

private:
    struct Entry {
        std::string name;
        bool isFolder = false;
    };

    void enter(const std::filesystem::path& folder);

    std::filesystem::path folder_;
    std::vector<Entry> entries_;
    std::string filter_;
    std::string problem_;
    bool opens_ = false;
};

}  // namespace reflet
