// The panel that chooses the right side of the divider.
#pragma once

#include "view/compare_view.h"
#include "view/workspace.h"

#include <string>

namespace reflet {

class ComparePanel {
public:
    ComparePanel(Workspace& work, const CompareView& compare) : work_(work), compare_(compare) {}

    void draw();

private:
    void chooseSide();
    void samples();
    void error();

    Workspace& work_;
    const CompareView& compare_;
    std::string file_;  ///< as typed
};

}  // namespace reflet
