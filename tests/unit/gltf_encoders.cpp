// Encodes what glTF extensions compress, for tests.
#include "gltf_encoders.h"

#include <meshoptimizer.h>
#include <webp/encode.h>
#include <zstd.h>

#include <cstdlib>

// Of stb_image_write, which does not declare it in its header.
extern "C" unsigned char* stbi_zlib_compress(unsigned char* data, int size, int* compressedSize, int quality);

namespace reflet::test {

using nlohmann::json;

namespace {

void appendBigEndian(std::vector<uint8_t>& to, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        to.push_back(static_cast<uint8_t>(value >> shift));
    }
}

template <class T>
void appendLittleEndian(std::vector<uint8_t>& to, T value) {
    for (size_t i = 0; i < sizeof(T); ++i) {
        to.push_back(static_cast<uint8_t>(value >> (8 * i)));
    }
}

void appendChunk(std::vector<uint8_t>& png, const std::string& type, const std::vector<uint8_t>& data) {
    appendBigEndian(png, static_cast<uint32_t>(data.size()));
    const size_t first = png.size();
    png.insert(png.end(), type.begin(), type.end());
    png.insert(png.end(), data.begin(), data.end());
    uint32_t crc = 0xFFFFFFFF;
    for (size_t i = first; i < png.size(); ++i) {
        crc ^= png[i];
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
        }
    }
    appendBigEndian(png, ~crc);
}

}  // namespace

std::vector<uint8_t> deepPngOf(uint32_t width, uint32_t height, const std::vector<uint16_t>& rgba) {
    std::vector<uint8_t> rows;
    for (size_t i = 0; i < rgba.size(); ++i) {
        if (i % (size_t(width) * 4) == 0) {
            rows.push_back(0);  // no filter
        }
        rows.push_back(static_cast<uint8_t>(rgba[i] >> 8U));
        rows.push_back(static_cast<uint8_t>(rgba[i]));
    }
    int size = 0;
    unsigned char* zlib = stbi_zlib_compress(rows.data(), static_cast<int>(rows.size()), &size, 8);
    const std::vector<uint8_t> compressed(zlib, zlib + size);
    std::free(zlib);  // NOLINT(cppcoreguidelines-no-malloc): as stb_image_write wants
    std::vector<uint8_t> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    std::vector<uint8_t> header;
    appendBigEndian(header, width);
    appendBigEndian(header, height);
    header.insert(header.end(), {16, 6, 0, 0, 0});  // bits, RGBA
    appendChunk(png, "IHDR", header);
    appendChunk(png, "IDAT", compressed);
    appendChunk(png, "IEND", {});
    return png;
}

std::vector<uint8_t> webpOf(int width, int height, const std::vector<uint8_t>& rgba) {
    uint8_t* encoded = nullptr;
    const size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, width * 4, &encoded);
    std::vector<uint8_t> result(encoded, encoded + size);
    WebPFree(encoded);
    return result;
}

std::vector<uint8_t> ktx2Of(uint32_t width, uint32_t height, uint32_t format, const std::vector<uint8_t>& pixels,
                            bool zstd) {
    std::vector<uint8_t> level = pixels;
    if (zstd) {
        level.resize(ZSTD_compressBound(pixels.size()));
        level.resize(ZSTD_compress(level.data(), level.size(), pixels.data(), pixels.size(), 3));
    }
    std::vector<uint8_t> ktx{0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
    // format, type size, width, height, depth, layers, faces, levels, scheme; no descriptor and no metadata
    for (const uint32_t value : {format, 1U, width, height, 0U, 0U, 1U, 1U, zstd ? 2U : 0U, 0U, 0U, 0U, 0U}) {
        appendLittleEndian(ktx, value);
    }
    for (const uint64_t value : {size_t(0), size_t(0), size_t(104), level.size(), pixels.size()}) {
        appendLittleEndian(ktx, value);
    }
    ktx.insert(ktx.end(), level.begin(), level.end());
    return ktx;
}

int addTextureOf(GltfBuilder& b, const std::vector<uint8_t>& image, const std::string& extension) {
    const json source = {{"source", b.add("images", {{"bufferView", b.addView(image.data(), image.size())}})}};
    return b.add("textures", extension.empty() ? source : json{{"extensions", {{extension, source}}}});
}

MeshoptView meshoptVertices(const void* vertices, size_t count, size_t stride, const char* filter) {
    MeshoptView view{.encoded = {}, .count = count, .stride = stride, .mode = "ATTRIBUTES", .filter = filter};
    view.encoded.resize(meshopt_encodeVertexBufferBound(count, stride));
    view.encoded.resize(meshopt_encodeVertexBuffer(view.encoded.data(), view.encoded.size(), vertices, count, stride));
    return view;
}

MeshoptView meshoptIndices(const std::vector<uint32_t>& indices, size_t stride, bool triangles) {
    MeshoptView view{.encoded = {},
                     .count = indices.size(),
                     .stride = stride,
                     .mode = triangles ? "TRIANGLES" : "INDICES",
                     .filter = "NONE"};
    const size_t vertices = 1000;
    view.encoded.resize(triangles ? meshopt_encodeIndexBufferBound(indices.size(), vertices)
                                  : meshopt_encodeIndexSequenceBound(indices.size(), vertices));
    uint8_t* to = view.encoded.data();
    const size_t room = view.encoded.size();
    view.encoded.resize(triangles ? meshopt_encodeIndexBuffer(to, room, indices.data(), indices.size())
                                  : meshopt_encodeIndexSequence(to, room, indices.data(), indices.size()));
    return view;
}

int addMeshopt(GltfBuilder& b, const MeshoptView& view) {
    b.bin.resize((b.bin.size() + 3) / 4 * 4);
    const size_t offset = b.bin.size();
    b.bin.insert(b.bin.end(), view.encoded.begin(), view.encoded.end());
    return b.add("bufferViews", {{"buffer", 1},
                                 {"byteLength", view.count * view.stride},
                                 {"extensions",
                                  {{"EXT_meshopt_compression",
                                    {{"buffer", 0},
                                     {"byteOffset", offset},
                                     {"byteLength", view.encoded.size()},
                                     {"byteStride", view.stride},
                                     {"count", view.count},
                                     {"mode", view.mode},
                                     {"filter", view.filter}}}}}});
}

void addMeshoptBuffers(GltfBuilder& b) {
    b.add("buffers", {{"byteLength", b.bin.size()}, {"uri", "data:application/octet-stream;base64," + base64(b.bin)}});
    b.add("buffers", {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    b.document["extensionsUsed"].push_back("EXT_meshopt_compression");
    b.document["extensionsRequired"].push_back("EXT_meshopt_compression");
}

GltfBuilder morphing() {
    GltfBuilder b = triangle();
    auto& primitive = b.document["meshes"][0]["primitives"][0];
    primitive["attributes"]["NORMAL"] = b.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int raise = b.addFloats({0, 0, 0, 0, 0, 0, 0, 0, 2}, "VEC3");
    const int turn = b.addFloats({0, 0, 0, 0, 0, 0, 0, -1, 0}, "VEC3");
    const uint8_t second = 1;
    const std::array<float, 3> along{1, 0, 0};
    const int stretch =
        b.add("accessors", {{"componentType", floatType},
                            {"count", 3},
                            {"type", "VEC3"},
                            {"sparse",
                             {{"count", 1},
                              {"indices", {{"bufferView", b.addView(&second, 1)}, {"componentType", ubyteType}}},
                              {"values", {{"bufferView", b.addView(along.data(), sizeof along)}}}}}});
    primitive["targets"] = json::array({{{"POSITION", raise}, {"NORMAL", turn}}, {{"POSITION", stretch}}});
    const int times = b.addFloats({0, 2}, "SCALAR");
    const int weights = b.addFloats({0, 0, 1, 0.5}, "SCALAR");
    b.add("animations", {{"samplers", {{{"input", times}, {"output", weights}}}},
                         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    return b;
}

GltfBuilder compressed(bool exponential) {
    GltfBuilder b;
    const std::array<float, 9> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::array<uint32_t, 9> exponents{0, 0, 0, 1, 0, 0, 0, 1, 0};  // 1 times 2 to the 0
    const auto accessor = [&](const MeshoptView& view, int type, const char* kind) {
        return b.add(
            "accessors",
            {{"bufferView", addMeshopt(b, view)}, {"componentType", type}, {"count", view.count}, {"type", kind}});
    };
    const int positions = accessor(
        exponential ? meshoptVertices(exponents.data(), 3, 12, "EXPONENTIAL") : meshoptVertices(corners.data(), 3, 12),
        floatType, "VEC3");
    const int indices = accessor(meshoptIndices({0, 1, 2}, 2, true), ushortType, "SCALAR");
    const int webp = addTextureOf(b, webpOf(2, 1, {1, 2, 3, 255, 4, 5, 6, 255}), "EXT_texture_webp");
    const int ktx = addTextureOf(b, ktx2Of(1, 1, 37, {9, 8, 7, 6}, true), "KHR_texture_basisu");
    const int material = b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", webp}}}}},
                                             {"emissiveTexture", {{"index", ktx}}},
                                             {"emissiveFactor", {1, 1, 1}}});
    b.add("meshes", {{"primitives",
                      {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", material}}}}});
    const int places = b.addFloats({0, 0, 0, 5, 0, 0}, "VEC3");
    b.addRoot(
        {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    b.document["extensionsUsed"] = {"EXT_mesh_gpu_instancing", "EXT_texture_webp", "KHR_texture_basisu"};
    addMeshoptBuffers(b);
    return b;
}

}  // namespace reflet::test
