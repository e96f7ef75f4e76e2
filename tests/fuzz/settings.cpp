// Settings files.
#include "renderer/settings.h"
#include "base/json.h"
#include "fuzz.h"

using namespace reflet;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    Settings settings;
    return fuzz::survive([&] {
        const auto path = fuzz::file("settings.json", bytes, size);
        applySettingsJson(settings, parseJsonFile(path), path.string());
    });
}
