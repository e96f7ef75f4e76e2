// Saves the state while the window is open, and at the end.
#pragma once

#include "view/clock.h"
#include "view/workspace.h"

#include <string>

namespace reflet {

class StateSaver {
public:
    StateSaver(Workspace& work, const Window& window) : work_(work), window_(window) {}

    /// Writes the state of the open scene, if it has changed. A failure shows a notice, and a warning the first time.
    void save();
    /// Calls save() every few seconds, so that little is lost if the display goes away.
    void saveIfDue();

private:
    Workspace& work_;
    const Window& window_;
    Clock::time_point last_ = Clock::now();
    std::string saved_;  ///< content of the state file
    bool hasWarned_ = false;
};

}  // namespace reflet
