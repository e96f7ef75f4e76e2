// Reads a .gltf or .glb file into its JSON document and its binary chunk.
// Layout of a .glb: "Binary glTF Layout", Khronos glTF 2.0 specification, 2021.
#include "scene/gltf/container.h"
#include "base/json_text.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <span>
#include <system_error>

namespace reflet {

namespace {

constexpr uint64_t maxFileBytes = 1ULL << 32U;  // a .glb stores its length in 32 bits
constexpr uint64_t maxJsonBytes = 1ULL << 29U;
constexpr uint64_t jsonBytesPerValue = 256;  // as JSON and as what is read from it
constexpr size_t headerBytes = 12;
constexpr size_t chunkHeaderBytes = 8;
constexpr uint32_t magicGltf = 0x46546C67;
constexpr uint32_t chunkJson = 0x4E4F534A;
constexpr uint32_t chunkBin = 0x004E4942;

using Bytes = std::span<const uint8_t>;

uint32_t readU32(Bytes bytes, size_t at) {
    return uint32_t(bytes[at]) | uint32_t(bytes[at + 1]) << 8U | uint32_t(bytes[at + 2]) << 16U |
           uint32_t(bytes[at + 3]) << 24U;
}

nlohmann::json parseJson(Bytes bytes, GltfReport& report) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const JsonLimits limits{.bytes = maxJsonBytes, .values = UINT64_MAX};
    if (const std::string excess = jsonExcess(text, limits); !excess.empty()) {
        report.fail("JSON", "{}", excess);
    }
    report.charge("JSON", jsonBytesPerValue * jsonValues(text));
    try {
        return reflet::parseJson(text, limits);
    } catch (const nlohmann::json::exception& error) {
        const size_t byte = jsonErrorByte(error, text);
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
        const bool invalid = dynamic_cast<const nlohmann::json::parse_error*>(&error) != nullptr;
        report.fail("JSON", "{} at line {}, byte {} of {}",
                    invalid ? "is not valid JSON" : "has a number beyond the range of doubles",
                    1 + std::count(text.begin(), end, '\n'), byte, text.size());
    }
}

/// Some writers pad the JSON of a .glb with zeros instead of spaces.
Bytes withoutZeros(Bytes text, GltfReport& report) {
    const auto last = std::find_if(text.rbegin(), text.rend(), [](uint8_t c) { return c != 0; });
    const auto zeros = static_cast<size_t>(last - text.rbegin());
    report.tolerate("they will be ignored", [&] {
        if (zeros > 0) {
            report.fail("JSON", "ends with {} zero bytes", zeros);
        }
    });
    return text.first(text.size() - zeros);
}

/// The bytes of the chunk that starts at `at`, which is advanced past it.
Bytes nextChunk(Bytes file, size_t& at, uint32_t& type, GltfReport& report) {
    if (file.size() - at < chunkHeaderBytes) {
        report.fail("GLB chunk", "its header at byte {} is truncated", at);
    }
    const uint64_t length = readU32(file, at);
    type = readU32(file, at + 4);
    at += chunkHeaderBytes;
    const auto check = [&] {
        if (length > file.size() - at) {
            report.fail("GLB chunk", "at byte {} says it has {} bytes, but only {} follow", at - chunkHeaderBytes,
                        length, file.size() - at);
        }
    };
    if (type != chunkBin) {
        check();
    }
    report.tolerate("what lies beyond the end of the file will be missing", check);
    const Bytes chunk = file.subspan(at, std::min<uint64_t>(length, file.size() - at));
    at += chunk.size();
    return chunk;
}

struct Parts {
    Bytes json;
    std::optional<Bytes> bin;
};

Parts splitGlb(Bytes file, GltfReport& report) {
    if (file.size() < headerBytes) {
        report.fail("GLB header", "is truncated after {} bytes", file.size());
    }
    if (const uint32_t version = readU32(file, 4); version != 2) {
        report.fail("GLB header",
                    "says version {}, but only version 2 is supported: convert the file, or export it anew", version);
    }
    report.tolerate("what the file has will be read", [&] {
        if (const uint32_t length = readU32(file, 8); length != file.size()) {
            report.fail("GLB header", "says the file has {} bytes, but it has {}", length, file.size());
        }
    });
    Parts result;
    size_t at = headerBytes;
    uint32_t type = 0;
    const Bytes json = nextChunk(file, at, type, report);
    if (type != chunkJson) {
        report.fail("GLB chunk", "the first one is not JSON");
    }
    report.tolerate("what follows the last whole chunk will be missing", [&] {
        while (at < file.size() && !result.bin) {
            const Bytes chunk = nextChunk(file, at, type, report);
            if (type == chunkBin) {
                result.bin = chunk;
            }
        }
    });
    result.json = withoutZeros(json, report);
    return result;
}

/// file: not empty.
Parts partsOf(Bytes file, GltfReport& report) {
    const bool isGlb = file.size() >= 4 && readU32(file, 0) == magicGltf;
    return isGlb ? splitGlb(file, report) : Parts{.json = file, .bin = std::nullopt};
}

std::vector<uint8_t> readNotEmpty(const std::filesystem::path& path, GltfReport& report) {
    std::vector<uint8_t> file = readFileBytes(path, maxFileBytes, "", report);
    if (file.empty()) {
        report.fail("", "is empty");
    }
    return file;
}

/// Opens a file below a folder, folder by folder, so that none of them can have become a symbolic link since the path
/// was checked. Negative if it fails.
int openWithin(const std::filesystem::path& folder, const std::filesystem::path& path, int flags) {
    int at = ::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    const std::filesystem::path below = path.lexically_relative(folder);
    for (auto part = below.begin(); part != below.end() && at >= 0; ++part) {
        const bool last = std::next(part) == below.end();
        const int next = ::openat(at, part->c_str(), O_NOFOLLOW | (last ? flags : O_PATH | O_DIRECTORY | O_CLOEXEC));
        ::close(at);
        at = next;
    }
    return at;
}

}  // namespace

std::vector<uint8_t> readFileBytes(const std::filesystem::path& path, uint64_t maxBytes, std::string_view part,
                                   const GltfReport& report, const std::filesystem::path& within) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        report.fail(part, "there is no file {}", path.string());
    }
    if (!std::filesystem::is_regular_file(status)) {  // reading a pipe or a device might never end
        report.fail(part, "{} is not a file", path.string());
    }
    // Not blocking, and checked again: another file may have that name by now, such as a pipe.
    constexpr int flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;
    const int descriptor = within.empty() ? ::open(path.c_str(), flags) : openWithin(within, path, flags);
    const std::unique_ptr<std::FILE, decltype(&std::fclose)> file(descriptor < 0 ? nullptr : ::fdopen(descriptor, "rb"),
                                                                  std::fclose);
    struct stat opened {};
    if (!file || ::fstat(descriptor, &opened) != 0 || !S_ISREG(opened.st_mode)) {
        report.fail(part, "{} cannot be read", path.string());
    }
    std::vector<uint8_t> bytes(std::min(static_cast<uint64_t>(opened.st_size), maxBytes));
    if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
        report.fail(part, "{} cannot be read to its end", path.string());
    }
    return bytes;
}

GltfContainer readGltfContainer(const std::filesystem::path& path, GltfReport& report) {
    const std::vector<uint8_t> file = readNotEmpty(path, report);
    const Parts parts = partsOf(file, report);
    GltfContainer result;
    if (parts.bin) {
        result.bin.emplace(parts.bin->begin(), parts.bin->end());
    }
    result.document = parseJson(parts.json, report);
    return result;
}

std::vector<std::string> readGltfUris(const std::filesystem::path& path, GltfReport& report) {
    const std::vector<uint8_t> file = readNotEmpty(path, report);
    const Bytes json = partsOf(file, report).json;
    constexpr std::array<std::string_view, 2> arrays{"buffers", "images"};
    return jsonTextsIn({reinterpret_cast<const char*>(json.data()), json.size()}, arrays, "uri",
                       {.bytes = maxJsonBytes, .values = UINT64_MAX});
}

}  // namespace reflet
