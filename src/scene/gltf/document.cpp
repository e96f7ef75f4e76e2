// Reads a glTF file: container, schema check, parsing by tinygltf, buffers, cross-checks.
// tinygltf gets a document without buffers and images, because its own loading of them falls back to the working
// folder, decodes '+' in a file name as a space, decodes every image and has no limits.
#include "scene/gltf/document.h"

#include "base/json_text.h"
#include "scene/gltf/container.h"
#include "scene/gltf/meshopt.h"
#include "scene/gltf/schema.h"
#include "scene/gltf/schema_tables.h"
#include "scene/gltf/uri.h"

#include <algorithm>
#include <array>
#include <new>
#include <set>
#include <string_view>

namespace reflet {

namespace {

using nlohmann::json;

/// The array of this name in a checked document; empty if there is none.
const json& arrayOf(const json& document, const char* name) {
    static const json none = json::array();
    const auto found = document.find(name);
    return found != document.end() ? *found : none;
}

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
constexpr std::array<UnsupportedExtension, 3> unsupportedExtensions{
    {{"EXT_texture_avif", "AVIF textures will be missing"},
     {"KHR_animation_pointer", "animated materials, lamps and cameras will stand still"},
     {"EXT_lights_image_based", "image-based light will be missing"}}};

/// How the rendered image differs from what the file asks for; empty if that is not known.
std::string_view consequenceOf(std::string_view extension) {
    const auto found = std::ranges::find(unsupportedExtensions, extension, &UnsupportedExtension::name);
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
    for (const std::string name : arrayOf(document, "extensionsRequired")) {
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
    for (const std::string name : arrayOf(document, "extensionsUsed")) {
        if (!knownGltfExtension(name) && !isHarmless(name) && told.insert(name).second) {
            const std::string_view consequence = consequenceOf(name);
            report.warn("extension " + name, "extensionsUsed", "{}: {} is not supported",
                        consequence.empty() ? "the extension will be ignored" : consequence, name);
        }
    }
}

/// Removes the primitives' indices, because tinygltf rejects the accessors without a buffer view that Draco uses there.
/// restoreIndices puts them back.
void removeIndices(json& document) {
    const auto meshes = document.find("meshes");
    if (meshes == document.end()) {
        return;
    }
    for (auto& mesh : *meshes) {
        for (auto& primitive : mesh["primitives"]) {
            primitive.erase("indices");
        }
    }
}

void restoreIndices(tinygltf::Model& model, const json& document, const GltfReport& report) {
    const json& meshes = arrayOf(document, "meshes");
    for (size_t m = 0; m < meshes.size(); ++m) {
        const auto& primitives = meshes[m]["primitives"];
        if (model.meshes.size() <= m || model.meshes[m].primitives.size() != primitives.size()) {
            report.fail(fmt::format("meshes[{}]", m), "cannot be parsed by tinygltf");
        }
        for (size_t p = 0; p < primitives.size(); ++p) {
            model.meshes[m].primitives[p].indices = primitives[p].value("indices", -1);
        }
    }
}

void noteMaterials(const json& primitive, std::set<uint64_t>& used) {
    if (const auto material = primitive.find("material"); material != primitive.end()) {
        used.insert(material->get<uint64_t>());
    }
    const auto pointer = json::json_pointer("/extensions/KHR_materials_variants/mappings");
    if (primitive.contains(pointer)) {
        for (const json& mapping : primitive.at(pointer)) {
            used.insert(mapping.at("material").get<uint64_t>());
        }
    }
}

/// The document's materials; those that no mesh uses are empty objects: a file may have many of them.
json usedMaterials(const json& document) {
    std::set<uint64_t> used;
    for (const json& mesh : arrayOf(document, "meshes")) {
        for (const json& primitive : mesh.at("primitives")) {
            noteMaterials(primitive, used);
        }
    }
    json materials = json::array();
    for (const json& material : arrayOf(document, "materials")) {
        materials.push_back(used.contains(materials.size()) ? material : json::object());
    }
    return materials;
}

tinygltf::Model parseStructure(const json& document, const GltfReport& report) {
    json structure = json::object();
    for (const auto& [name, value] : document.items()) {
        if (name == "materials") {
            structure[name] = usedMaterials(document);
        } else if (name != "buffers" && name != "images") {
            structure[name] = value;
        }
    }
    removeIndices(structure);
    const std::string text = jsonText(structure);
    structure = nullptr;
    tinygltf::Model model;
    std::string errors;
    std::string warnings;
    tinygltf::TinyGLTF loader;
    if (!loader.LoadASCIIFromString(&model, &errors, &warnings, text.data(), static_cast<unsigned>(text.size()), "")) {
        if (errors.find("bad_alloc") != std::string::npos) {  // tinygltf makes a text of it
            throw std::bad_alloc();
        }
        report.fail("JSON", "tinygltf: {}", errors.substr(0, errors.find('\n')));
    }
    restoreIndices(model, document, report);
    return model;
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

void readBuffers(const json& document, GltfContainer& container, GltfDocument& result, GltfReport& report) {
    size_t i = 0;
    for (const json& buffer : arrayOf(document, "buffers")) {
        const std::string part = fmt::format("buffers[{}]", i);
        tinygltf::Buffer read;
        report.tolerateUntilUsed("buffers", i, [&] {
            if (!isMeshoptFallback(buffer)) {
                read.data = readBuffer(buffer, part, container, result.folder, report);
            }
        });
        report.charge(part, read.data.size());
        result.model.buffers.push_back(std::move(read));
        ++i;
    }
}

void listImages(const json& document, GltfDocument& result) {
    for (const json& image : arrayOf(document, "images")) {
        tinygltf::Image listed;
        listed.name = image.value("name", "");
        listed.uri = image.value("uri", "");
        listed.bufferView = image.value("bufferView", -1);
        result.model.images.push_back(std::move(listed));
    }
}

}  // namespace

GltfDocument readGltfDocument(const std::filesystem::path& path, GltfReport& report) {
    GltfContainer container = readGltfContainer(path, report);
    GltfDocument result;
    result.folder = path.parent_path();
    const json document = checkedGltfDocument(container.document, report);
    container.document = nullptr;
    checkVersion(document, report);
    checkExtensions(document, report);
    result.model = parseStructure(document, report);
    readBuffers(document, container, result, report);
    decodeMeshopt(document, result.model, report);
    listImages(document, result);
    checkGltfBuffers(result.model, report);
    checkGltfNodes(result, report);
    return result;
}

}  // namespace reflet
