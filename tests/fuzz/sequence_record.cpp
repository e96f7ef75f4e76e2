// Records of sequences that are resumed.
#include "job/sequence_record.h"
#include "fuzz.h"
#include "job/sequence_names.h"

#include <nlohmann/json.hpp>

FUZZ_TARGET(sequenceRecord) {
    static const nlohmann::ordered_json record{
        {"device", "d"}, {"size", {2, 3}}, {"view", recordOf(View{})}, {"settings", {{"diffuse.rays", "4"}}}};
    static const std::filesystem::path own = [] {  // it is listed each time
        std::filesystem::create_directories(folder() / "sequence");
        return folder() / "sequence";
    }();
    writeBytes(own / "a_#.png.sequence.json", bytes, size);
    const FrameNames names((own / "a_#.png").string());
    return survive([&] { beginSequence(names, record, false, [](const std::string&) {}); });
}
