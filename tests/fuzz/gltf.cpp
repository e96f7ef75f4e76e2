// Scenes: .gltf and .glb, with all that is inside them, and the files that they name.
#include "scene/gltf/gltf.h"
#include "fuzz.h"
#include "scene/gltf/files.h"

using namespace reflet;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const auto path = fuzz::file("scene.glb", bytes, size);
    fuzz::survive([&] { (void)loadGltf(path, {.strict = false}); });
    return fuzz::survive([&] { visitGltfFiles(path, [](std::span<const uint8_t>) {}); });
}
