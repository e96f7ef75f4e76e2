// Reads, uploads and writes pictures of effects.
#include "cli/sharp_picture.h"

#include "base/error.h"
#include "base/progress.h"
#include "capture/pictures.h"
#include "effects/tonemap/tone_map_image.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace reflet {

namespace {

const FloatImage& layerOf(const std::vector<ImageLayer>& layers, const std::string& name, size_t channels,
                          const std::string& file) {
    const auto found = std::ranges::find(layers, name, &ImageLayer::name);
    if (found == layers.end() || found->image.channels.size() < channels) {
        fail(
            "{}: there is no layer {} of {} channels; write it with reflet reference --pinhole, or with reflet render "
            "--aov depth",
            file, name.empty() ? "without a name" : name, channels);
    }
    return found->image;
}

// The depth that the view's projection gives a distance.
float reversedDepth(float z, const vec4& d) {
    return z > 0.0F ? (d.x - d.z * z) / (d.w * z - d.y) : 0.0F;
}

}  // namespace

void addSharpPictureOptions(CLI::App& command, std::string& picture, std::vector<std::string>& outputs) {
    command
        .add_option("--picture", picture,
                    "Sharp picture: an .exr file with radiance and the layer depth [m], as reflet reference --pinhole "
                    "and reflet render --aov depth write it")
        ->type_name("F.exr")
        ->required();
    command.add_option("-o,--output", outputs, "Output image, .exr or .png; may be repeated")
        ->type_name("FILE")
        ->allow_extra_args(false);
}

SharpPicture readSharp(const std::string& file) {
    if (!isExr(file)) {
        failUsage("{}: the picture must be an .exr file with the radiance and the layer depth", file);
    }
    const std::vector<ImageLayer> layers = readExr(file);
    return {layerOf(layers, "", 3, file), layerOf(layers, "depth", 1, file)};
}

SharpImages uploadSharp(gpu::Frame& f, const SharpPicture& sharp, const ViewParams& view) {
    const uvec2 size(sharp.radiance.width, sharp.radiance.height);
    const size_t channels = sharp.radiance.channels.size();
    std::vector<vec4> radiance;
    std::vector<float> depth;
    for (size_t i = 0; i < size_t(size.x) * size.y; ++i) {
        const float* c = &sharp.radiance.data[channels * i];
        radiance.emplace_back(c[0], c[1], c[2], 1.0F);
        depth.push_back(reversedDepth(sharp.depth.data[i], view.depthToDistance));
    }
    const SharpImages images{f.image("radiance", VK_FORMAT_R32G32B32A32_SFLOAT, size),
                             f.image("depth", VK_FORMAT_R32_SFLOAT, size)};
    f.upload(images.radiance, std::as_bytes(std::span(radiance)));
    f.upload(images.depth, std::as_bytes(std::span(depth)));
    return images;
}

FloatImage colorImage(const std::vector<vec4>& texels, uvec2 size) {
    FloatImage image{size.x, size.y, {"R", "G", "B"}, {}};
    for (const vec4& texel : texels) {
        image.data.insert(image.data.end(), {texel.x, texel.y, texel.z});
    }
    return image;
}

void writeEffect(const std::vector<std::string>& files, const FloatImage& image, const SharpPicture& sharp,
                 const TonemapSettings& tonemap) {
    for (const std::string& file : files) {
        if (isExr(file)) {
            writeExr(file, std::vector<ImageLayer>{{"", image}, {"depth", sharp.depth}});
        } else {
            writePng(file, toneMapped(image, tonemap));
        }
        tellWritten(file);
    }
}

}  // namespace reflet
