// PNG and other 8-bit formats through stb, encoded and decoded in memory.
#include "base/image_file.h"

#include "base/error.h"
#include "base/file.h"
#include "base/jpeg_check.h"
#include "base/limits.h"
#include "base/message.h"
#include "base/png_check.h"

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <limits>
#include <memory>
#include <new>
#include <string_view>

namespace reflet {
namespace {

template <class T>
using StbPixels = std::unique_ptr<T, decltype(&stbi_image_free)>;

/// The content of a file, checked for the size limit of stb.
struct Encoded {
    explicit Encoded(const std::filesystem::path& path) : content(readFile(path, memoryLimit())) {
        if (content.size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
            fail("{}: cannot be read: larger than 2 GiB", path.string());
        }
    }
    [[nodiscard]] const stbi_uc* data() const { return reinterpret_cast<const stbi_uc*>(content.data()); }
    [[nodiscard]] int size() const { return static_cast<int>(content.size()); }

    std::string content;
};

[[noreturn]] void failDecode(const std::filesystem::path& path) {
    const char* reason = stbi_failure_reason();  // may quote the file
    if (reason != nullptr && std::string_view(reason) == "outofmem") {
        throw std::bad_alloc();
    }
    fail("{}: cannot be read as an image: {}", path.string(), reason != nullptr ? reason : "unknown format");
}

/// stb reads more formats than these, by readers that crash or never end on broken files.
void checkFormat(const std::filesystem::path& path, std::span<const uint8_t> bytes) {
    if (!startsAsPng(bytes) && !startsAsJpeg(bytes)) {
        fail("{}: cannot be read as an image: it is neither PNG nor JPEG", path.string());
    }
    if (const std::string problem = startsAsJpeg(bytes) ? jpegProblem(bytes) : pngProblem(bytes); !problem.empty()) {
        fail("{}: cannot be read as an image: {}", path.string(), problem);
    }
}

void appendToString(void* target, void* data, int size) {
    static_cast<std::string*>(target)->append(static_cast<const char*>(data), static_cast<size_t>(size));
}

}  // namespace

void writePng(const std::filesystem::path& path, const Bitmap& bitmap) {
    const size_t stride = size_t{bitmap.width} * bitmap.channels;
    REFLET_CHECK(bitmap.channels == 3 || bitmap.channels == 4, "{} channels", bitmap.channels);
    REFLET_CHECK(bitmap.width > 0 && bitmap.height > 0 && bitmap.data.size() == stride * bitmap.height,
                 "{}x{}, {} bytes", bitmap.width, bitmap.height, bitmap.data.size());
    std::string png;
    const int done =
        stbi_write_png_to_func(appendToString, &png, static_cast<int>(bitmap.width), static_cast<int>(bitmap.height),
                               static_cast<int>(bitmap.channels), bitmap.data.data(), static_cast<int>(stride));
    if (done == 0) {
        fail("{}: cannot be encoded as PNG: out of memory", path.string());
    }
    writeFileAtomically(path, png);
}

Bitmap readBitmap(const std::filesystem::path& path) {
    const Encoded file(path);
    int width = 0;
    int height = 0;
    int channels = 0;
    checkFormat(path, {file.data(), file.content.size()});
    if (stbi_info_from_memory(file.data(), file.size(), &width, &height, &channels) == 0) {
        failDecode(path);
    }
    constexpr uint64_t bytesPerPixel = 16;  // the inflated rows, two copies while channels are added, the result
    const std::string excess = imageExcess(static_cast<uint64_t>(width), static_cast<uint64_t>(height), bytesPerPixel);
    if (width <= 0 || height <= 0 || !excess.empty()) {
        fail("{}: cannot be read as an image: it {}", path.string(), excess.empty() ? "has no pixels" : excess);
    }
    const StbPixels<stbi_uc> pixels(stbi_load_from_memory(file.data(), file.size(), &width, &height, &channels, 0),
                                    &stbi_image_free);
    if (!pixels) {
        failDecode(path);
    }
    Bitmap bitmap{static_cast<uint32_t>(width), static_cast<uint32_t>(height), static_cast<uint32_t>(channels), {}};
    bitmap.data.assign(pixels.get(), pixels.get() + size_t{bitmap.width} * bitmap.height * bitmap.channels);
    return bitmap;
}

}  // namespace reflet
