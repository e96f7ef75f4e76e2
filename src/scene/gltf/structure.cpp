// Parses a document by tinygltf, in pieces: tinygltf takes text only, so that what it reads is in memory three times,
// as text, as its own JSON and as structures. A piece has few elements of one array, and each element of the document
// is freed when its text is written.
#include "scene/gltf/structure.h"

#include "base/json_text.h"
#include "scene/gltf/used.h"

#include <new>
#include <string_view>

namespace reflet {

namespace {

using nlohmann::json;

constexpr size_t pieceBytes = size_t{1} << 20U;
constexpr std::string_view pieceHead = R"({"asset":{"version":"2.0"},")";

tinygltf::Model parsePiece(const std::string& text, const GltfReport& report) {
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
    return model;
}

/// Empties an array of the document, piece by piece. `take` gets the structures of each, in their order.
/// wanted: per element, whether it is read; empty: all are.
template <class Element, class Take>
void takeArray(json& document, const char* name, std::vector<Element> tinygltf::Model::*member,
               const std::vector<bool>& wanted, const GltfReport& report, const Take& take) {
    const auto array = document.find(name);
    if (array == document.end()) {
        return;
    }
    const std::string head = std::string(pieceHead) + name + "\":[";
    std::string text = head;
    size_t pending = 0;
    const auto flush = [&] {
        text.back() = ']';  // it was a comma
        text += '}';
        std::vector<Element> elements = std::move(parsePiece(text, report).*member);
        if (elements.size() != pending) {
            report.fail(name, "cannot be parsed by tinygltf");
        }
        for (Element& element : elements) {
            take(std::move(element));
        }
        text = head;
        pending = 0;
    };
    for (size_t i = 0; i < array->size(); ++i) {
        json element = std::move((*array)[i]);
        if (!wanted.empty() && !wanted[i]) {
            continue;
        }
        text += jsonText(element) + ',';
        ++pending;
        if (text.size() >= pieceBytes) {
            flush();
        }
    }
    if (pending > 0) {
        flush();
    }
    document.erase(array);
}

/// Takes the whole array into the model.
template <class Element>
void takeAll(json& document, const char* name, std::vector<Element> tinygltf::Model::*member, tinygltf::Model& model,
             const GltfReport& report) {
    takeArray(document, name, member, {}, report,
              [&](Element&& element) { (model.*member).push_back(std::move(element)); });
}

/// Takes what is wanted into a map by the elements' indices.
template <class Key, class Element>
void takeUsed(json& document, const char* name, std::vector<Element> tinygltf::Model::*member,
              const std::vector<bool>& used, std::map<Key, Element>& to, const GltfReport& report) {
    size_t next = 0;
    takeArray(document, name, member, used, report, [&](Element&& element) {
        while (!used[next]) {
            ++next;
        }
        to.emplace_hint(to.end(), static_cast<Key>(next++), std::move(element));
    });
}

/// Removes the primitives' indices, because tinygltf rejects the accessors without a buffer view that Draco uses there.
/// Returns them, of all primitives in their order.
std::vector<int> removeIndices(json& document) {
    std::vector<int> indices;
    if (const auto meshes = document.find("meshes"); meshes != document.end()) {
        for (json& mesh : *meshes) {
            for (json& primitive : mesh["primitives"]) {
                indices.push_back(primitive.value("indices", -1));
                primitive.erase("indices");
            }
        }
    }
    return indices;
}

void restoreIndices(tinygltf::Model& model, const std::vector<int>& indices, const GltfReport& report) {
    size_t next = 0;
    for (tinygltf::Mesh& mesh : model.meshes) {
        for (tinygltf::Primitive& primitive : mesh.primitives) {
            primitive.indices = next < indices.size() ? indices[next] : -1;
            ++next;
        }
    }
    if (next != indices.size()) {
        report.fail("meshes", "cannot be parsed by tinygltf");
    }
}

/// Channels with a pointer have no node, but tinygltf leaves out channels without one.
void nameNodesOfPointers(json& document) {
    const auto animations = document.find("animations");
    if (animations == document.end()) {
        return;
    }
    for (json& animation : *animations) {
        for (json& channel : animation["channels"]) {
            json& target = channel["target"];
            if (hasGltfPointer(target) && !target.contains("node")) {
                target["node"] = 0;
            }
        }
    }
}

/// Of each buffer view its extensions alone, which tinygltf need not read; null: it has none.
json takeViewExtensions(json& document) {
    json result = json::array();
    if (const auto views = document.find("bufferViews"); views != document.end()) {
        for (json& view : *views) {
            json kept;
            if (const auto extensions = view.find("extensions"); extensions != view.end()) {
                kept["extensions"] = std::move(*extensions);
                view.erase(extensions);
            }
            result.push_back(std::move(kept));
        }
    }
    return result;
}

/// All that is in no array of its own: extensions, with lamps and variants, and the default scene.
json restOf(const json& document) {
    json rest = json::object();
    for (const auto& [name, value] : document.items()) {
        if (name != "buffers" && name != "images") {
            rest[name] = value;
        }
    }
    return rest;
}

}  // namespace

GltfStructure takeGltfStructure(json& document, int scene, const GltfReport& report) {
    const std::vector<bool> materials = usedGltfMaterials(document);
    const std::vector<bool> animations = usedGltfAnimations(document, scene);
    const std::vector<int> indices = removeIndices(document);
    nameNodesOfPointers(document);
    GltfStructure result;
    result.materialCount = materials.size();
    takeUsed(document, "materials", &tinygltf::Model::materials, materials, result.materials, report);
    takeUsed(document, "animations", &tinygltf::Model::animations, animations, result.animations, report);
    tinygltf::Model arrays;
    json viewExtensions = takeViewExtensions(document);
    takeAll(document, "bufferViews", &tinygltf::Model::bufferViews, arrays, report);
    takeAll(document, "accessors", &tinygltf::Model::accessors, arrays, report);
    takeAll(document, "meshes", &tinygltf::Model::meshes, arrays, report);
    takeAll(document, "nodes", &tinygltf::Model::nodes, arrays, report);
    takeAll(document, "textures", &tinygltf::Model::textures, arrays, report);
    takeAll(document, "samplers", &tinygltf::Model::samplers, arrays, report);
    takeAll(document, "cameras", &tinygltf::Model::cameras, arrays, report);
    takeAll(document, "skins", &tinygltf::Model::skins, arrays, report);
    takeAll(document, "scenes", &tinygltf::Model::scenes, arrays, report);
    result.model = parsePiece(jsonText(restOf(document)), report);
    document["bufferViews"] = std::move(viewExtensions);
    result.model.bufferViews = std::move(arrays.bufferViews);
    result.model.accessors = std::move(arrays.accessors);
    result.model.meshes = std::move(arrays.meshes);
    result.model.nodes = std::move(arrays.nodes);
    result.model.textures = std::move(arrays.textures);
    result.model.samplers = std::move(arrays.samplers);
    result.model.cameras = std::move(arrays.cameras);
    result.model.skins = std::move(arrays.skins);
    result.model.scenes = std::move(arrays.scenes);
    restoreIndices(result.model, indices, report);
    return result;
}

}  // namespace reflet
