// Walks the attributes of EXR headers. "OpenEXR File Layout", Academy Software Foundation, 2021: a header is a list of
// attributes (name, 0, type, 0, length, value), which ends with an empty name; a file of several parts has a list of
// headers, which ends with an empty header.
#include "base/exr_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

namespace reflet {

namespace {

constexpr size_t versionBytes = 8;

/// Types of one length. OpenEXR reads as many bytes as the type has, whatever the length says.
constexpr std::array<std::pair<std::string_view, size_t>, 23> typeLengths{
    {{"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
     {"compression", 1}, {"double", 8},   {"envmap", 1},
     {"float", 4},       {"int", 4},      {"keycode", 28},
     {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
     {"m44f", 64},       {"m44d", 128},   {"rational", 8},
     {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
     {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
     {"v3f", 12},        {"v3d", 24}}};

/// Takes bytes from the front; nothing where too few are left.
std::optional<std::string_view> take(std::string_view& from, uint64_t count) {
    if (count > from.size()) {
        return std::nullopt;
    }
    const std::string_view taken = from.substr(0, count);
    from.remove_prefix(count);
    return taken;
}

std::optional<std::string_view> takeName(std::string_view& from) {
    const auto name = take(from, std::min(from.find('\0'), from.size()));
    return take(from, 1) ? name : std::nullopt;
}

/// Little-endian; EXR's integers are signed, but none here may be negative.
std::optional<uint32_t> takeWord(std::string_view& from) {
    const auto bytes = take(from, 4);
    if (!bytes) {
        return std::nullopt;
    }
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) {
        value = value << 8U | static_cast<uint8_t>((*bytes)[i]);
    }
    return value;
}

/// Channels, each a name with 16 bytes, up to an empty name.
bool channelsFit(std::string_view value) {
    constexpr size_t channelBytes = 16;
    for (;;) {
        const auto name = takeName(value);
        if (!name || name->empty()) {
            return name && value.empty();
        }
        if (!take(value, channelBytes)) {
            return false;
        }
    }
}

bool textsFit(std::string_view value) {
    while (!value.empty()) {
        const auto length = takeWord(value);
        if (!length || !take(value, *length)) {
            return false;
        }
    }
    return true;
}

bool previewFits(std::string_view value) {
    const auto width = takeWord(value);
    const auto height = takeWord(value);
    return width && height && value.size() % 4 == 0 && uint64_t{*width} * *height == value.size() / 4;
}

bool fitsType(std::string_view value, std::string_view type) {
    const auto known = std::ranges::find(typeLengths, type, &std::pair<std::string_view, size_t>::first);
    if (known != typeLengths.end()) {
        return value.size() == known->second;
    }
    return type == "chlist"         ? channelsFit(value)
           : type == "stringvector" ? textsFit(value)
           : type == "preview"      ? previewFits(value)
                                    : true;
}

}  // namespace

bool exrHeadersAreWhole(std::string_view file) {
    if (!file.starts_with("v/1\1")) {  // OpenEXR says that it is another format
        return true;
    }
    constexpr unsigned char manyParts = 0x10;  // of the version's second byte
    const bool many = file.size() > versionBytes && (static_cast<unsigned char>(file[5]) & manyParts) != 0;
    std::string_view rest = file.substr(std::min(versionBytes, file.size()));
    for (bool first = true;;) {
        const auto name = takeName(rest);
        if (!name) {
            return false;
        }
        if (name->empty()) {
            if (first || !many) {
                return true;
            }
            first = true;
            continue;
        }
        first = false;
        const auto type = takeName(rest);
        const auto length = type ? takeWord(rest) : std::nullopt;
        const auto value = length ? take(rest, *length) : std::nullopt;
        if (!value || !fitsType(*value, *type)) {
            return false;
        }
    }
}

}  // namespace reflet
