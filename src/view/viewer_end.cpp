// How the viewer ends: saves its state, and does not wait for a device that is busy.
#include "base/error.h"
#include "base/file.h"
#include "base/interrupt.h"
#include "cli/program.h"
#include "view/saved_state.h"
#include "view/viewer.h"

#include <exception>
#include <filesystem>
#include <functional>

namespace reflet {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds patience(2);  // with the rest of a frame, a screenshot or a comparison

std::exception_ptr thrownBy(const std::function<void()>& work) {
    try {
        work();
        return nullptr;
    } catch (...) {
        return std::current_exception();
    }
}

}  // namespace

void Viewer::save() {
    if (!opened_.scene) {
        return;  // what was saved of the scene is not restored yet
    }
    if (window_.size().x > 0) {
        state_.window = window_.size();
    }
    lastSave_ = Clock::now();
    const std::string text = stateText(state_);
    if (text == saved_) {
        return;
    }
    const fs::path file = stateFile(state_.source.scene);
    std::error_code ignored;  // writing the file reports it better
    fs::create_directories(file.parent_path(), ignored);
    saved_ = text;
    try {
        writeFileAtomically(file, text);
    } catch (const Error& error) {
        tell(fmt::format("The state cannot be saved: {}", error.what()));
        if (!warnedOfSaving_) {
            printWarning(notice_);
        }
        warnedOfSaving_ = true;
    }
}

void Viewer::checkMessages() const {
    if (options_.validate && messages_ > 0) {
        fail("the validation layers reported {} messages", messages_.load());
    }
}

// A pass that the device has begun may take minutes, and destroying anything would wait for it.
void Viewer::run() {
    const InterruptNote note;
    std::exception_ptr thrown = thrownBy([this] { loop(); });
    const std::exception_ptr unsaved = thrownBy([this] { save(); });
    window_.hide();
    const auto end = Clock::now() + patience;
    compare_.cancel();
    const bool ended = render_.endsBy(end) && compare_.endsBy(end);
    const std::exception_ptr complaint = thrownBy([this] { checkMessages(); });
    thrown = thrown ? thrown : unsaved ? unsaved : complaint;
    if (!ended) {
        if (const size_t lost = render_.unfinished(); lost > 0) {
            printWarning(
                fmt::format("screenshots not written, as the device is busy: {}; close the window after them", lost));
        }
        endProgram(thrown);
    }
    if (thrown) {
        std::rethrow_exception(thrown);
    }
}

}  // namespace reflet
