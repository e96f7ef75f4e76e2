// Writes the files of a data set.
#include "dataset/files.h"

#include "base/color.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "effects/tonemap/tone_map_image.h"
#include "effects/tonemap/tonemap.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace reflet {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::vector<ImageLayer> withPrefix(const std::string& prefix, std::vector<ImageLayer> layers) {
    for (ImageLayer& layer : layers) {
        layer.name = prefix + layer.name;
    }
    return layers;
}

void append(std::vector<ImageLayer>& all, std::vector<ImageLayer> more) {
    std::ranges::move(more, std::back_inserter(all));
}

// Linear, as files of low dynamic range are for the training tools: they encode them themselves.
FloatImage displayed(const FloatImage& radiance, float exposure) {
    TonemapSettings tonemap;
    tonemap.exposure = exposure;
    tonemap.autoExposure = AutoExposure::off;
    const Bitmap bitmap = toneMapped(radiance, tonemap);
    FloatImage image{bitmap.width, bitmap.height, {"R", "G", "B"}, {}};
    for (size_t i = 0; i < bitmap.data.size(); ++i) {
        if (i % bitmap.channels < 3) {
            image.data.push_back(decodeSrgb(static_cast<float>(bitmap.data[i]) / 255.0F));
        }
    }
    return image;
}

const FloatImage& layerOf(const NoisyImages& noisy, std::string_view name) {
    const auto found = std::ranges::find(noisy.layers, name, &ImageLayer::name);
    REFLET_CHECK(found != noisy.layers.end(), "noisy image without {}", name);
    return found->image;
}

}  // namespace

uint32_t crc32Of(std::string_view bytes) {
    static const std::array<uint32_t, 256> table = [] {
        std::array<uint32_t, 256> made{};
        for (uint32_t i = 0; i < made.size(); ++i) {
            uint32_t value = i;
            for (int bit = 0; bit < 8; ++bit) {
                value = (value & 1U) != 0 ? 0xEDB88320U ^ (value >> 1U) : value >> 1U;
            }
            made[i] = value;
        }
        return made;
    }();
    uint32_t sum = 0xFFFFFFFFU;
    for (const char byte : bytes) {
        sum = table[(sum ^ static_cast<uint8_t>(byte)) & 0xFFU] ^ (sum >> 8U);
    }
    return ~sum;
}

std::vector<LayerInfo> datasetLayers() {
    return {
        {"final", "RGB", "W/(m² sr)", "direct + indirect_diffuse + indirect_specular"},
        {"direct", "RGB", "W/(m² sr)", "light of the sun and lamps, emission of the surface, background"},
        {"indirect_diffuse", "RGB", "W/(m² sr)", "indirect light by the diffuse lobe, with the surface's colour"},
        {"indirect_specular", "RGB", "W/(m² sr)", "indirect light by the specular lobe and through glass"},
        {"albedo", "RGB", "", "base colour, linear, mean over the pixel; 0 in the background"},
        {"normal", "XYZ", "", "shading normal in world space at the pixel's centre; 0 in the background"},
        {"depth", "Y", "m", "along the view axis at the pixel's centre; 0 in the background"},
        {"sun_visibility", "Y", "", "visible share of the sun's disk, mean over the pixel; 1 in the background"},
        {"motion", "XY", "uv", "uv minus uv in the frame before, of the surface point at the pixel's centre"},
        {"previous_depth", "Y", "m", "depth of that point for the camera of the frame before; 0 in the background"}};
}

std::vector<ImageLayer> tracedLayers(const ReferencePicture& p) {
    return {{"final", p.final},
            {"direct", p.direct},
            {"indirect_diffuse", p.indirectDiffuse},
            {"indirect_specular", p.indirectSpecular},
            {"albedo", p.albedo}};
}

DatasetFiles::DatasetFiles(const DatasetOptions& options, std::vector<std::string> sceneNames)
    : options_(options), folder_(options.folder), sceneNames_(std::move(sceneNames)) {
    for (const std::string& name : sceneNames_) {
        std::error_code error;
        fs::create_directories(folder_ / name, error);
        if (error) {
            fail("{}: {}", (folder_ / name).string(), error.message());
        }
    }
}

std::string DatasetFiles::stem(uint32_t scene, uint32_t frame) const {
    return fmt::format("{0}/{0}_{1:06}", sceneNames_[scene], frame);
}

fs::path DatasetFiles::recordOf(uint32_t scene, uint32_t frame) const {
    return folder_ / (stem(scene, frame) + ".json");
}

bool DatasetFiles::isWhole(uint32_t scene, uint32_t frame) const {
    const fs::path file = recordOf(scene, frame);
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        return false;
    }
    const nlohmann::json record = parseJsonIfValid(readFile(file));
    if (!record.is_object() || !record.contains("files") || !record.at("files").is_array()) {
        return false;
    }
    return std::ranges::all_of(record.at("files"), [&](const nlohmann::json& one) {
        return one.is_object() && one.contains("file") && one.at("file").is_string() && one.contains("bytes") &&
               fs::file_size(folder_ / one.at("file").get<std::string>(), error) == one.at("bytes") && !error;
    });
}

std::vector<std::string> DatasetFiles::writeLayered(const std::string& stem, const FrameImagesOut& images) const {
    const ReferencePicture& p = images.clean;
    std::vector<ImageLayer> layers{{"", p.final}};
    append(layers, tracedLayers(p));
    append(layers, {{"normal", p.normal}, {"sun_visibility", p.sunVisibility}});
    for (const NoisyImages& noisy : images.noisy) {
        append(layers, withPrefix(noisy.name + ".", noisy.layers));
    }
    for (ImageLayer& layer : layers) {
        layer.pixelType = options_.floats && !layer.name.empty() ? PixelType::float32 : PixelType::half;
    }
    append(layers,
           {{"depth", p.depth}, {"motion", images.motion.motion}, {"previous_depth", images.motion.previousDepth}});
    writeExr(folder_ / (stem + ".exr"), layers, images.camera);
    return {stem + ".exr"};
}

// The names that the training tools of Open Image Denoise read.
std::vector<std::string> DatasetFiles::writeOidn(const std::string& stem, const FrameImagesOut& images) const {
    std::vector<std::string> files;
    const PixelType type = options_.floats ? PixelType::float32 : PixelType::half;
    const auto add = [&](const std::string& version, const std::string& feature, FloatImage image) {
        files.push_back(fmt::format("{}_{}.{}.exr", stem, version, feature));
        image.channels = {"R", "G", "B"};
        writeExr(folder_ / files.back(), std::array{ImageLayer{"", std::move(image), type}}, images.camera);
    };
    const auto addVersion = [&](const std::string& version, const FloatImage& radiance, const FloatImage& albedo) {
        add(version, "hdr", radiance);
        add(version, "alb", albedo);
        add(version, "nrm", images.clean.normal);
        if (options_.displayed) {
            add(version, "ldr", displayed(radiance, images.exposure));
        }
    };
    for (const NoisyImages& noisy : images.noisy) {
        addVersion(fmt::format("{:04}spp", noisy.samples), layerOf(noisy, "final"), layerOf(noisy, "albedo"));
    }
    addVersion("ref", images.clean.final, images.clean.albedo);
    return files;
}

void DatasetFiles::write(uint32_t scene, uint32_t frame, const FrameImagesOut& images, ordered_json record) const {
    const std::string name = stem(scene, frame);
    record["files"] = ordered_json::array();
    for (const std::string& file : options_.layout == "oidn" ? writeOidn(name, images) : writeLayered(name, images)) {
        const std::string bytes = readFile(folder_ / file);
        record["files"].push_back(
            {{"file", file}, {"bytes", bytes.size()}, {"crc32", fmt::format("{:08x}", crc32Of(bytes))}});
    }
    writeFileAtomically(recordOf(scene, frame), jsonText(record) + "\n");
}

uint32_t DatasetFiles::writeIndex(const std::vector<uint32_t>& sceneOfFrame) const {
    std::string all;
    uint32_t missing = 0;
    for (uint32_t frame = 0; frame < sceneOfFrame.size(); ++frame) {
        if (isWhole(sceneOfFrame[frame], frame)) {
            all += readFile(recordOf(sceneOfFrame[frame], frame));
        } else {
            ++missing;
        }
    }
    if (missing == 0) {
        writeFileAtomically(folder_ / "frames.jsonl", all);
    }
    return missing;
}

}  // namespace reflet
