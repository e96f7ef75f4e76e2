// Saves the state.
#include "view/state_saver.h"

#include "base/error.h"
#include "base/file.h"
#include "view/saved_state.h"

#include <filesystem>

namespace reflet {

namespace {

namespace fs = std::filesystem;

constexpr double saveEvery = 2.0;  // seconds

}  // namespace

void StateSaver::save() {
    if (!work_.opened.scene) {
        return;  // what was saved of the scene is not restored yet
    }
    if (window_.size().x > 0) {
        work_.state.window = window_.size();
    }
    last_ = Clock::now();
    const std::string text = stateText(work_.state);
    if (text == saved_) {
        return;
    }
    const fs::path file = stateFile(work_.state.source.scene);
    std::error_code ignored;  // writing the file reports it better
    fs::create_directories(file.parent_path(), ignored);
    saved_ = text;
    try {
        writeFileAtomically(file, text);
    } catch (const Error& error) {
        work_.tell(fmt::format("The state cannot be saved: {}", error.what()));
        if (!hasWarned_) {
            printWarning(work_.notice());
        }
        hasWarned_ = true;
    }
}

void StateSaver::saveIfDue() {
    if (secondsSince(last_) > saveEvery) {
        save();
    }
}

}  // namespace reflet
