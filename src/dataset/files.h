// The files of a data set: images, a record beside each frame's, and the manifest.
#pragma once

#include "base/image_camera.h"
#include "dataset/options.h"
#include "reference/motion.h"
#include "reference/reference.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

/// One noisy version of a frame.
struct NoisyImages {
    std::string name;                ///< "spp4", "plain"
    uint32_t samples = 0;            ///< per pixel; 0: of a preset
    std::vector<ImageLayer> layers;  ///< final, direct, indirect_diffuse, indirect_specular; albedo or unfiltered
};

struct FrameImagesOut {
    ReferencePicture clean;
    MotionImages motion;
    std::vector<NoisyImages> noisy;
    ImageCamera camera;
    float exposure = 0.0F;  ///< stops, for displayed images
};

/// A layer as the manifest describes it.
struct LayerInfo {
    std::string_view name;
    std::string_view channels;
    std::string_view unit;
    std::string_view meaning;
};
std::vector<LayerInfo> datasetLayers();

/// The four radiance layers and the albedo of a traced image.
std::vector<ImageLayer> tracedLayers(const ReferencePicture& picture);

class DatasetFiles {
public:
    DatasetFiles(const DatasetOptions& options, std::vector<std::string> sceneNames);

    /// "cubes/cubes_000012", relative to the folder.
    [[nodiscard]] std::string stem(uint32_t scene, uint32_t frame) const;
    /// Its record exists, and all files that it lists with their sizes.
    [[nodiscard]] bool isWhole(uint32_t scene, uint32_t frame) const;
    /// Writes the images, then the record with their names, sizes and checksums added.
    void write(uint32_t scene, uint32_t frame, const FrameImagesOut& images, nlohmann::ordered_json record) const;
    /// Writes frames.jsonl, all records in order, if all frames are there. Returns the number of missing frames.
    uint32_t writeIndex(const std::vector<uint32_t>& sceneOfFrame) const;

private:
    [[nodiscard]] std::vector<std::string> writeLayered(const std::string& stem, const FrameImagesOut& images) const;
    [[nodiscard]] std::vector<std::string> writeOidn(const std::string& stem, const FrameImagesOut& images) const;
    [[nodiscard]] std::filesystem::path recordOf(uint32_t scene, uint32_t frame) const;

    const DatasetOptions& options_;
    std::filesystem::path folder_;
    std::vector<std::string> sceneNames_;
};

/// CRC-32 as in ISO 3309, PNG and zlib.
uint32_t crc32Of(std::string_view bytes);

}  // namespace reflet
