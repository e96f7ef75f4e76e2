// The window's saved state.
#include "view/saved_state.h"
#include "fuzz.h"

#include <cstdlib>

using namespace reflet;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    static const bool once = [] {
        ::setenv("XDG_CONFIG_HOME", fuzz::folder().c_str(), 1);
        std::filesystem::create_directories(stateFile("builtin:cubes").parent_path());
        return true;
    }();
    (void)once;
    std::ofstream(stateFile("builtin:cubes"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
    ViewerState state;
    state.source.scene = "builtin:cubes";
    state.preset = "plain";
    return fuzz::survive([&] {
        restoreState(state, {});
        (void)stateText(state);
    });
}
