// Invalid glTF documents: each is reported in one line that names the file and the invalid part, as an error or as a
// warning.
#include "gltf_builder.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>

namespace reflet::test::gltf_broken_test {
namespace {

using nlohmann::json;

struct BrokenCase {
    const char* name;
    std::function<void(GltfBuilder&)> breakIt;
    const char* starts;  ///< how the message starts: the part
    const char* says = "";
    const char* consequence = nullptr;  ///< of the warning if loading is not strict; null: it is an error

    [[nodiscard]] BrokenCase warns(const char* text) const {
        BrokenCase result = *this;
        result.consequence = text;
        return result;
    }
};

std::ostream& operator<<(std::ostream& stream, const BrokenCase& broken) {
    return stream << broken.name;
}

BrokenCase set(const char* name, const char* pointer, const json& value, const char* starts, const char* says = "") {
    return {name, [=](GltfBuilder& b) { b.document[json::json_pointer(pointer)] = value; }, starts, says};
}

BrokenCase erase(const char* name, const char* pointer, const char* key, const char* starts) {
    return {name, [=](GltfBuilder& b) { b.document[json::json_pointer(pointer)].erase(key); }, starts, "is missing"};
}

/// Overwrites bytes of a view of everything().
template <class T>
BrokenCase poke(const char* name, size_t view, size_t element, T value, const char* starts, const char* says) {
    return {name,
            [=](GltfBuilder& b) {
                const size_t at = b.document["bufferViews"][view]["byteOffset"];
                std::memcpy(b.bin.data() + at + element * sizeof(T), &value, sizeof(T));
            },
            starts, says};
}

constexpr const char* noPrimitive = "the primitive will not be drawn";
constexpr const char* noMesh = "the mesh will not be drawn";
constexpr const char* noTexture = "the texture will be left out";
constexpr const char* noCamera = "the camera will be missing";
constexpr const char* noLamp = "the lamp will be missing";
constexpr const char* defaultUsed = "its default will be used";

class BrokenGltf : public ::testing::TestWithParam<BrokenCase> {};

TEST_P(BrokenGltf, IsAnErrorIfStrictAndElseAWarningWhereTheRestCanBeDrawn) {
    GltfBuilder b = everything();
    GetParam().breakIt(b);
    const auto folder = testFolder();
    for (const auto& path : {b.writeGltf(folder / "a.gltf"), [&] {
                                 b.document.erase("buffers");
                                 return b.writeGlb(folder / "b.glb");
                             }()}) {
        const std::string message = expectProblem(path, GetParam().starts, GetParam().consequence);
        EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
    }
}

std::string caseName(const ::testing::TestParamInfo<BrokenCase>& info) {
    return info.param.name;
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Header, BrokenGltf,
    ::testing::Values(
        erase("NoAsset", "", "asset", "asset: "), erase("NoVersion", "/asset", "version", "asset.version: "),
        set("Version1", "/asset/version", "1.0", "asset.version: is 1.0"),
        set("VersionNumber", "/asset/version", 2.0, "asset.version: is a number, not a string"),
        set("MinVersion", "/asset/minVersion", "2.1", "asset.minVersion: is 2.1")
            .warns("the file will be drawn as glTF 2.0"),
        set("RequiredExtension", "/extensionsRequired", {"ACME_holograms"}, "extensionsRequired: ", "ACME_holograms"),
        set("NodesAreAnObject", "/nodes", json::object(), "nodes: is an object, not an array"),
        set("NodeIsANumber", "/nodes/1", 7, "nodes[1]: is a number, not an object").warns("the node will not be drawn"),
        set("ScenesAreNull", "/scenes", nullptr, "scenes: is null, not an array").warns(defaultUsed)),
    caseName);

INSTANTIATE_TEST_SUITE_P(
    IndexOutOfRange, BrokenGltf,
    ::testing::Values(
        set("Scene", "/scene", 5, "scene: is 5, but there are 1 scenes").warns(defaultUsed),
        set("SceneNode", "/scenes/0/nodes/0", 99, "scenes[0].nodes[0]: is 99, but there are 5 nodes"),
        set("Child", "/nodes/0/children/1", 99, "nodes[0].children[1]: is 99").warns("the node will not be drawn"),
        set("NodeMesh", "/nodes/1/mesh", 2, "nodes[1].mesh: is 2, but there are 2 meshes").warns(noMesh),
        set("NodeCamera", "/nodes/1/camera", 1, "nodes[1].camera: is 1").warns(noCamera),
        set("NodeSkin", "/nodes/1/skin", 0, "nodes[1].skin: is 0, but there are 0 skins")
            .warns("the mesh will not be deformed"),
        set("NodeLight", "/nodes/3/extensions/KHR_lights_punctual/light", 2,
            "nodes[3].extensions.KHR_lights_punctual.light: is 2, but there are 2 lights")
            .warns(noLamp),
        set("Attribute", "/meshes/0/primitives/0/attributes/NORMAL", 50,
            "meshes[0].primitives[0].attributes.NORMAL: is 50")
            .warns("the attribute will be missing"),
        set("MorphTarget", "/meshes/0/primitives/0/targets", json::array({{{"POSITION", 50}}}),
            "meshes[0].primitives[0].targets[0].POSITION: is 50")
            .warns("the mesh will keep its base shape"),
        set("Indices", "/meshes/0/primitives/0/indices", -1, "meshes[0].primitives[0].indices: is -1")
            .warns(noPrimitive),
        set("PrimitiveMaterial", "/meshes/0/primitives/0/material", 1, "meshes[0].primitives[0].material: is 1")
            .warns(defaultUsed),
        set("MaterialTexture", "/materials/0/normalTexture/index", 2, "materials[0].normalTexture.index: is 2")
            .warns(noTexture),
        set("TextureImage", "/textures/1/source", 2, "textures[1].source: is 2, but there are 2 images")
            .warns(noTexture),
        set("TextureSampler", "/textures/0/sampler", 1, "textures[0].sampler: is 1").warns(defaultUsed),
        set("ImageView", "/images/0/bufferView", 99, "images[0].bufferView: is 99").warns(noTexture),
        set("AccessorView", "/accessors/0/bufferView", 99, "accessors[0].bufferView: is 99").warns(noPrimitive),
        set("SparseIndicesView", "/accessors/4/sparse/indices/bufferView", 99,
            "accessors[4].sparse.indices.bufferView: is 99")
            .warns(noPrimitive),
        set("SparseValuesView", "/accessors/4/sparse/values/bufferView", 99,
            "accessors[4].sparse.values.bufferView: is 99")
            .warns(noPrimitive),
        set("ViewBuffer", "/bufferViews/0/buffer", 1, "bufferViews[0].buffer: is 1, but there are 1 buffers")
            .warns(noPrimitive),
        set("DracoView", "/meshes/1/primitives/0/extensions/KHR_draco_mesh_compression/bufferView", 99,
            "meshes[1].primitives[0].extensions.KHR_draco_mesh_compression.bufferView: is 99")
            .warns(noPrimitive),
        set("DracoAttribute", "/meshes/1/primitives/0/extensions/KHR_draco_mesh_compression/attributes/NORMAL", 9,
            "meshes[1].primitives[0].extensions.KHR_draco_mesh_compression.attributes.NORMAL: ", "9")
            .warns(noPrimitive),
        set("HalfAnIndex", "/nodes/1/mesh", 0.5, "nodes[1].mesh: is 0.5, not an integer").warns(noMesh),
        set("IndexIsText", "/nodes/1/mesh", "0", "nodes[1].mesh: is a string").warns(noMesh)),
    caseName);

INSTANTIATE_TEST_SUITE_P(
    Reach, BrokenGltf,
    ::testing::Values(
        set("AccessorPastItsView", "/accessors/0/count", 5, "accessors[0]: reaches 12 bytes past bufferViews[0]")
            .warns(noPrimitive),
        set("AccessorOffset", "/accessors/0/byteOffset", 4, "accessors[0]: reaches 4 bytes past bufferViews[0]")
            .warns(noPrimitive),
        set("ViewPastItsBuffer", "/bufferViews/0/byteLength", 1000000, "bufferViews[0]: reaches ", "past buffers[0]")
            .warns(noPrimitive),
        set("HugeCount", "/accessors/0/count", 4294967294U, "accessors[0]: reaches ").warns(noPrimitive),
        set("CountOverflow", "/accessors/0/count", 18446744073709551615U, "accessors[0].count: is ").warns(noPrimitive),
        set("NoCount", "/accessors/0/count", 0, "accessors[0].count: is 0").warns(noPrimitive),
        set("OffsetOverflow", "/accessors/0/byteOffset", 18446744073709551608U, "accessors[0].byteOffset: is ")
            .warns(noPrimitive),
        set("NegativeOffset", "/accessors/0/byteOffset", -12, "accessors[0].byteOffset: is -12").warns(noPrimitive),
        set("ViewOffsetOverflow", "/bufferViews/0/byteOffset", 9007199254740992U, "bufferViews[0]: reaches ")
            .warns(noPrimitive),
        set("NegativeStride", "/bufferViews/0/byteStride", -12, "bufferViews[0].byteStride: is -12").warns(noPrimitive),
        set("HugeStride", "/bufferViews/0/byteStride", 256, "bufferViews[0].byteStride: is 256").warns(noPrimitive),
        set("StrideBelowElement", "/bufferViews/0/byteStride", 8, "accessors[0]: has elements of 12 bytes",
            "bufferViews[0].byteStride is 8")
            .warns(noPrimitive),
        set("StrideOfThirteen", "/bufferViews/0/byteStride", 13,
            "bufferViews[0].byteStride: is 13, not a multiple of 4")
            .warns(noPrimitive),
        set("Misaligned", "/bufferViews/1/byteOffset", 1, "accessors[1]: is misaligned")
            .warns("it will be read as it is"),
        set("ComponentType", "/accessors/0/componentType", 5124, "accessors[0].componentType: is 5124")
            .warns(noPrimitive),
        set("AccessorType", "/accessors/0/type", "VEC5", "accessors[0].type: is \"VEC5\"").warns(noPrimitive),
        set("SparseCount", "/accessors/4/sparse/count", 5, "accessors[4].sparse.count: is 5").warns(noPrimitive),
        set("SparseIndicesReach", "/accessors/4/sparse/count", 2, "accessors[4].sparse.indices: reaches 2 bytes past")
            .warns(noPrimitive),
        set("SparseValuesOffset", "/accessors/4/sparse/values/byteOffset", 4,
            "accessors[4].sparse.values: reaches 4 bytes past")
            .warns(noPrimitive),
        set("UnbackedCount", "/accessors/0", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4000000000U}},
            "accessors[0]: has 4000000000 elements without a buffer view")
            .warns(noPrimitive),
        BrokenCase{"BufferShorterThanItSays",
                   [](GltfBuilder& b) {
                       b.add("buffers", {{"byteLength", b.bin.size() + 100},
                                         {"uri", "data:application/octet-stream;base64," + base64(b.bin)}});
                       b.document["bufferViews"][0]["byteLength"] = 1U << 30U;  // reported by the .glb's reader
                   },
                   "buffer", "", ""}),
    caseName);

INSTANTIATE_TEST_SUITE_P(
    Geometry, BrokenGltf,
    ::testing::Values(
        poke("NanPosition", 0, 4, nan, "meshes[0].primitives[0].attributes.POSITION: ", "vertex 1 is not finite")
            .warns("triangles will be missing"),
        poke("InfinitePosition", 0, 4, infinity, "meshes[0].primitives[0].attributes.POSITION: ", "vertex 1")
            .warns("triangles will be missing"),
        poke<uint16_t>("IndexPastTheVertices", 3, 2, 4, "accessors[3]: index 2 is 4, but there are 4 vertices", "")
            .warns("triangles will be missing"),
        poke<uint16_t>("RestartIndex", 3, 2, 0xFFFF, "accessors[3]: index 2 is 65535", "primitive restart")
            .warns("triangles will be missing"),
        poke<uint16_t>("SparseIndexPastTheEnd", 4, 0, 4, "accessors[4].sparse.indices: index 0 is 4", "4 elements")
            .warns(noPrimitive),
        set("WordRestartIndex", "/accessors/3",
            {{"bufferView", 1}, {"componentType", uintType}, {"type", "SCALAR"}, {"count", 3}, {"byteOffset", 8}},
            "accessors[3]: index 0 is 1065353216")
            .warns("triangles will be missing"),
        set("SevenIndices", "/accessors/3/count", 5, "meshes[0].primitives[0]: 5 indices do not make whole triangles")
            .warns("the incomplete triangle will be missing"),
        set("PositionsOfTwo", "/accessors/0/type", "VEC2", "accessors[0]: has 2 components, but a POSITION has 3")
            .warns(noPrimitive),
        set("PositionsOfWords", "/accessors/0/componentType", uintType, "accessors[0].componentType: is 5125")
            .warns(noPrimitive),
        set("FloatIndices", "/meshes/0/primitives/0/indices", 2, "accessors[2].componentType: is 5126")
            .warns(noPrimitive),
        set("VectorIndices", "/accessors/3",
            {{"bufferView", 3}, {"componentType", ushortType}, {"type", "VEC2"}, {"count", 3}},
            "accessors[3].type: is not SCALAR")
            .warns(noPrimitive),
        set("TooFewNormals", "/accessors/1/count", 3, "meshes[0].primitives[0].attributes.NORMAL: has 3 vertices")
            .warns("the surface will be faceted"),
        set("Mode", "/meshes/0/primitives/0/mode", 7, "meshes[0].primitives[0].mode: is 7").warns(noPrimitive),
        erase("NoAttributes", "/meshes/0/primitives/0", "attributes", "meshes[0].primitives[0].attributes: ")
            .warns(noPrimitive),
        erase("NoPrimitives", "/meshes/0", "primitives", "meshes[0].primitives: ").warns(noMesh)),
    caseName);

INSTANTIATE_TEST_SUITE_P(
    Nodes, BrokenGltf,
    ::testing::Values(
        set("Cycle", "/nodes/4/children", {3}, "nodes[3]: has two parents")
            .warns("the node will be drawn below the first of its parents"),
        set("RootInACycle", "/nodes/4/children", {0}, "nodes[0]: is in a cycle of nodes, or below one")
            .warns("the node will be drawn as a root"),
        set("OwnChild", "/nodes/4/children", {4}, "nodes[4]: has two parents")
            .warns("the node will be drawn below the first of its parents"),
        set("TwoParents", "/nodes/3/children", {4, 1}, "nodes[1]: has two parents")
            .warns("the node will be drawn below the first of its parents"),
        set("SceneNamesAChild", "/scenes/0/nodes", {0, 4}, "scenes[0].nodes: lists nodes[4]", "child")
            .warns("the node will be drawn once"),
        set("SceneNamesTwice", "/scenes/0/nodes", {0, 0}, "scenes[0].nodes: lists nodes[0]", "already")
            .warns("the node will be drawn once"),
        set("ShortMatrix", "/nodes/1/matrix", {1, 0, 0}, "nodes[1].matrix: has 3 elements, not 16").warns(defaultUsed),
        set("ProjectiveMatrix", "/nodes/1/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
            "nodes[1].matrix: its last row")
            .warns("its last row will be taken for 0 0 0 1"),
        set("HugeTranslation", "/nodes/0/translation", {1e300, 0, 0}, "nodes[0].translation[0]: is 1e+300")
            .warns(defaultUsed),
        set("HugeProduct", "/nodes/0/scale", {1e38, 1e38, 3e38}, "nodes[4]: its transform to the world is not finite")
            .warns("the node and those below it will not be drawn"),
        set("MeshAtInfinity", "/nodes/1", {{"mesh", 0}, {"scale", {3e38, 3e38, 3e38}}},
            "nodes[1]: its mesh extends beyond")
            .warns(noMesh),
        set("NoRotation", "/nodes/2/rotation", {0, 0, 0, 0}, "nodes[2].rotation: is not a rotation")
            .warns("the node will not be rotated"),
        set("NullScale", "/nodes/2/scale", {1, nullptr, 1}, "nodes[2].scale[1]: is null, not a number")
            .warns(defaultUsed),
        set("CameraType", "/cameras/0/type", "fisheye", "cameras[0].type: is \"fisheye\"").warns(noCamera),
        set("CameraWithoutItsObject", "/cameras/0/type", "orthographic", "cameras[0].orthographic: is missing")
            .warns(noCamera),
        set("CameraAngle", "/cameras/0/perspective/yfov", 4, "cameras[0].perspective.yfov: is 4").warns(noCamera),
        set("CameraRange", "/cameras/0",
            {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 2}, {"zfar", 1}}}},
            "cameras[0].orthographic: zfar 1 is not beyond znear 2")
            .warns(noCamera),
        set("CameraRangeBelowAFloat", "/cameras/0",
            {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 2.9999999}, {"zfar", 3}}}},
            "cameras[0].orthographic: zfar 3 is not beyond znear 2.9999999")
            .warns(noCamera),
        set("LightTooBright", "/extensions/KHR_lights_punctual/lights/0/intensity", 3e38,
            "extensions.KHR_lights_punctual.lights[0].intensity: is 3e+38")
            .warns("1000000000000 will be used"),
        set("LightType", "/extensions/KHR_lights_punctual/lights/0/type", "area",
            "extensions.KHR_lights_punctual.lights[0].type: is \"area\"")
            .warns(noLamp),
        erase("SpotWithoutCone", "/extensions/KHR_lights_punctual/lights/1", "spot",
              "extensions.KHR_lights_punctual.lights[1].spot: ")
            .warns(noLamp),
        set("SpotCone", "/extensions/KHR_lights_punctual/lights/1/spot/innerConeAngle", 0.5,
            "extensions.KHR_lights_punctual.lights[1].spot: innerConeAngle 0.5")
            .warns("the edge of its cone will be sharp"),
        set("NegativeLight", "/extensions/KHR_lights_punctual/lights/0/intensity", -1,
            "extensions.KHR_lights_punctual.lights[0].intensity: is -1")
            .warns("0 will be used")),
    caseName);

INSTANTIATE_TEST_SUITE_P(
    Materials, BrokenGltf,
    ::testing::Values(
        set("Color", "/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1},
            "materials[0].pbrMetallicRoughness.baseColorFactor: has 3 elements, not 4")
            .warns(defaultUsed),
        set("Roughness", "/materials/0/pbrMetallicRoughness/roughnessFactor", 1.5,
            "materials[0].pbrMetallicRoughness.roughnessFactor: is 1.5")
            .warns("1 will be used"),
        set("AlphaMode", "/materials/0/alphaMode", "GLASS", "materials[0].alphaMode: is \"GLASS\"").warns(defaultUsed),
        set("Filter", "/samplers/0/magFilter", 9987, "samplers[0].magFilter: is 9987").warns(defaultUsed),
        erase("TextureIndex", "/materials/0/normalTexture", "index", "materials[0].normalTexture.index: ")
            .warns(noTexture),
        set("UvScale", "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/scale", {1},
            "materials[0].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform.scale: has 1")
            .warns(defaultUsed),
        poke<uint8_t>("NotAnImage", 6, 0, 0, "images[0]: is not a PNG", "").warns(noTexture),
        poke<uint8_t>("GiganticImage", 6, 17, 0x0F, "images[0]: claims 983042 x 2 pixels", "").warns(noTexture),
        poke<uint64_t>("AQuarterGigapixelInAFewBytes", 6, 2, 0x0040000000400000ULL, "images[0]: claims 16384 x 16384",
                       "")
            .warns(noTexture),
        poke<uint8_t>("TornImage", 6, 43, 0xFF, "images[0]: is a broken image", "").warns(noTexture),
        set("ImageWithoutSource", "/images/0", json::object(), "images[0]: has neither a uri nor a bufferView")
            .warns(noTexture)),
    caseName);

INSTANTIATE_TEST_SUITE_P(
    Uris, BrokenGltf,
    ::testing::Values(
        set("MissingFile", "/images/0", {{"uri", "gone.png"}}, "images[0].uri: there is no file ").warns(noTexture),
        set("Folder", "/images/0", {{"uri", "."}}, "images[0].uri: ", "is not a file").warns(noTexture),
        set("ParentFolder", "/images/0", {{"uri", "../x.png"}}, "images[0].uri: ../x.png leads out").warns(noTexture),
        set("ParentInside", "/images/0", {{"uri", "a/../../x.png"}}, "images[0].uri: ", "leads out").warns(noTexture),
        set("EncodedParent", "/images/0", {{"uri", "%2e%2E/x.png"}}, "images[0].uri: ", "leads out").warns(noTexture),
        set("EncodedSlash", "/images/0", {{"uri", "..%2Fx.png"}}, "images[0].uri: ", "leads out").warns(noTexture),
        set("Backslash", "/images/0", {{"uri", "..\\x.png"}}, "images[0].uri: ", "leads out").warns(noTexture),
        set("Absolute", "/images/0", {{"uri", "/etc/passwd"}}, "images[0].uri: /etc/passwd leads out").warns(noTexture),
        set("FileScheme", "/images/0", {{"uri", "file:///etc/passwd"}}, "images[0].uri: ", "is not a file")
            .warns(noTexture),
        set("Http", "/images/0", {{"uri", "http://example.com/x.png"}}, "images[0].uri: ", "is not a file")
            .warns(noTexture),
        set("EncodedScheme", "/images/0", {{"uri", "http%3A//example.com"}}, "images[0].uri: ", "is not a file")
            .warns(noTexture),
        set("Nul", "/images/0", {{"uri", "x%00.png"}}, "images[0].uri: ", "leads out").warns(noTexture),
        set("NewLine", "/images/0", {{"uri", "x\ny.png"}}, "images[0].uri: there is no file ").warns(noTexture),
        set("DataWithoutComma", "/images/0", {{"uri", "data:image/png;base64"}}, "images[0].uri: ", "without data")
            .warns(noTexture),
        set("DataNotBase64", "/images/0", {{"uri", "data:image/png;base64,iVBO*w0K"}}, "images[0].uri: character 4")
            .warns(noTexture),
        set("DataCutOff", "/images/0", {{"uri", "data:image/png;base64,iVBOR"}}, "images[0].uri: ", "truncated")
            .warns(noTexture)),
    caseName);

INSTANTIATE_TEST_SUITE_P(
    Draco, BrokenGltf,
    ::testing::Values(
        poke<uint8_t>("Magic", 8, 0, 'X', "meshes[1].primitives[0].extensions.KHR_draco_mesh_compression: ", "header")
            .warns(noPrimitive),
        poke<uint8_t>("Version", 8, 5, 1, "meshes[1].primitives[0].extensions.KHR_draco_mesh_compression: ", "2.2")
            .warns(noPrimitive),
        poke<uint8_t>("PointCloud", 8, 7, 0,
                      "meshes[1].primitives[0].extensions.KHR_draco_mesh_compression: ", "point cloud")
            .warns(noPrimitive),
        poke<uint32_t>("Claims", 8, 3, 0xFFFFFFFF,
                       "meshes[1].primitives[0].extensions.KHR_draco_mesh_compression: ", "")
            .warns(noPrimitive),
        set("CutOff", "/bufferViews/8/byteLength", 30,
            "meshes[1].primitives[0].extensions.KHR_draco_mesh_compression: its Draco data is broken")
            .warns(noPrimitive),
        set("UnknownAttribute", "/meshes/1/primitives/0/extensions/KHR_draco_mesh_compression/attributes",
            {{"POSITION", 0}, {"TEXCOORD_0", 1}},
            "meshes[1].primitives[0].extensions.KHR_draco_mesh_compression.attributes.TEXCOORD_0: is not an attribute")
            .warns(noPrimitive),
        set("WrongComponents", "/accessors/6/type", "VEC2",
            "meshes[1].primitives[0].extensions.KHR_draco_mesh_compression.attributes.NORMAL: has 3 components")
            .warns(noPrimitive)),
    caseName);

}  // namespace
}  // namespace reflet::test::gltf_broken_test
