// Builds small glTF files for the tests, valid or invalid.
#pragma once

#include "scene/gltf/gltf.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::test {

/// An empty folder for the running test, below the temporary folder.
std::filesystem::path testFolder();

void writeBytes(const std::filesystem::path& path, std::string_view bytes);
std::string base64(const std::vector<uint8_t>& bytes);

/// A PNG with one colour.
std::vector<uint8_t> pngOf(int width, int height, std::array<uint8_t, 4> color);

constexpr int byteType = 5120;
constexpr int ubyteType = 5121;
constexpr int shortType = 5122;
constexpr int ushortType = 5123;
constexpr int uintType = 5125;
constexpr int floatType = 5126;

/// A glTF document and its only buffer. Functions that add something return its index.
class GltfBuilder {
public:
    GltfBuilder();

    nlohmann::json document;
    std::vector<uint8_t> bin;

    int add(const char* array, nlohmann::json element);
    /// The bytes are aligned to four.
    int addView(const void* bytes, size_t size, int byteStride = 0);
    /// Tightly packed.
    template <class T>
    int addAccessor(const std::vector<T>& components, const char* type, int componentType) {
        const int view = addView(components.data(), components.size() * sizeof(T));
        return add("accessors", {{"bufferView", view},
                                 {"componentType", componentType},
                                 {"count", components.size() / componentsOf(type)},
                                 {"type", type}});
    }
    int addFloats(const std::vector<float>& components, const char* type) {
        return addAccessor(components, type, floatType);
    }
    /// A node of the first scene.
    int addRoot(nlohmann::json node);
    /// A mesh with this primitive, and a root node that shows it.
    int addPrimitive(nlohmann::json primitive);
    /// A new texture, with a PNG of the colour in a buffer view.
    int addTexture(std::array<uint8_t, 4> color);

    /// Writes the file with its buffer as a data URI.
    std::filesystem::path writeGltf(const std::filesystem::path& path);
    std::filesystem::path writeGlb(const std::filesystem::path& path);
    [[nodiscard]] std::string gltfBytes();
    [[nodiscard]] std::string glbBytes();

    static size_t componentsOf(std::string_view type);
};

/// A unit right triangle in the xy-plane: positions (0,0,0) (1,0,0) (0,1,0), as a root node.
GltfBuilder triangle();

/// A triangle whose node moves from x = 0 to 4 in 2 s.
GltfBuilder slider();

/// A skinned triangle: its third vertex follows a second joint with weight 0.75. That joint is one metre up, and moved
/// by 2 along z from its bind pose.
GltfBuilder bent();

/// A scene that uses one of everything that the loader reads.
GltfBuilder everything();

/// A Draco mesh of two triangles on the square 0..1, with the attributes POSITION (unique id 0) and NORMAL (1).
std::vector<uint8_t> dracoSquare();

/// A scene and the warnings of loading it, which is not strict.
struct Loaded {
    Scene scene;
    std::vector<std::string> warnings;
};

Loaded load(const std::filesystem::path& path, int scene = -1);
/// Writes the file as .gltf and loads it.
Loaded load(GltfBuilder builder, int scene = -1);

/// The loader's error message without "FILE: "; empty if there is none. Expects one line that starts with the file.
std::string complaint(const std::filesystem::path& path, bool strict = true);
/// That message, which must start with `starts`. Loading that is not strict must warn of the same, with `consequence`
/// ("": any) between part and problem, and give a valid scene; null: the message must be the same, or say that nothing
/// is left. Returns the message.
std::string expectProblem(const std::filesystem::path& path, const std::string& starts, const char* consequence);

}  // namespace reflet::test
