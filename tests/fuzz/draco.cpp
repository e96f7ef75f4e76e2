// Draco payloads. What the decoder takes is also loaded as a scene, which uses the decoded mesh.
#include "scene/gltf/draco.h"
#include "fixed_scene.h"

#include <fmt/format.h>

namespace {

using namespace reflet;

tinygltf::Primitive dracoPrimitive() {
    using tinygltf::Value;
    tinygltf::Primitive primitive;
    primitive.attributes = {{"POSITION", 0}, {"NORMAL", 1}};
    const Value ids(Value::Object{{"POSITION", Value(0)}, {"NORMAL", Value(1)}});
    primitive.extensions["KHR_draco_mesh_compression"] =
        Value(Value::Object{{"bufferView", Value(0)}, {"attributes", ids}});
    return primitive;
}

std::string documentWith(size_t payload) {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"extensionsUsed":["KHR_draco_mesh_compression"],)"
        R"("buffers":[{{"byteLength":{0}}}],"bufferViews":[{{"buffer":0,"byteLength":{0}}}],)"
        R"("accessors":[{{"componentType":5126,"count":4,"type":"VEC3"}},{{"componentType":5126,"count":4,"type":"VEC3"}},)"
        R"({{"componentType":5123,"count":6,"type":"SCALAR"}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,)"
        R"("NORMAL":1}},"indices":2,"extensions":{{"KHR_draco_mesh_compression":{{"bufferView":0,"attributes":)"
        R"({{"POSITION":0,"NORMAL":1}}}}}}}}]}}],"nodes":[{{"mesh":0}}],"scenes":[{{"nodes":[0]}}]}})",
        payload);
}

}  // namespace

FUZZ_TARGET(draco) {
    static const tinygltf::Primitive primitive = dracoPrimitive();
    if (size == 0) {
        return 0;
    }
    return survive([&] {
        GltfDocument document = documentOf(bytes, size);
        tinygltf::Accessor accessor;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.type = TINYGLTF_TYPE_VEC3;
        document.model.accessors.assign(2, accessor);
        GltfReport report("payload.glb", {}, true);
        const DracoPrimitive decoded = decodeDraco(document, primitive, "meshes[0].primitives[0]", report);
        for (const uint32_t index : decoded.indices) {
            if (index >= decoded.attributes.at("POSITION").count) {
                finding("an index past the vertices");
            }
        }
        loadGlb(documentWith(size), {reinterpret_cast<const char*>(bytes), size});
    });
}
