// libFuzzer's entry to the mutator that keeps structure, for the targets that read JSON. REFLET_RAW of 16 mutations are
// those of libFuzzer, of any bytes.
#include "gltf_mutator.h"

#include <cstring>

extern "C" size_t LLVMFuzzerMutate(uint8_t* bytes, size_t size, size_t most);
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* bytes, size_t size, size_t most, unsigned seed);

/// Also of the binary chunk of a .glb, one time in eight, and of any bytes where there is no document.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* bytes, size_t size, size_t most, unsigned seed) {
    using namespace reflet::fuzz;
    std::mt19937 random(seed);
    auto parts = gltfParts({reinterpret_cast<const char*>(bytes), size});
    if (!parts || random() % 16 < REFLET_RAW) {
        return LLVMFuzzerMutate(bytes, size, most);
    }
    if (!parts->bin.empty() && random() % 8 == 0) {
        constexpr size_t growth = 64;
        std::string& bin = parts->bin;
        const size_t had = bin.size();
        bin.resize(had + growth);
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
