// Builds small glTF files for the tests, valid or invalid.
#include "gltf_builder.h"

#include "base/error.h"
#include "base/json_text.h"
#include "valid_scene.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace reflet::test {

using nlohmann::json;

std::filesystem::path testFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("reflet_") + test->test_suite_name() + "_" + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    auto folder = std::filesystem::path(::testing::TempDir()) / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

void writeBytes(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string base64(const std::vector<uint8_t>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t have = std::min<size_t>(3, bytes.size() - i);
        uint32_t bits = 0;
        for (size_t b = 0; b < 3; ++b) {
            bits = bits << 8U | (b < have ? bytes[i + b] : 0U);
        }
        for (size_t d = 0; d < 4; ++d) {
            text += d <= have ? digits[bits >> (18 - 6 * d) & 63U] : '=';
        }
    }
    return text;
}

std::vector<uint8_t> pngOf(int width, int height, std::array<uint8_t, 4> color) {
    std::vector<uint8_t> pixels(static_cast<size_t>(width) * static_cast<size_t>(height) * color.size());
    for (size_t i = 0; i < pixels.size(); ++i) {
        pixels[i] = color[i % color.size()];
    }
    std::vector<uint8_t> png;
    stbi_write_png_to_func(
        [](void* context, void* data, int size) {
            const auto* bytes = static_cast<const uint8_t*>(data);
            static_cast<std::vector<uint8_t>*>(context)->assign(bytes, bytes + size);
        },
        &png, width, height, 4, pixels.data(), 0);
    return png;
}

GltfBuilder::GltfBuilder()
    : document{{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", json::array({{{"name", "first"}, {"nodes", json::array()}}})}} {}

int GltfBuilder::add(const char* array, json element) {
    if (!document.contains(array)) {
        document[array] = json::array();
    }
    document[array].push_back(std::move(element));
    return static_cast<int>(document[array].size()) - 1;
}

int GltfBuilder::addView(const void* bytes, size_t size, int byteStride) {
    bin.resize((bin.size() + 3) / 4 * 4);
    json view = {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", size}};
    if (byteStride > 0) {
        view["byteStride"] = byteStride;
    }
    const auto* first = static_cast<const uint8_t*>(bytes);
    bin.insert(bin.end(), first, first + size);
    return add("bufferViews", std::move(view));
}

int GltfBuilder::addRoot(json node) {
    const int index = add("nodes", std::move(node));
    document["scenes"][0]["nodes"].push_back(index);
    return index;
}

int GltfBuilder::addPrimitive(json primitive) {
    const int mesh = add("meshes", {{"name", "mesh"}, {"primitives", json::array({std::move(primitive)})}});
    addRoot({{"mesh", mesh}});
    return mesh;
}

int GltfBuilder::addTexture(std::array<uint8_t, 4> color) {
    const std::vector<uint8_t> png = pngOf(2, 2, color);
    const int image = add("images", {{"bufferView", addView(png.data(), png.size())}, {"mimeType", "image/png"}});
    return add("textures", {{"source", image}});
}

std::string GltfBuilder::gltfBytes() {
    if (!bin.empty() && !document.contains("buffers")) {
        add("buffers", {{"byteLength", bin.size()}, {"uri", "data:application/octet-stream;base64," + base64(bin)}});
    }
    return jsonText(document);
}

std::string GltfBuilder::glbBytes() {
    if (!bin.empty() && !document.contains("buffers")) {
        add("buffers", {{"byteLength", bin.size()}});
    }
    std::string text = jsonText(document);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bin.resize((bin.size() + 3) / 4 * 4);
    const auto word = [](uint32_t value) {
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &value, 4);
        return bytes;
    };
    const std::string first = word(static_cast<uint32_t>(text.size())) + "JSON" + text;
    const std::string rest = bin.empty() ? ""
                                         : word(static_cast<uint32_t>(bin.size())) + std::string("BIN\0", 4) +
                                               std::string(bin.begin(), bin.end());
    return "glTF" + word(2) + word(static_cast<uint32_t>(12 + first.size() + rest.size())) + first + rest;
}

std::filesystem::path GltfBuilder::writeGltf(const std::filesystem::path& path) {
    writeBytes(path, gltfBytes());
    return path;
}

std::filesystem::path GltfBuilder::writeGlb(const std::filesystem::path& path) {
    writeBytes(path, glbBytes());
    return path;
}

size_t GltfBuilder::componentsOf(std::string_view type) {
    return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "MAT4" ? 16 : 4;
}

GltfBuilder triangle() {
    GltfBuilder b;
    const int positions = b.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    b.addPrimitive({{"attributes", {{"POSITION", positions}}}});
    return b;
}

GltfBuilder slider() {
    GltfBuilder b = triangle();
    const int times = b.addFloats({0, 2}, "SCALAR");
    const int places = b.addFloats({0, 0, 0, 4, 0, 0}, "VEC3");
    b.add("animations", {{"name", "slide"},
                         {"samplers", {{{"input", times}, {"output", places}}}},
                         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    return b;
}

GltfBuilder bent() {
    GltfBuilder b = triangle();
    const int joints = b.addAccessor<uint8_t>({0, 9, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, "VEC4", ubyteType);
    const int weights = b.addFloats({2, 0, 0, 0, 1, 0, 0, 0, 1, 3, 0, 0}, "VEC4");
    auto& attributes = b.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = joints;
    attributes["WEIGHTS_0"] = weights;
    std::vector<float> inverse(32, 0.0F);
    for (const size_t i : {0, 5, 10, 15}) {
        inverse[i] = 1.0F;
        inverse[16 + i] = 1.0F;
    }
    inverse[16 + 13] = -1.0F;  // the second joint was at y = 1
    b.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", b.addFloats(inverse, "MAT4")}});
    b.document["nodes"][0]["skin"] = 0;
    b.document["nodes"][0]["translation"] = {100, 0, 0};  // has no effect: only joints place a skinned mesh
    b.addRoot({{"name", "hip"}, {"children", {2}}});
    b.add("nodes", {{"name", "knee"}, {"translation", {0, 1, 2}}});  // moved by 2 along z from its bind pose
    return b;
}

namespace {

/// mesh 0: a textured square with normals and uvs, and the same square with one vertex replaced by a sparse accessor.
void addSquares(GltfBuilder& b) {
    const int positions = b.addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    const int normals = b.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int uvs = b.addFloats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
    const int indices = b.addAccessor<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR", ushortType);
    const uint16_t corner = 2;
    const std::array<float, 3> value{2, 2, -1};
    const int sparse = b.add("accessors", b.document["accessors"][static_cast<size_t>(positions)]);
    b.document["accessors"][static_cast<size_t>(sparse)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", b.addView(&corner, sizeof corner)}, {"componentType", ushortType}}},
        {"values", {{"bufferView", b.addView(value.data(), sizeof value)}}}};
    const json transform = {{"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}}}}}};
    json baseColor = {{"index", b.addTexture({255, 128, 0, 255})}};
    baseColor.update(transform);
    const int sampler = b.add("samplers", {{"magFilter", 9728}, {"minFilter", 9987}, {"wrapS", 33071}});
    b.document["textures"][0]["sampler"] = sampler;
    const int material = b.add("materials", {{"name", "painted"},
                                             {"pbrMetallicRoughness", {{"baseColorTexture", baseColor}}},
                                             {"normalTexture", {{"index", b.addTexture({128, 128, 255, 255})}}},
                                             {"alphaMode", "MASK"}});
    b.add("meshes", {{"primitives",
                      {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
                        {"indices", indices},
                        {"material", material}},
                       {{"attributes", {{"POSITION", sparse}}}, {"indices", indices}}}}});
}

/// mesh 1: the square in Draco.
void addDracoMesh(GltfBuilder& b) {
    const std::vector<uint8_t> draco = dracoSquare();
    const int view = b.addView(draco.data(), draco.size());
    const int positions = b.add("accessors", {{"componentType", floatType}, {"count", 4}, {"type", "VEC3"}});
    const int normals = b.add("accessors", {{"componentType", floatType}, {"count", 4}, {"type", "VEC3"}});
    const int indices = b.add("accessors", {{"componentType", ushortType}, {"count", 6}, {"type", "SCALAR"}});
    b.add("meshes", {{"primitives",
                      {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                        {"indices", indices},
                        {"extensions",
                         {{"KHR_draco_mesh_compression",
                           {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}}}}}}}});
}

}  // namespace

GltfBuilder everything() {
    GltfBuilder b;
    addSquares(b);
    addDracoMesh(b);
    b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}});
    b.document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}};
    b.document["extensionsUsed"] = {"KHR_lights_punctual", "KHR_draco_mesh_compression", "KHR_texture_transform"};
    b.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    b.addRoot({{"children", {1, 2, 3}}, {"translation", {1, 2, 3}}});
    b.add("nodes", {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    b.add("nodes", {{"mesh", 1}, {"camera", 0}, {"rotation", {0, 0, 0, 1}}, {"translation", {0, 1.5, 1}}});
    b.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"children", {4}}});
    b.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}},
                    {"translation", {0.5, 0.5, 1}},
                    {"scale", {1, 1, 2}}});
    return b;
}

std::vector<uint8_t> dracoSquare() {
    const std::array<std::array<float, 3>, 4> corners{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    const std::array<float, 3> normal{0, 0, 1};
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normals = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    for (uint32_t f = 0; f < 2; ++f) {
        const draco::FaceIndex face(f);
        builder.SetAttributeValuesForFace(position, face, corners[0].data(), corners.at(f + 1).data(),
                                          corners.at(f + 2).data());
        builder.SetAttributeValuesForFace(normals, face, normal.data(), normal.data(), normal.data());
    }
    const auto mesh = builder.Finalize();
    draco::EncoderBuffer buffer;
    draco::Encoder encoder;
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) {
        throw std::runtime_error("Draco cannot encode the mesh");
    }
    return {buffer.data(), buffer.data() + buffer.size()};
}

Loaded load(const std::filesystem::path& path, int scene) {
    Loaded result;
    result.scene = loadGltf(
        path, {.scene = scene, .warn = [&](const std::string& warning) { result.warnings.push_back(warning); }});
    return result;
}

Loaded load(GltfBuilder builder, int scene) {
    return load(builder.writeGltf(testFolder() / "scene.gltf"), scene);
}

std::string complaint(const std::filesystem::path& path, bool strict) {
    try {
        loadGltf(path, {.strict = strict});
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << message;
        return message.substr(std::min(message.size(), path.string().size() + 2));
    }
    return "";
}

std::string expectProblem(const std::filesystem::path& path, const std::string& starts, const char* consequence) {
    const std::string message = complaint(path);
    EXPECT_EQ(message.rfind(starts, 0), 0U) << message;
    if (consequence == nullptr) {
        const std::string forgiving = complaint(path, false);
        EXPECT_TRUE(forgiving == message || forgiving == "nothing is left to draw: " + message) << forgiving;
        return message;
    }
    const Loaded loaded = load(path);
    expectValid(loaded.scene);
    const std::string middle = std::string(": ") + consequence;
    const auto saysTheSame = [&](std::string warning) {
        const size_t at = warning.find(middle, path.string().size() + 1);
        return at != std::string::npos && warning.erase(at, middle.size()).starts_with(path.string() + ": " + message);
    };
    const bool warned =
        *consequence == '\0' ? !loaded.warnings.empty() : std::ranges::any_of(loaded.warnings, saysTheSame);
    EXPECT_TRUE(warned) << message << "\n" << fmt::format("{}", fmt::join(loaded.warnings, "\n"));
    return message;
}

}  // namespace reflet::test
