// Walks the chunks of a PNG file: length, big-endian; type; data; checksum (W3C, Portable Network Graphics, 2003, 5.3).
#include "base/png_check.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

namespace reflet {

namespace {

constexpr std::array<uint8_t, 8> magic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

}  // namespace

bool startsAsPng(std::span<const uint8_t> bytes) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

std::string pngProblem(std::span<const uint8_t> bytes) {
    constexpr size_t head = 8;
    constexpr size_t checksum = 4;
    std::span<const uint8_t> rest = bytes.subspan(std::min(magic.size(), bytes.size()));
    while (rest.size() >= head) {
        size_t length = 0;
        for (const uint8_t byte : rest.first(4)) {
            length = length << 8U | byte;
        }
        const std::string_view type(reinterpret_cast<const char*>(rest.data()) + 4, 4);
        rest = rest.subspan(head);
        if (length > rest.size()) {
            return "a chunk is truncated";
        }
        if (type == "IEND") {
            return "";
        }
        rest = rest.subspan(std::min(length + checksum, rest.size()));
    }
    return "its end is missing";
}

bool pngHasItsEnd(const std::filesystem::path& file, uint64_t size) {
    constexpr std::string_view end("\0\0\0\0IEND\xAE\x42\x60\x82", 12);
    if (size < magic.size() + end.size()) {
        return false;
    }
    std::ifstream stream(file, std::ios::binary);
    std::array<char, end.size()> last{};
    stream.seekg(static_cast<std::streamoff>(size - end.size()));
    stream.read(last.data(), last.size());
    return stream.good() && std::string_view(last.data(), last.size()) == end;
}

}  // namespace reflet
