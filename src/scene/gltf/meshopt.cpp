// Decodes buffer views compressed with KHR_meshopt_compression or EXT_meshopt_compression, by meshoptimizer, but for
// what only the first has. Its decoders check untrusted data,
// but only assert what the extension demands of strides and counts, which is checked here.
#include "scene/gltf/meshopt.h"

#include "scene/gltf/meshopt_vertices.h"

#include <meshoptimizer.h>

#include <array>
#include <span>

namespace reflet {

namespace {

using nlohmann::json;

constexpr std::array<const char*, 2> extensionNames{"KHR_meshopt_compression", "EXT_meshopt_compression"};
constexpr uint64_t maxRatio = 1024;  // the codecs reach 64
constexpr uint64_t smallestBlock = 8192;

/// A compressed buffer view.
struct Compressed {
    std::string mode;
    std::string filter;
    uint64_t stride = 0;  ///< bytes per element
    uint64_t count = 0;
    std::span<const uint8_t> bytes;
};

/// The extension by either name; nullptr: it has none.
const json* extensionOf(const json& object, const char** name = nullptr) {
    const auto extensions = object.find("extensions");
    for (size_t i = 0; extensions != object.end() && i < extensionNames.size(); ++i) {
        if (const auto found = extensions->find(extensionNames[i]); found != extensions->end()) {
            if (name != nullptr) {
                *name = extensionNames[i];
            }
            return &*found;
        }
    }
    return nullptr;
}

Compressed open(const json& extension, const tinygltf::Model& model, const std::string& part,
                const GltfReport& report) {
    Compressed view;
    view.mode = extension["mode"].get<std::string>();
    view.filter = extension.value("filter", "NONE");
    view.stride = extension["byteStride"];
    view.count = extension["count"];
    const uint64_t offset = extension.value("byteOffset", uint64_t(0));
    const uint64_t length = extension["byteLength"];
    const size_t buffer = extension["buffer"];
    const std::span bytes(model.buffers[buffer].data);
    if (offset > bytes.size() || length > bytes.size() - offset) {
        report.fail(part, "reaches past the {} bytes of buffers[{}]", bytes.size(), buffer);
    }
    view.bytes = bytes.subspan(offset, length);
    return view;
}

void check(const Compressed& view, uint64_t decodedBytes, const std::string& part, const GltfReport& report) {
    const bool attributes = view.mode == "ATTRIBUTES";
    if (attributes ? view.stride % 4 != 0 : view.stride != 2 && view.stride != 4) {
        report.fail(part + ".byteStride", "is {}, which is not allowed for {}", view.stride, view.mode);
    }
    if (view.mode == "TRIANGLES" && view.count % 3 != 0) {
        report.fail(part + ".count", "is {}, not a multiple of 3", view.count);
    }
    const bool fits = view.filter == "NONE" || (attributes && view.filter == "EXPONENTIAL") ||
                      (attributes && (view.filter == "OCTAHEDRAL" || view.filter == "COLOR") &&
                       (view.stride == 4 || view.stride == 8)) ||
                      (attributes && view.filter == "QUATERNION" && view.stride == 8);
    if (!fits) {
        report.fail(part + ".filter", "is {}, which is not allowed for {} of {} bytes", view.filter, view.mode,
                    view.stride);
    }
    const uint64_t size = view.count * view.stride;  // below 2^62 by the schema
    if (size != decodedBytes) {
        report.fail(part, "decodes to {} bytes, but the view has {}", size, decodedBytes);
    }
    if (size > maxRatio * view.bytes.size() + smallestBlock) {
        report.fail(part, "claims to decode {} bytes to {}", view.bytes.size(), size);
    }
}

bool decode(const Compressed& view, std::vector<uint8_t>& to) {
    if (view.mode == "TRIANGLES") {
        return meshopt_decodeIndexBuffer(to.data(), view.count, view.stride, view.bytes.data(), view.bytes.size()) == 0;
    }
    if (view.mode == "INDICES") {
        return meshopt_decodeIndexSequence(to.data(), view.count, view.stride, view.bytes.data(), view.bytes.size()) ==
               0;
    }
    const bool decoded =
        !view.bytes.empty() && view.bytes[0] == meshoptVertexHeader1
            ? decodeMeshoptVertices(view.bytes, view.stride, view.count, to)
            : meshopt_decodeVertexBuffer(to.data(), view.count, view.stride, view.bytes.data(), view.bytes.size()) == 0;
    if (!decoded) {
        return false;
    }
    if (view.filter == "OCTAHEDRAL") {
        meshopt_decodeFilterOct(to.data(), view.count, view.stride);
    } else if (view.filter == "QUATERNION") {
        meshopt_decodeFilterQuat(to.data(), view.count, view.stride);
    } else if (view.filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(to.data(), view.count, view.stride);
    } else if (view.filter == "COLOR") {
        decodeMeshoptColors(to, view.stride);
    }
    return true;
}

}  // namespace

bool isMeshoptFallback(const json& buffer) {
    const json* extension = extensionOf(buffer);
    return extension != nullptr && extension->value("fallback", false);
}

void decodeMeshopt(const json& document, tinygltf::Model& model, GltfReport& report) {
    for (size_t i = 0; i < model.bufferViews.size(); ++i) {
        const char* name = nullptr;
        const json* extension = extensionOf(document["bufferViews"][i], &name);
        if (extension == nullptr) {
            continue;
        }
        tinygltf::BufferView& view = model.bufferViews[i];
        const std::string part = fmt::format("bufferViews[{}].extensions.{}", i, name);
        tinygltf::Buffer decoded;
        report.tolerateUntilUsed("bufferViews", i, [&] {
            const Compressed compressed = open(*extension, model, part, report);
            check(compressed, view.byteLength, part, report);
            report.charge(part, view.byteLength);
            decoded.data.resize(view.byteLength);
            if (!decode(compressed, decoded.data)) {
                report.fail(part, "its compressed data is broken");
            }
        });
        view.buffer = static_cast<int>(model.buffers.size());
        view.byteOffset = 0;
        model.buffers.push_back(std::move(decoded));
    }
}

}  // namespace reflet
