// Reads Radiance HDR images (RGBE). G. Ward, "Real Pixels", Graphics Gems II, 1991; Radiance file formats, 1997.
//
// Not by stb_image, which writes the other formats: Debian's version never ends on a truncated run (CVE-2021-42715),
// crashes on an image without pixels, and takes missing scanlines for black ones. Every read here is checked.
#include "base/image_file.h"

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/message.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace reflet {
namespace {

constexpr uint32_t mostSide = 65536;
constexpr uint32_t leastRunWidth = 8;  // narrower and wider scanlines are never run-length encoded
constexpr uint32_t mostRunWidth = 32767;
constexpr uint64_t bytesPerPixel = 16;  // floats and encoded bytes

/// What is left of the file. Throws Error, without the file's name, where it ends early.
class HdrInput {
public:
    explicit HdrInput(std::string_view content) : rest_(content) {}

    std::string_view line() {
        const size_t end = rest_.find('\n');
        if (end == std::string_view::npos) {
            fail("its header is truncated");
        }
        const std::string_view text = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return text.ends_with('\r') ? text.substr(0, text.size() - 1) : text;
    }

    std::string_view bytes(size_t count) {
        if (rest_.size() < count) {
            fail("it is truncated");
        }
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }

    uint8_t byte() { return static_cast<uint8_t>(bytes(1).front()); }

    [[nodiscard]] bool startsRuns(uint32_t width) const {
        return width >= leastRunWidth && width <= mostRunWidth && rest_.size() >= 4 && rest_[0] == 2 && rest_[1] == 2 &&
               (static_cast<uint8_t>(rest_[2]) & 0x80U) == 0;
    }
    [[nodiscard]] size_t size() const { return rest_.size(); }

private:
    std::string_view rest_;
};

struct HdrSize {
    uint32_t width = 0;
    uint32_t height = 0;
};

/// "-Y HEIGHT +X WIDTH": from the top, from the left. Other orders are legal, but no common program writes them.
HdrSize readSize(std::string_view line) {
    HdrSize size;
    constexpr std::string_view y = "-Y ";
    constexpr std::string_view x = " +X ";
    const char* end = line.data() + line.size();
    const size_t split = line.find(x);
    if (line.starts_with(y) && split != std::string_view::npos) {
        const char* middle = line.data() + split;
        const auto height = std::from_chars(line.data() + y.size(), middle, size.height);
        const auto width = std::from_chars(middle + x.size(), end, size.width);
        if (height.ec == std::errc() && height.ptr == middle && width.ec == std::errc() && width.ptr == end) {
            if (size.width == 0 || size.height == 0 || size.width > mostSide || size.height > mostSide) {
                fail("it has {} x {} pixels, but each side must have 1 to {}", size.width, size.height, mostSide);
            }
            return size;
        }
    }
    fail("its size must be '-Y HEIGHT +X WIDTH', is '{}'", oneLine(line, 40));
}

HdrSize readHeader(HdrInput& input) {
    bool known = false;
    for (std::string_view line = input.line(); !line.empty(); line = input.line()) {
        known = known || line == "FORMAT=32-bit_rle_rgbe";
    }
    if (!known) {
        fail("its pixels are not in the format 32-bit_rle_rgbe");
    }
    return readSize(input.line());
}

/// One component of a scanline: counts above 128 repeat the next byte, others copy as many bytes.
void readRuns(HdrInput& input, std::string& component) {
    for (size_t at = 0; at < component.size();) {
        const uint8_t count = input.byte();
        const size_t length = count > 128 ? count - 128U : count;
        if (length == 0 || length > component.size() - at) {
            fail("a run does not fit into its scanline");
        }
        if (count > 128) {
            component.replace(at, length, length, static_cast<char>(input.byte()));
        } else {
            component.replace(at, length, input.bytes(length));
        }
        at += length;
    }
}

void addPixel(FloatImage& image, uint8_t r, uint8_t g, uint8_t b, uint8_t exponent) {
    const float scale = exponent == 0 ? 0.0F : std::ldexp(1.0F, int{exponent} - 136);
    for (const uint8_t mantissa : {r, g, b}) {
        image.data.push_back(static_cast<float>(mantissa) * scale);
    }
}

void readScanline(HdrInput& input, FloatImage& image) {
    if (!input.startsRuns(image.width)) {
        const std::string_view pixels = input.bytes(size_t{image.width} * 4);
        for (size_t i = 0; i < pixels.size(); i += 4) {
            const auto at = [&](size_t k) { return static_cast<uint8_t>(pixels[i + k]); };
            if (at(0) == 1 && at(1) == 1 && at(2) == 1) {  // no pixel that a writer normalized
                fail("it has runs of an old encoding: convert it");
            }
            addPixel(image, at(0), at(1), at(2), at(3));
        }
        return;
    }
    const std::string_view start = input.bytes(4);
    const uint32_t width = static_cast<uint32_t>(static_cast<uint8_t>(start[2])) << 8U | static_cast<uint8_t>(start[3]);
    if (width != image.width) {
        fail("a scanline has {} pixels, the image {}", width, image.width);
    }
    std::array<std::string, 4> components;
    for (std::string& component : components) {
        component.resize(width);
        readRuns(input, component);
    }
    const auto& [r, g, b, e] = components;
    for (size_t i = 0; i < width; ++i) {
        const auto at = [&](const std::string& component) { return static_cast<uint8_t>(component[i]); };
        addPixel(image, at(r), at(g), at(b), at(e));
    }
}

/// Fewest bytes that `size` can be encoded in.
uint64_t leastBytes(const HdrSize& size) {
    constexpr uint64_t longestRun = 127;
    const bool runs = size.width >= leastRunWidth && size.width <= mostRunWidth;
    const uint64_t line = runs ? 4 + 8 * ((size.width + longestRun - 1) / longestRun) : uint64_t{4} * size.width;
    return size.height * std::min<uint64_t>(line, uint64_t{4} * size.width);
}

FloatImage decodeHdr(std::string_view content) {
    HdrInput input(content);
    const HdrSize size = readHeader(input);
    if (const std::string excess = imageExcess(size.width, size.height, bytesPerPixel); !excess.empty()) {
        fail("it {}", excess);
    }
    if (leastBytes(size) > input.size()) {
        fail("it is truncated: {} x {} pixels do not fit into {} bytes", size.width, size.height, input.size());
    }
    FloatImage image{size.width, size.height, {"R", "G", "B"}, {}};
    image.data.reserve(size_t{size.width} * size.height * 3);
    for (uint32_t row = 0; row < size.height; ++row) {
        readScanline(input, image);
    }
    return image;
}

}  // namespace

FloatImage readHdr(const std::filesystem::path& path) {
    const std::string content = readFile(path, memoryLimit());
    if (!content.starts_with("#?RADIANCE\n") && !content.starts_with("#?RGBE\n")) {
        fail("{}: is not a Radiance HDR image", path.string());
    }
    try {
        return decodeHdr(content);
    } catch (const UsageError&) {
        throw;
    } catch (const Error& error) {
        fail("{}: cannot be read as an image: {}", path.string(), error.what());
    }
}

}  // namespace reflet
