// Describes the window's content, for scripts.
#pragma once

#include "view/compare_view.h"
#include "view/workspace.h"

#include <optional>
#include <string>

namespace reflet {

struct WindowStatus {
    const Workspace& work;
    const CompareView& compare;
    const std::optional<Picked>& picked;
    uvec2 window{0};  ///< size in window units
    vec2 pointer{0.0F};
    uint64_t inputs = 0;  ///< see Window::inputs()
    std::string busyWith;
    uint64_t drawn = 0;  ///< redraws in total
    bool moving = false;
    bool atRest = false;
};

/// JSON; docs/window.md describes it.
std::string statusText(const WindowStatus& status);

}  // namespace reflet
