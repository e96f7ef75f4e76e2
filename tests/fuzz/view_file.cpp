// View files.
#include "scene/view_file.h"
#include "fuzz.h"

FUZZ_TARGET(viewFile) {
    View view;
    return survive([&] { applyViewFile(file("view.json", bytes, size), view); });
}
