// Writes what was recorded.
#include "gpu_compilers/statistics.h"

#include "base/file.h"

#include <nlohmann/json.hpp>

namespace reflet::gpu_compilers {

namespace {

using nlohmann::json;

json asJson(const glm::uvec3& v) {
    return json::array({v.x, v.y, v.z});
}

json asJson(const Kernel& kernel) {
    json loops = json::array();
    for (const Loop& loop : kernel.loops) {
        const Instructions& n = loop.instructions;
        loops.push_back({{"parent", loop.parent},
                         {"vector", n.vector},
                         {"transcendental", n.transcendental},
                         {"scalar", n.scalar},
                         {"memory", n.loads + n.samples + n.stores + n.atomics},
                         {"memory_waits", n.memoryWaits},
                         {"shared_waits", n.sharedWaits}});
    }
    return {{"local_size", asJson(kernel.localSize)}, {"statistics", kernel.statistics}, {"loops", loops}};
}

json asJson(const RecordedPass& pass) {
    json images = json::array();
    for (const BoundImage& image : pass.images) {
        images.push_back(
            {{"format", image.format}, {"size", asJson(image.size)}, {"bytes", image.bytes}, {"stored", image.stored}});
    }
    return {{"label", pass.label}, {"kernel", pass.kernel}, {"groups", asJson(pass.groups)}, {"images", images}};
}

}  // namespace

void writeStatistics(const std::filesystem::path& file, const std::string& driver,
                     const std::map<std::string, RecordedFrame>& frames) {
    json all{{"driver", driver}};
    for (const auto& [name, kernel] : recordedKernels()) {
        all["kernels"][name] = asJson(kernel);
    }
    for (const auto& [name, frame] : frames) {
        json& to = all["frames"][name];
        to = {{"barriers", frame.barriers}, {"cleared_bytes", frame.clearedBytes}};
        for (const RecordedPass& pass : frame.passes) {
            to["passes"].push_back(asJson(pass));
        }
    }
    writeFileAtomically(file, all.dump(1) + "\n", Lasting::no);
}

}  // namespace reflet::gpu_compilers
