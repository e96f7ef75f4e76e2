#include "base/png.h"

#include "base/error.h"
#include "base/message.h"

#include <spng.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <string_view>

namespace reflet {

namespace {

void check(int result) {
    if (result == SPNG_EMEM) {
        throw std::bad_alloc();
    }
    if (result != 0) {
        fail("{}", spng_strerror(result));
    }
}

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

Context newContext(int flags) {
    Context context(spng_ctx_new(flags), &spng_ctx_free);
    if (!context) {
        throw std::bad_alloc();
    }
    return context;
}

Context reader(std::span<const uint8_t> bytes) {
    constexpr size_t mostOfTexts = size_t{16} << 20U;  // of profiles and texts, inflated: these are not used
    const size_t most = std::max(bytes.size(), mostOfTexts);
    Context context = newContext(0);
    check(spng_set_chunk_limits(context.get(), most, most));
    check(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()));
    return context;
}

std::vector<uint8_t> decode(spng_ctx* png, spng_format format, size_t bytes) {
    size_t size = 0;
    check(spng_decoded_image_size(png, format, &size));
    REFLET_CHECK(size == bytes, "{} bytes, not {}", size, bytes);
    std::vector<uint8_t> pixels(size);
    check(spng_decode_image(png, pixels.data(), pixels.size(), format, SPNG_DECODE_TRNS));
    check(spng_decode_chunks(png));  // to the end, which a file that was cut off does not have
    return pixels;
}

}  // namespace

EncodedImageHeader readPngHeader(std::span<const uint8_t> bytes) {
    constexpr size_t header = 33;
    if (bytes.size() < header) {
        fail("its header is truncated");
    }
    const Context png = reader(bytes);
    spng_ihdr head{};
    check(spng_get_ihdr(png.get(), &head));
    spng_trns transparent{};
    const bool transparency = spng_get_trns(png.get(), &transparent) == 0;
    const bool color = (head.color_type & SPNG_COLOR_TYPE_TRUECOLOR) != 0;
    const bool alpha = head.color_type >= SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
    const bool indexed = head.color_type == SPNG_COLOR_TYPE_INDEXED;
    const uint32_t stored = indexed ? 1 : (color ? 3 : 1) + (alpha ? 1 : 0);
    return {.width = head.width,
            .height = head.height,
            .channels = (color ? 3U : 1U) + (alpha || transparency ? 1U : 0U),
            .bitsPerPixel = stored * head.bit_depth,
            .deep = head.bit_depth == 16};
}

std::vector<uint8_t> decodePng(std::span<const uint8_t> bytes, const EncodedImageHeader& header) {
    const Context png = reader(bytes);
    const size_t values = size_t{header.width} * header.height * 4;
    if (!header.deep) {
        return decode(png.get(), SPNG_FMT_RGBA8, values);
    }
    const std::vector<uint8_t> deep = decode(png.get(), SPNG_FMT_RGBA16, 2 * values);
    std::vector<uint8_t> rgba(values);
    for (size_t i = 0; i < values; ++i) {
        uint16_t value = 0;
        std::memcpy(&value, deep.data() + 2 * i, sizeof(value));
        rgba[i] = static_cast<uint8_t>((uint32_t{value} * 255 + 32767) / 65535);
    }
    return rgba;
}

std::string encodePng(uint32_t width, uint32_t height, uint32_t channels, std::span<const uint8_t> pixels) {
    const Context png = newContext(SPNG_CTX_ENCODER);
    spng_ihdr head{};
    head.width = width;
    head.height = height;
    head.bit_depth = 8;
    head.color_type = channels == 4 ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR;
    constexpr int level = 4;  // less than half the time of zlib's default for half a percent more bytes
    check(spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1));
    check(spng_set_option(png.get(), SPNG_IMG_COMPRESSION_LEVEL, level));
    check(spng_set_ihdr(png.get(), &head));
    check(spng_encode_image(png.get(), pixels.data(), pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE));
    size_t size = 0;
    int result = 0;
    const std::unique_ptr<void, decltype(&std::free)> encoded(spng_get_png_buffer(png.get(), &size, &result),
                                                              &std::free);
    check(result);
    return {static_cast<const char*>(encoded.get()), size};
}

bool pngHasItsEnd(const std::filesystem::path& file, uint64_t size) {
    constexpr std::string_view end("\0\0\0\0IEND\xAE\x42\x60\x82", 12);
    if (size < 8 + end.size()) {
        return false;
    }
    std::ifstream stream(file, std::ios::binary);
    std::array<char, end.size()> last{};
    stream.seekg(static_cast<std::streamoff>(size - end.size()));
    stream.read(last.data(), last.size());
    return stream.good() && std::string_view(last.data(), last.size()) == end;
}

}  // namespace reflet
