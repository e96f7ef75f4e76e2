// The window's saved state.
#include "view/saved_state.h"
#include "fuzz.h"

#include <cstdlib>

FUZZ_TARGET(savedState) {
    static const std::filesystem::path home = [] {
        std::filesystem::create_directories(folder() / "reflet/view");
        return folder();
    }();
    // Other tests of the same process may set it.
    ::setenv("XDG_CONFIG_HOME", home.c_str(), 1);
    writeBytes(stateFile("builtin:cubes"), bytes, size);
    ViewerState state;
    state.source.scene = "builtin:cubes";
    state.preset = "plain";
    return survive([&] {
        restoreState(state, {});
        (void)stateText(state);
    });
}
