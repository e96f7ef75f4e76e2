// Reads images that are named on the command line.
#include "compare/picture_input.h"

#include "base/ascii.h"
#include "base/error.h"
#include "base/message.h"
#include "base/text.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>
#include <utility>

namespace reflet {

namespace {

namespace fs = std::filesystem;

std::optional<ImageKind> kindOf(const std::string& file) {
    const std::string extension = inLowerCase(fs::path(file).extension().string());
    if (extension == ".exr" || extension == ".hdr") {
        return ImageKind::linear;
    }
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") {
        return ImageKind::display;
    }
    return std::nullopt;
}

// Splits into file and layer. Layer names may contain colons: the first split whose file exists wins, else the first.
std::optional<std::pair<std::string, std::string>> splitLayer(const std::string& text) {
    if (kindOf(text)) {
        return std::nullopt;
    }
    std::error_code ignored;
    std::optional<std::pair<std::string, std::string>> first;
    for (size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1)) {
        std::pair<std::string, std::string> parts{text.substr(0, colon), text.substr(colon + 1)};
        if (!kindOf(parts.first)) {
            continue;
        }
        if (fs::exists(parts.first, ignored)) {
            return parts;
        }
        if (!first) {
            first = std::move(parts);
        }
    }
    return first;
}

const ImageLayer* findLayer(const std::vector<ImageLayer>& layers, const std::string& name) {
    const auto found = std::ranges::find(layers, name, &ImageLayer::name);
    if (found != layers.end()) {
        return &*found;
    }
    return name == "final" ? findLayer(layers, "") : nullptr;
}

FloatImage readLayer(const PictureName& name) {
    std::vector<ImageLayer> layers = readExr(name.file);
    const ImageLayer* layer = findLayer(layers, name.layer);
    if (layer != nullptr) {
        return layer->image;
    }
    std::vector<std::string> names;
    std::ranges::transform(layers, std::back_inserter(names),
                           [](const ImageLayer& other) { return other.name.empty() ? "final" : other.name; });
    fail("{}: has no layer '{}'; its layers: {}{}", name.file, name.layer.empty() ? "final" : name.layer, listed(names),
         suggestion(name.layer, names));
}

FloatImage readAllChannels(const PictureName& name) {
    if (name.exr) {
        return readLayer(name);
    }
    return name.kind == ImageKind::linear ? readHdr(name.file) : toFloat(readBitmap(name.file));
}

FloatImage selectChannels(const FloatImage& image, const std::vector<size_t>& selected) {
    FloatImage result{image.width, image.height, {}, {}};
    for (const size_t channel : selected) {
        result.channels.push_back(image.channels[channel]);
    }
    result.data.reserve(image.data.size() / image.channels.size() * selected.size());
    for (size_t pixel = 0; pixel < image.data.size(); pixel += image.channels.size()) {
        for (const size_t channel : selected) {
            result.data.push_back(image.data[pixel + channel]);
        }
    }
    return result;
}

void checkSize(const PictureName& name, const FloatImage& mask, const FloatImage& picture) {
    if (mask.width != picture.width || mask.height != picture.height) {
        fail("{}: the mask is {}x{}, but the image is {}x{}", name.text, mask.width, mask.height, picture.width,
             picture.height);
    }
}

FloatImage readKnowledge(const PictureName& name) {
    if (!name.exr) {
        fail("{}: --mask hits needs EXR files with a layer 'confidence' or 'depth'", name.file);
    }
    const std::vector<ImageLayer> layers = readExr(name.file);
    for (const char* wanted : {"confidence", "depth"}) {
        if (const ImageLayer* layer = findLayer(layers, wanted)) {
            return layer->image;
        }
    }
    fail("{}: --mask hits needs a layer 'confidence' or 'depth', which the file lacks: write one with --aov depth",
         name.file);
}

}  // namespace

FloatImage toFloat(const Bitmap& bitmap) {
    static const std::vector<std::string> names[] = {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    REFLET_CHECK(bitmap.channels >= 1 && bitmap.channels <= 4, "{} channels", bitmap.channels);
    FloatImage image{bitmap.width, bitmap.height, names[bitmap.channels - 1], {}};
    image.data.reserve(bitmap.data.size());
    std::ranges::transform(bitmap.data, std::back_inserter(image.data),
                           [](uint8_t v) { return static_cast<float>(v) / 255.0F; });
    return image;
}

PictureName parsePictureName(const std::string& text) {
    PictureName name{text, text, "", ImageKind::linear, false};
    std::string ending = text;
    if (const auto parts = splitLayer(text)) {
        ending = parts->first;
        std::error_code ignored;
        if (!fs::exists(text, ignored)) {
            std::tie(name.file, name.layer) = *parts;
        }
    }
    const std::optional<ImageKind> kind = kindOf(ending);
    if (!kind) {
        failUsage("{}: the name must end in .png, .jpg, .jpeg, .exr (or .exr:LAYER) or .hdr", text);
    }
    name.kind = *kind;
    name.exr = inLowerCase(fs::path(ending).extension().string()) == ".exr";
    if (!name.exr && name.file != text) {
        failUsage("{}: only EXR files have layers", text);
    }
    return name;
}

FloatImage readPicture(const PictureName& name) {
    const FloatImage image = readAllChannels(name);
    std::vector<size_t> selected;
    for (const char* color : {"R", "G", "B"}) {
        const auto found = std::ranges::find(image.channels, color);
        if (found != image.channels.end()) {
            selected.push_back(static_cast<size_t>(found - image.channels.begin()));
        }
    }
    if (selected.size() < 3) {
        selected.clear();
        for (size_t channel = 0; channel < image.channels.size(); ++channel) {
            if (image.channels[channel] != "A") {
                selected.push_back(channel);
            }
        }
    }
    if (selected.empty()) {
        fail("{}: has only an alpha channel, which is not compared", name.text);
    }
    return selectChannels(image, selected);
}

std::vector<bool> readMask(const PictureName& name, const FloatImage& picture) {
    const FloatImage image = readPicture(name);
    checkSize(name, image, picture);
    const auto channels = static_cast<ptrdiff_t>(image.channels.size());
    std::vector<bool> mask;
    for (auto pixel = image.data.begin(); pixel != image.data.end(); pixel += channels) {
        mask.push_back(std::accumulate(pixel, pixel + channels, 0.0F) > 0.5F * static_cast<float>(channels));
    }
    return mask;
}

std::vector<bool> readHitMask(std::span<const PictureName> names, const FloatImage& picture) {
    std::vector<bool> mask(size_t{picture.width} * picture.height, true);
    for (const PictureName& name : names) {
        const FloatImage layer = readKnowledge(name);
        checkSize(name, layer, picture);
        const size_t channels = layer.channels.size();
        for (size_t i = 0; i < mask.size(); ++i) {
            const std::span values(&layer.data[i * channels], channels);
            mask[i] = mask[i] && std::ranges::any_of(values, [](float v) { return v > 0.0F; });
        }
    }
    return mask;
}

}  // namespace reflet
