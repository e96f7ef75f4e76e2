// How the viewer ends: it saves its state, and does not wait for a device that is busy.
#include "base/error.h"
#include "base/interrupt.h"
#include "cli/program.h"
#include "view/viewer.h"

#include <exception>
#include <functional>

namespace reflet {

namespace {

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

void Viewer::checkMessages() const {
    if (options_.validate && messages_ > 0) {
        fail("the validation layers reported {} messages", messages_.load());
    }
}

// A pass that the device has begun may take minutes, and destroying anything would wait for it.
void Viewer::run() {
    const InterruptNote note;
    std::exception_ptr thrown = thrownBy([this] { loop(); });
    const std::exception_ptr unsaved = thrownBy([this] { saver_.save(); });
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
