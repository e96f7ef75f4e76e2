// Reads the target of a URI in a glTF file: a data URI, or a file inside the scene's folder.
// RFC 3986 (Berners-Lee et al., 2005) for URIs, RFC 2397 (Masinter, 1998) for data, RFC 4648 (Josefsson, 2006) for
// base64.
#include "scene/gltf/uri.h"

#include "scene/gltf/container.h"

#include <algorithm>
#include <optional>
#include <system_error>

namespace reflet {

namespace {

std::optional<unsigned> hexDigit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? std::optional<unsigned>(lower - 'a' + 10) : std::nullopt;
}

/// 0..63, or nothing. Both alphabets of RFC 4648.
std::optional<uint32_t> base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    if (c == '+' || c == '-') {
        return 62;
    }
    return c == '/' || c == '_' ? std::optional<uint32_t>(63) : std::nullopt;
}

std::vector<uint8_t> base64Decoded(std::string_view text, std::string_view part, const GltfReport& report) {
    while (!text.empty() && text.back() == '=') {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) {
        report.fail(part, "its base64 data is truncated");
    }
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    unsigned count = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const auto digit = base64Digit(text[i]);
        if (!digit) {
            report.fail(part, "character {} of its base64 data is invalid", i);
        }
        bits = bits << 6U | *digit;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<uint8_t>(bits >> count));
        }
    }
    return bytes;
}

std::vector<uint8_t> readDataUri(std::string_view uri, std::string_view part, const GltfReport& report) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        report.fail(part, "is a data URI without data");
    }
    const std::string_view data = uri.substr(comma + 1);
    if (uri.substr(0, comma).ends_with(";base64")) {
        return base64Decoded(data, part, report);
    }
    const std::string decoded = percentDecoded(data);
    return {decoded.begin(), decoded.end()};
}

/// Whether it starts with "scheme:". This includes Windows drive letters, which are absolute paths, too.
bool hasScheme(std::string_view uri) {
    const size_t colon = uri.find_first_of(":/?#");
    return colon != std::string_view::npos && uri[colon] == ':';
}

bool leavesFolder(std::string_view name) {
    if (name.empty() || name.front() == '/' || name.front() == '\\') {
        return true;
    }
    for (size_t start = 0; start <= name.size();) {
        const size_t end = std::min(name.find_first_of("/\\", start), name.size());
        if (name.substr(start, end - start) == "..") {
            return true;
        }
        start = end + 1;
    }
    return false;
}

bool isInside(const std::filesystem::path& path, const std::filesystem::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

std::string percentDecoded(std::string_view uri) {
    std::string result;
    result.reserve(uri.size());
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size()) {
            const auto high = hexDigit(uri[i + 1]);
            const auto low = hexDigit(uri[i + 2]);
            if (high && low) {
                result += static_cast<char>(*high << 4U | *low);
                i += 2;
                continue;
            }
        }
        result += uri[i];
    }
    return result;
}

UriFile uriFile(const std::string& uri, const std::filesystem::path& folder, std::string_view part,
                const GltfReport& report) {
    const std::string shown = uri.substr(0, 80);
    const std::string name = percentDecoded(uri);
    if (hasScheme(uri) || hasScheme(name)) {
        report.fail(part, "{} is not a file in the scene's folder", shown);
    }
    if (leavesFolder(name) || name.find('\0') != std::string::npos) {
        report.fail(part, "{} leads out of the scene's folder", shown);
    }
    std::error_code error;
    const auto home = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, error);
    const auto path = error ? home : std::filesystem::weakly_canonical(home / name, error);
    if (error) {
        report.fail(part, "{} cannot be found: {}", shown, error.message());
    }
    if (!isInside(path, home)) {  // a symbolic link
        report.fail(part, "{} leads out of the scene's folder", shown);
    }
    return {home, path};
}

std::vector<uint8_t> readUri(const std::string& uri, const std::filesystem::path& folder, uint64_t maxBytes,
                             std::string_view part, const GltfReport& report) {
    if (uri.starts_with("data:")) {
        return readDataUri(uri, part, report);
    }
    const UriFile file = uriFile(uri, folder, part, report);
    return readFileBytes(file.path, maxBytes, part, report, file.folder);
}

}  // namespace reflet
