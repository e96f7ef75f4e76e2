// Reads a glTF file: container, schema check, parsing by tinygltf, buffers, cross-checks. tinygltf gets no buffers and
// images, because its own loading of them falls back to the working folder, decodes '+' in a file name as a space,
// decodes every image and has no limits.
#include "scene/gltf/document.h"

#include "scene/gltf/container.h"
#include "scene/gltf/meshopt.h"
#include "scene/gltf/schema.h"
#include "scene/gltf/schema_tables.h"
#include "scene/gltf/uri.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

namespace reflet {

namespace {

using nlohmann::json;

/// "MAJOR.MINOR" with MAJOR 2; a file that depends on a minor version says so in minVersion.
void checkVersion(const json& document, GltfReport& report) {
    const auto& asset = document["asset"];
    const std::string version = asset["version"];
    if (version != "2" && !version.starts_with("2.")) {
        report.fail("asset.version", "is {}, but only glTF 2.0 is supported: convert the file, or export it anew",
                    version);
    }
    const std::string least = asset.value("minVersion", "2.0");
    report.tolerate("the file will be drawn as glTF 2.0", [&] {
        if (least != "2.0") {
            report.fail("asset.minVersion", "is {}, but only glTF 2.0 is supported", least);
        }
    });
}

struct UnsupportedExtension {
    std::string_view name;
    std::string_view consequence;
};
constexpr std::array<UnsupportedExtension, 2> unsupportedExtensions{
    {{"EXT_texture_avif", "AVIF textures will be missing"},
     {"EXT_lights_image_based", "image-based light will be missing"}}};

/// How the rendered image differs from what the file asks for; empty if that is not known.
std::string_view consequenceOf(std::string_view extension) {
    const auto* const found = std::ranges::find(unsupportedExtensions, extension, &UnsupportedExtension::name);
    return found != unsupportedExtensions.end()                 ? found->consequence
           : extension.find("_materials_") != std::string::npos ? "materials will look different"
                                                                : "";
}

bool isHarmless(const std::string& extension) {
    const auto& harmless = gltf_schema::harmlessExtensions;
    return std::ranges::find(harmless, extension) != harmless.end();
}

/// A required extension can be done without if the consequence is known.
void checkExtensions(const json& document, GltfReport& report) {
    std::set<std::string> told;
    for (const std::string name : arrayIn(document, "extensionsRequired")) {
        const std::string_view consequence = consequenceOf(name);
        const auto check = [&] {
            if (!knownGltfExtension(name) && !isHarmless(name)) {
                report.fail("extensionsRequired", "{} is not supported: export the file without it", name);
            }
        };
        if (consequence.empty()) {
            check();
        } else if (!report.tolerate(consequence, check)) {
            told.insert(name);
        }
    }
    for (const std::string name : arrayIn(document, "extensionsUsed")) {
        if (!knownGltfExtension(name) && !isHarmless(name) && told.insert(name).second) {
            const std::string_view consequence = consequenceOf(name);
            report.warn("extension " + name, "extensionsUsed", "{}: {} is not supported",
                        consequence.empty() ? "the extension will be ignored" : consequence, name);
        }
    }
}

/// A buffer without a URI is the binary chunk of a .glb; only the first buffer may be.
std::vector<uint8_t> readBuffer(const json& buffer, const std::string& part, GltfContainer& container,
                                const std::filesystem::path& folder, GltfReport& report) {
    const auto length = buffer["byteLength"].get<uint64_t>();
    std::vector<uint8_t> bytes;
    if (buffer.contains("uri")) {
        bytes = readUri(buffer["uri"], folder, length, part + ".uri", report);
    } else if (part == "buffers[0]" && container.bin) {
        bytes = std::move(*container.bin);
    } else {
        report.fail(part, "has neither a uri nor a binary chunk");
    }
    report.tolerate("what lies beyond its end will be missing", [&] {
        if (bytes.size() < length) {
            report.fail(part, "has {} bytes, but its byteLength is {}", bytes.size(), length);
        }
    });
    bytes.resize(std::min<uint64_t>(bytes.size(), length));
    return bytes;
}

/// Per buffer the first that is the same part of the same file; its own index if there is none before it.
std::vector<size_t> firstOfEqualBuffers(const json& document) {
    std::vector<size_t> firsts;
    std::map<std::pair<std::string_view, uint64_t>, size_t> seen;
    for (const json& buffer : arrayIn(document, "buffers")) {
        size_t first = firsts.size();
        if (buffer.contains("uri") && !isMeshoptFallback(buffer)) {
            const std::string_view uri = buffer["uri"].get_ref<const std::string&>();
            first = seen.try_emplace({uri, buffer["byteLength"].get<uint64_t>()}, first).first->second;
        }
        firsts.push_back(first);
    }
    return firsts;
}

/// Views of equal buffers are views of the first of them: the others need not be read. Returns firstOfEqualBuffers.
std::vector<size_t> shareEqualBuffers(json& document) {
    std::vector<size_t> firsts = firstOfEqualBuffers(document);
    const auto share = [&](json& object) {
        const auto buffer = object.find("buffer");
        if (buffer != object.end() && buffer->is_number_unsigned() && buffer->get<size_t>() < firsts.size()) {
            *buffer = firsts[buffer->get<size_t>()];
        }
    };
    if (const auto views = document.find("bufferViews"); views != document.end()) {
        for (json& view : *views) {
            share(view);
            if (const auto extensions = view.find("extensions"); extensions != view.end()) {
                std::ranges::for_each(*extensions, share);  // of meshopt
            }
        }
    }
    return firsts;
}

void readBuffers(const json& document, GltfContainer& container, const std::vector<size_t>& firsts,
                 GltfDocument& result, GltfReport& report) {
    size_t i = 0;
    for (const json& buffer : arrayIn(document, "buffers")) {
        const std::string part = fmt::format("buffers[{}]", i);
        tinygltf::Buffer read;
        report.tolerateUntilUsed("buffers", i, [&] {
            if (firsts[i] == i && !isMeshoptFallback(buffer)) {
                read.data = readBuffer(buffer, part, container, result.folder, report);
            }
        });
        report.charge(part, read.data.size());
        result.model.buffers.push_back(std::move(read));
        ++i;
    }
}

void listImages(const json& document, GltfDocument& result) {
    for (const json& image : arrayIn(document, "images")) {
        tinygltf::Image listed;
        listed.name = image.value("name", "");
        listed.uri = image.value("uri", "");
        listed.bufferView = image.value("bufferView", -1);
        result.model.images.push_back(std::move(listed));
    }
}

}  // namespace

GltfDocument readGltfDocument(const std::filesystem::path& path, GltfReport& report, int scene) {
    GltfContainer container = readGltfContainer(path, report);
    GltfDocument result;
    result.folder = path.parent_path();
    json document = checkedGltfDocument(std::move(container.document), report);
    checkVersion(document, report);
    checkExtensions(document, report);
    const std::vector<size_t> firsts = shareEqualBuffers(document);
    static_cast<GltfStructure&>(result) = takeGltfStructure(document, scene, report);
    readBuffers(document, container, firsts, result, report);
    decodeMeshopt(document, result.model, report);
    listImages(document, result);
    checkGltfBuffers(result.model, report);
    checkGltfNodes(result, report);
    return result;
}

}  // namespace reflet
