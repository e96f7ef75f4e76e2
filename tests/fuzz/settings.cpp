// Settings files.
#include "renderer/settings.h"
#include "base/json.h"
#include "fuzz.h"

FUZZ_TARGET(settings) {
    Settings read;
    return survive([&] {
        const auto path = file("settings.json", bytes, size);
        applySettingsJson(read, parseJsonFile(path), path.string());
    });
}
