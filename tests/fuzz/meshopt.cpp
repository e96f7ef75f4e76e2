// Payloads of EXT_meshopt_compression. The first byte selects mode, filter and stride, the second the number of
// elements; the rest is what is decoded. What the decoder takes is also loaded as a scene, as positions or indices.
#include "scene/gltf/meshopt.h"
#include "fixed_scene.h"

#include <fmt/format.h>

#include <array>

namespace {

using namespace reflet;

struct Layout {
    const char* mode;
    const char* filter;
    unsigned stride;
    const char* accessor;  ///< of the decoded view, without its count
    bool indices;
};

constexpr const char* floats = R"("componentType":5126,"type":"VEC3")";
constexpr const char* shorts = R"("componentType":5123,"type":"SCALAR")";
constexpr const char* words = R"("componentType":5125,"type":"SCALAR")";
constexpr const char* quaternions = R"("componentType":5122,"type":"VEC3")";
constexpr const char* normals = R"("componentType":5120,"type":"VEC3")";

constexpr std::array<Layout, 11> layouts{{{"ATTRIBUTES", "NONE", 12, floats, false},
                                          {"ATTRIBUTES", "NONE", 16, floats, false},
                                          {"ATTRIBUTES", "NONE", 252, floats, false},
                                          {"ATTRIBUTES", "EXPONENTIAL", 12, floats, false},
                                          {"ATTRIBUTES", "OCTAHEDRAL", 4, normals, false},
                                          {"ATTRIBUTES", "OCTAHEDRAL", 8, quaternions, false},
                                          {"ATTRIBUTES", "QUATERNION", 8, quaternions, false},
                                          {"TRIANGLES", "NONE", 2, shorts, true},
                                          {"TRIANGLES", "NONE", 4, words, true},
                                          {"INDICES", "NONE", 2, shorts, true},
                                          {"INDICES", "NONE", 4, words, true}}};
constexpr size_t head = 2;
constexpr size_t plainBytes = 3UL * 64 * 12;  // positions for indices to refer to

std::string viewOf(const Layout& layout, unsigned count, size_t payload) {
    return fmt::format(R"({{"buffer":1,"byteLength":{},{}"extensions":{{"EXT_meshopt_compression":{{"buffer":0,)"
                       R"("byteLength":{},"byteStride":{},"count":{},"mode":"{}","filter":"{}"}}}}}})",
                       count * layout.stride, layout.indices ? "" : fmt::format("\"byteStride\":{},", layout.stride),
                       payload, layout.stride, count, layout.mode, layout.filter);
}

std::string documentWith(const Layout& layout, unsigned count, size_t payload) {
    const std::string primitive =
        layout.indices ? R"({"attributes":{"POSITION":1},"indices":0})" : R"({"attributes":{"POSITION":0}})";
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"extensionsUsed":["EXT_meshopt_compression","KHR_mesh_quantization"],)"
        R"("buffers":[{{"byteLength":{0}}},{{"byteLength":1048576,"extensions":{{"EXT_meshopt_compression":{{"fallback":true}}}}}}],)"
        R"("bufferViews":[{1},{{"buffer":0,"byteOffset":{2},"byteLength":{3}}}],"accessors":[{{"bufferView":0,"count":{4},{5}}},)"
        R"({{"bufferView":1,"count":192,{6}}}],"meshes":[{{"primitives":[{7}]}}],"nodes":[{{"mesh":0}}],)"
        R"("scenes":[{{"nodes":[0]}}]}})",
        (payload + 3) / 4 * 4 + plainBytes, viewOf(layout, count, payload), (payload + 3) / 4 * 4, plainBytes, count,
        layout.accessor, floats, primitive);
}

}  // namespace

FUZZ_TARGET(meshopt) {
    if (size <= head) {
        return 0;
    }
    const Layout& layout = layouts.at(bytes[0] % layouts.size());
    const unsigned count = layout.indices ? 3U * (1 + bytes[1]) : 1U + 4 * bytes[1];
    const size_t payload = size - head;
    return survive([&] {
        GltfDocument document = documentOf(bytes + head, payload);
        document.model.buffers.resize(2);
        document.model.bufferViews[0].byteLength = size_t{count} * layout.stride;
        const nlohmann::json extension{{"buffer", 0},    {"byteLength", payload}, {"byteStride", layout.stride},
                                       {"count", count}, {"mode", layout.mode},   {"filter", layout.filter}};
        const nlohmann::json json{{"bufferViews", {{{"extensions", {{"EXT_meshopt_compression", extension}}}}}}};
        GltfReport report("payload.glb", {}, true);
        decodeMeshopt(json, document.model, report);
        std::string bin(reinterpret_cast<const char*>(bytes + head), payload);
        bin.resize((payload + 3) / 4 * 4 + plainBytes, '\0');
        loadGlb(documentWith(layout, count, payload), std::move(bin));
    });
}
