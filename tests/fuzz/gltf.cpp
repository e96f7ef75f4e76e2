// Scenes: .gltf and .glb, with all that is inside them.
#include "scene/gltf/gltf.h"
#include "fuzz.h"
#include "gltf_mutator.h"
#include "scene/pose.h"

#include <algorithm>
#include <cstring>

FUZZ_TARGET(gltf) {
    const auto path = file("scene.glb", bytes, size);
    return survive([&] {
        const Scene scene = loadGltf(path, {});
        (void)scenePose(scene, 0.7);
    });
}

#ifdef REFLET_LIBFUZZER

extern "C" size_t LLVMFuzzerMutate(uint8_t* bytes, size_t size, size_t most);

/// Of the binary chunk one time in eight, of any bytes one time in sixteen or where there is no document.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* bytes, size_t size, size_t most, unsigned seed) {
    using namespace reflet::fuzz;
    std::mt19937 random(seed);
    auto parts = gltfParts({reinterpret_cast<const char*>(bytes), size});
    const unsigned kind = random() % 16;
    if (!parts || kind == 0) {
        return LLVMFuzzerMutate(bytes, size, most);
    }
    if (kind <= 2 && parts->glb && !parts->bin.empty()) {
        std::string& bin = parts->bin;
        const size_t had = bin.size();
        bin.resize(had + 64);
        bin.resize(LLVMFuzzerMutate(reinterpret_cast<uint8_t*>(bin.data()), had, bin.size()));
    } else {
        mutateDocument(parts->document, random);
    }
    const std::string made = gltfFile(*parts);
    if (made.size() > most) {
        return LLVMFuzzerMutate(bytes, size, most);
    }
    std::memcpy(bytes, made.data(), made.size());
    return made.size();
}

#endif
