// OpenEXR files with several layers, encoded and decoded in memory, so that all file errors are reported in one place.
#include "base/image_file.h"

#include "base/encoded_image.h"
#include "base/error.h"
#include "base/exr_check.h"
#include "base/file.h"
#include "base/image_camera.h"
#include "base/limits.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfThreading.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <map>
#include <new>
#include <string_view>
#include <system_error>
#include <thread>

namespace reflet {
namespace {

constexpr int largestSide = 65536;  // pixels

class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : OStream("") {}

    void write(const char data[], int count) override {
        const auto size = static_cast<size_t>(count);
        content.resize(std::max(content.size(), position_ + size));
        std::memcpy(content.data() + position_, data, size);
        position_ += size;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }

    std::string content;

private:
    size_t position_ = 0;
};

class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(std::string_view content) : IStream(""), content_(content) {}

    bool read(char target[], int count) override {
        const auto size = static_cast<size_t>(count);
        if (position_ > content_.size() || size > content_.size() - position_) {
            fail("the file ends too early");
        }
        std::memcpy(target, content_.data() + position_, size);
        position_ += size;
        return position_ < content_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }

private:
    std::string_view content_;
    size_t position_ = 0;
};

/// Extracts the reason from OpenEXR's messages, `Cannot do this with file "". Reason.`
std::string exrReason(const std::exception& error) {
    std::string text = error.what();
    if (const size_t end = text.rfind("\". "); end != std::string::npos) {
        text.erase(0, end + 3);
    }
    std::ranges::replace(text, '\n', ' ');
    while (!text.empty() && (text.back() == '.' || text.back() == ' ')) {
        text.pop_back();
    }
    return text;
}

std::string channelName(const std::string& layer, const std::string& channel) {
    return layer.empty() ? channel : layer + "." + channel;
}

size_t pixelCount(const FloatImage& image) {
    return size_t{image.width} * image.height;
}

void checkLayers(std::span<const ImageLayer> layers) {
    REFLET_CHECK(!layers.empty(), "an EXR file needs a layer");
    for (const auto& [name, image, pixelType] : layers) {
        REFLET_CHECK(image.width == layers[0].image.width && image.height == layers[0].image.height,
                     "layer '{}': {}x{}", name, image.width, image.height);
        REFLET_CHECK(pixelCount(image) > 0 && !image.channels.empty() &&
                         image.data.size() == pixelCount(image) * image.channels.size(),
                     "layer '{}': {}x{}, {} channels, {} values", name, image.width, image.height,
                     image.channels.size(), image.data.size());
    }
}

/// Finite values stay finite: an infinity would spoil every later sum.
std::vector<half> toHalf(const std::vector<float>& values) {
    std::vector<half> result(values.size());
    std::ranges::transform(values, result.begin(), [](float value) {
        return half(std::isfinite(value) ? std::clamp(value, -float{HALF_MAX}, float{HALF_MAX}) : value);
    });
    return result;
}

/// The slice of one channel of interleaved values whose first pixel is the corner of `window`.
template <class T>
Imf::Slice sliceOf(Imf::PixelType type, const T* values, size_t channel, size_t channels, const Imath::Box2i& window) {
    const size_t xStride = channels * sizeof(T);
    const auto width = static_cast<size_t>(window.max.x - window.min.x) + 1;
    return Imf::Slice::Make(type, values + channel, window, xStride, xStride * width);
}

/// Process-wide settings of OpenEXR.
void configureOpenExr() {
    static const bool once = [] {
        // Most of the writing time is compression. The bytes do not depend on the number of threads.
        Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
        // OpenEXR allocates its line buffers before the header can be checked, and the header may be damaged.
        Imf::Header::setMaxImageSize(largestSide, largestSide);
        return true;
    }();
    (void)once;
}

/// Imath multiplies row vectors, so its rows are our columns.
Imath::M44f imathMatrix(const mat4& m) {
    Imath::M44f result;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            result[i][j] = m[i][j];
        }
    }
    return result;
}

std::string encodeExr(std::span<const ImageLayer> layers, const ImageCamera* camera) {
    configureOpenExr();
    Imf::Header header(static_cast<int>(layers[0].image.width), static_cast<int>(layers[0].image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    if (camera) {
        Imf::addWorldToCamera(header, imathMatrix(camera->worldToCamera));
        Imf::addWorldToNDC(header, imathMatrix(camera->worldToNdc));
    }
    Imf::FrameBuffer frameBuffer;
    std::vector<std::vector<half>> halfData(layers.size());
    for (size_t i = 0; i < layers.size(); ++i) {
        const auto& [name, image, pixelType] = layers[i];
        const bool isHalf = pixelType == PixelType::half;
        if (isHalf) {
            halfData[i] = toHalf(image.data);
        }
        for (size_t c = 0; c < image.channels.size(); ++c) {
            const std::string channel = channelName(name, image.channels[c]);
            REFLET_CHECK(header.channels().findChannel(channel) == nullptr, "two channels '{}'", channel);
            header.channels().insert(channel, Imf::Channel(isHalf ? Imf::HALF : Imf::FLOAT));
            frameBuffer.insert(
                channel, isHalf
                             ? sliceOf(Imf::HALF, halfData[i].data(), c, image.channels.size(), header.dataWindow())
                             : sliceOf(Imf::FLOAT, image.data.data(), c, image.channels.size(), header.dataWindow()));
        }
    }
    MemoryOutput output;
    {
        Imf::OutputFile file(output, header);
        file.setFrameBuffer(frameBuffer);
        file.writePixels(static_cast<int>(layers[0].image.height));
    }  // the destructor writes the table of offsets
    return std::move(output.content);
}

int channelRank(const std::string& channel) {
    const size_t rank = std::string_view("RGBA").find(channel);
    return channel.size() == 1 && rank != std::string_view::npos ? static_cast<int>(rank) : 4;
}

/// The layers in the header, without pixels.
std::vector<ImageLayer> layersOf(const Imf::Header& header, uint32_t width, uint32_t height) {
    std::map<std::string, ImageLayer> byName;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
        if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
            fail("channel '{}' is subsampled, which is not supported", it.name());
        }
        const std::string full = it.name();
        const size_t dot = full.rfind('.');
        const std::string name = dot == std::string::npos ? "" : full.substr(0, dot);
        ImageLayer& layer =
            byName.try_emplace(name, ImageLayer{name, {width, height, {}, {}}, PixelType::half}).first->second;
        layer.image.channels.push_back(dot == std::string::npos ? full : full.substr(dot + 1));
        if (it.channel().type != Imf::HALF) {
            layer.pixelType = PixelType::float32;
        }
    }
    std::vector<ImageLayer> layers;
    for (auto& [name, layer] : byName) {
        std::ranges::stable_sort(layer.image.channels, {}, channelRank);
        layers.push_back(std::move(layer));
    }
    return layers;
}

/// Rejects damaged headers that would need any amount of memory.
void checkPlausible(const std::vector<ImageLayer>& layers, size_t fileSize) {
    double bytes = 0;  // as a double it cannot overflow
    for (const auto& [name, image, pixelType] : layers) {
        bytes += double{sizeof(float)} * image.width * image.height * static_cast<double>(image.channels.size());
    }
    constexpr double bestCompression = 4096;  // ZIP reaches 1000 on zeros, which double in size as floats
    if (bytes > bestCompression * static_cast<double>(fileSize)) {
        fail("an image of {:g} bytes cannot be stored in {} bytes", bytes, fileSize);
    }
    if (bytes > 0.0) {
        const FloatImage& first = layers.front().image;  // all have one size
        const double pixels = double(first.width) * first.height;
        const std::string excess = imageExcess(first.width, first.height, static_cast<uint64_t>(bytes / pixels));
        if (!excess.empty()) {
            fail("it {}", excess);
        }
    }
}

std::vector<ImageLayer> decodeExr(std::string_view content) {
    configureOpenExr();
    if (!exrHeadersAreWhole(content)) {
        fail("its header is broken");
    }
    MemoryInput input(content);
    Imf::InputFile file(input, 0);  // single-threaded: stops at the first damaged line, where threads go on
    const Imath::Box2i window = file.header().dataWindow();
    std::vector<ImageLayer> layers = layersOf(file.header(), static_cast<uint32_t>(window.max.x - window.min.x + 1),
                                              static_cast<uint32_t>(window.max.y - window.min.y + 1));
    checkPlausible(layers, content.size());
    Imf::FrameBuffer frameBuffer;
    for (auto& [name, image, pixelType] : layers) {
        image.data.resize(pixelCount(image) * image.channels.size());
        for (size_t c = 0; c < image.channels.size(); ++c) {
            frameBuffer.insert(channelName(name, image.channels[c]),
                               sliceOf(Imf::FLOAT, image.data.data(), c, image.channels.size(), window));
        }
    }
    file.setFrameBuffer(frameBuffer);
    file.readPixels(window.min.y, window.max.y);
    return layers;
}

void writeEncoded(const std::filesystem::path& path, std::span<const ImageLayer> layers, const ImageCamera* camera) {
    checkLayers(layers);
    std::string content;
    try {
        content = encodeExr(layers, camera);
    } catch (const std::logic_error&) {
        throw;  // a failed check
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::system_error& error) {
        fail("{}: cannot be encoded as EXR: {}{}", path.string(), error.what(),
             error.code() == std::errc::resource_unavailable_try_again
                 ? ": no thread could be started; raise the limit of processes (ulimit -u), or end others"
                 : "");
    } catch (const std::exception& error) {
        fail("{}: cannot be encoded as EXR: {}", path.string(), exrReason(error));
    }
    writeFileAtomically(path, content);
}

// The last line is the last of the file, as all that writeExr writes are in increasing order.
bool exrHasItsEnd(const std::filesystem::path& path) {
    configureOpenExr();
    Imf::InputFile file(path.c_str(), 0);
    const Imath::Box2i window = file.header().dataWindow();
    const Imf::ChannelList& channels = file.header().channels();
    if (!file.isComplete() || channels.begin() == channels.end() || window.max.x - window.min.x >= largestSide) {
        return false;
    }
    std::vector<float> line(static_cast<size_t>(window.max.x - window.min.x) + 1);
    char* const base = reinterpret_cast<char*>(line.data() - window.min.x);
    Imf::FrameBuffer frameBuffer;
    frameBuffer.insert(channels.begin().name(), Imf::Slice(Imf::FLOAT, base, sizeof(float), 0));
    file.setFrameBuffer(frameBuffer);
    file.readPixels(window.max.y);
    return true;
}

}  // namespace

bool isWholeImage(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return false;
    }
    const uint64_t size = std::filesystem::file_size(path, ignored);
    try {
        if (path.extension() == ".exr") {
            return exrHasItsEnd(path);
        }
        return path.extension() == ".png" ? pngHasItsEnd(path, size) : size > 0;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {  // not readable: writing a new one says why, if that cannot be done either
        return false;
    }
}

void writeExr(const std::filesystem::path& path, std::span<const ImageLayer> layers) {
    writeEncoded(path, layers, nullptr);
}

void writeExr(const std::filesystem::path& path, std::span<const ImageLayer> layers, const ImageCamera& camera) {
    writeEncoded(path, layers, &camera);
}

std::vector<ImageLayer> readExr(const std::filesystem::path& path) {
    const std::string content = readFile(path, memoryLimit());
    try {
        return decodeExr(content);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fail("{}: cannot be read as EXR: {}", path.string(), exrReason(error));
    }
}

}  // namespace reflet
