// Records of sequences that are resumed.
#include "capture/sequence_record.h"
#include "capture/sequence_names.h"
#include "fuzz.h"

#include <nlohmann/json.hpp>

using namespace reflet;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    static const nlohmann::ordered_json record{
        {"device", "d"}, {"size", {2, 3}}, {"view", recordOf(View{})}, {"settings", {{"diffuse.rays", "4"}}}};
    fuzz::file("a_#.png.sequence.json", bytes, size);
    const FrameNames names((fuzz::folder() / "a_#.png").string());
    return fuzz::survive([&] { beginSequence(names, record, false, [](const std::string&) {}); });
}
