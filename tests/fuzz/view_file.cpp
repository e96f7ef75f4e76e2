// View files.
#include "scene/view_file.h"
#include "fuzz.h"

using namespace reflet;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    View view;
    return fuzz::survive([&] { applyViewFile(fuzz::file("view.json", bytes, size), view); });
}
