// Seeds of the targets that read scenes and images. The unit tests' encoders make them.
#include "base/file.h"
#include "base/image_file.h"
#include "base/json_text.h"
#include "fuzz.h"
#include "scene/view_file.h"
#include "seeds.h"
#include "unit/gltf_encoders.h"
#include "unit/gltf_showcase.h"

#include <stb/stb_image_write.h>
#include <nlohmann/json.hpp>

#include <array>
#include <numeric>

namespace reflet::fuzz {

namespace {

std::string textOf(const std::vector<uint8_t>& bytes) {
    return {bytes.begin(), bytes.end()};
}

std::vector<uint8_t> ramp(size_t count) {
    std::vector<uint8_t> values(count);
    std::iota(values.begin(), values.end(), uint8_t{1});
    return values;
}

std::string jpegOf(int width, int height, int channels) {
    const std::vector<uint8_t> pixels =
        ramp(static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
    std::string jpeg;
    stbi_write_jpg_to_func(
        [](void* context, void* data, int size) {
            static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<size_t>(size));
        },
        &jpeg, width, height, channels, pixels.data(), 60);
    return jpeg;
}

std::string exrOf(const std::vector<ImageLayer>& layers) {
    const auto path = folder() / "seed.exr";
    writeExr(path, layers);
    return readFile(path);
}

void addImages(std::vector<Seed>& seeds) {
    seeds.push_back({"png", "plain.png", textOf(test::pngOf(4, 3, {1, 2, 3, 200}))});
    seeds.push_back({"png", "deep.png", textOf(test::deepPngOf(2, 2, std::vector<uint16_t>(16, 40000)))});
    seeds.push_back({"jpeg", "color.jpg", jpegOf(17, 9, 3)});
    seeds.push_back({"jpeg", "grey.jpg", jpegOf(8, 8, 1)});
    seeds.push_back({"webp", "lossless.webp", textOf(test::webpOf(5, 3, ramp(60)))});
    for (const bool zstd : {false, true}) {
        const std::string name = zstd ? "zstd" : "plain";
        seeds.push_back({"ktx2", name + "_rgba.ktx2", textOf(test::ktx2Of(2, 2, 37, ramp(16), zstd))});
        seeds.push_back({"ktx2", name + "_grey.ktx2", textOf(test::ktx2Of(3, 1, 9, ramp(3), zstd))});
    }
    const FloatImage color{4, 3, {"R", "G", "B"}, std::vector<float>(36, 0.5F)};
    const FloatImage depth{4, 3, {"Z"}, std::vector<float>(12, 2.0F)};
    seeds.push_back({"exr", "one.exr", exrOf({{"", color, PixelType::float32}})});
    seeds.push_back({"exr", "two.exr", exrOf({{"", color, PixelType::half}, {"depth", depth, PixelType::float32}})});
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    const std::string line("\x02\x02\x00\x08\x08\x80\x02\x03\x04\x05\x06\x07\x80\x88\x40\x88\x00\x83\x81\x85\x81", 21);
    seeds.push_back({"hdr", "runs.hdr", header + "-Y 2 +X 8\n" + line + line});
    seeds.push_back({"hdr", "plain.hdr", header + "-Y 1 +X 2\n\x80\x40\x20\x81\x80\x40\x20\x81"});
}

/// The first byte of an input selects the layout, the second the number of elements: see meshopt.cpp.
void addMeshopt(std::vector<Seed>& seeds) {
    const std::array<unsigned char, 7> strides{12, 16, 252, 12, 4, 8, 8};
    for (size_t layout = 0; layout < strides.size(); ++layout) {
        const std::vector<uint8_t> vertices = ramp(size_t{5} * strides.at(layout));
        seeds.push_back({"meshopt", "vertices" + std::to_string(layout),
                         std::string{static_cast<char>(layout), '\1'} +
                             textOf(test::meshoptVertices(vertices.data(), 5, strides.at(layout)).encoded)});
    }
    for (size_t layout = 7; layout < 11; ++layout) {
        const test::MeshoptView view = test::meshoptIndices({0, 1, 2, 2, 1, 3}, layout % 2 == 1 ? 2 : 4, layout < 9);
        seeds.push_back({"meshopt", "indices" + std::to_string(layout),
                         std::string{static_cast<char>(layout), '\1'} + textOf(view.encoded)});
    }
}

void addFiles(std::vector<Seed>& seeds) {
    seeds.push_back({"fingerprint", "uris",
                     "texels\n./texels\n../secret\n%2e%2e/secret\nlink\nparent/secret\nin/up/texels\nin/../../secret\n"
                     "file:///etc/passwd\n/etc/passwd\n..\\secret\ndata:,x\nin\n"});
    seeds.push_back(
        {"fingerprint", "scene.gltf",
         R"({"asset":{"version":"2.0"},"buffers":[{"uri":"texels","byteLength":6}],"images":[{"uri":"link"}]})"});
    View view;
    view.lampRadius = 0.1F;
    view.probes = {Probe{}};
    seeds.push_back({"view_file", "view.json", jsonText(viewJson(view), 2)});
    seeds.push_back({"view_file", "named.json",
                     R"({"environment": "sky", "background": "blur", "lamps": {"off": [0]}, "mirrors": ["glass"],
                         "camera": {"orthographic_height": 4, "focus": [0, 1, 2], "f_number": 2.8, "blades": 6}})"});
    seeds.push_back({"camera_path", "path.json",
                     R"({"keyframes": [{"time": 0, "position": [0, 0, 5], "target": [0, 0, 0]},
                            {"time": 1, "position": [5, 0, 0], "target": [0, 0, 0], "fov_y": 30}], "loop": false})"});
}

}  // namespace

std::vector<Seed> sceneSeeds() {
    std::vector<Seed> seeds;
    for (auto& [name, builder] : test::showcase()) {
        seeds.push_back({"gltf", name + ".glb", builder.glbBytes()});
    }
    seeds.push_back({"gltf", "everything.gltf", test::everything().gltfBytes()});
    seeds.push_back({"draco", "square", textOf(test::dracoSquare())});
    addImages(seeds);
    addMeshopt(seeds);
    addFiles(seeds);
    return seeds;
}

}  // namespace reflet::fuzz
