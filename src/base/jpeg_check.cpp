// Walks the segments of a JPEG image (ITU-T T.81, 1992, annex B) in the order in which stb_image does, which skips what
// is between them.
#include "base/jpeg_check.h"

#include <algorithm>
#include <array>

namespace reflet {

namespace {

using Bytes = std::span<const uint8_t>;

constexpr uint8_t markerStart = 0xFF;
constexpr uint8_t sofProgressive = 0xC2;
constexpr uint8_t dht = 0xC4;
constexpr uint8_t rst0 = 0xD0;
constexpr uint8_t soi = 0xD8;  // follows the eight restart markers
constexpr uint8_t eoi = 0xD9;
constexpr uint8_t sos = 0xDA;

constexpr int mostComponents = 4;  // a scan of its own for each, at most, unless it is progressive
constexpr int mostScans = 32;      // writers of progressive images make about ten

constexpr const char* truncated = "a segment of its header is truncated";

/// The tables that have been defined: [0] for DC, [1] for AC coefficients.
using Tables = std::array<std::array<bool, 4>, 2>;

std::string readTables(Bytes segment, Tables& tables) {
    constexpr size_t lengths = 16;
    constexpr size_t mostCodes = 256;
    while (!segment.empty()) {
        if (segment.size() < 1 + lengths) {
            return truncated;
        }
        const size_t kind = segment[0] >> 4U;
        const size_t number = segment[0] & 15U;
        size_t codes = 0;
        for (const uint8_t count : segment.subspan(1, lengths)) {
            codes += count;
        }
        if (kind > 1 || number > 3 || codes > mostCodes) {
            return "a Huffman table is broken";
        }
        if (segment.size() < 1 + lengths + codes) {
            return truncated;
        }
        tables.at(kind).at(number) = true;
        segment = segment.subspan(1 + lengths + codes);
    }
    return "";
}

/// A scan of a progressive image codes either DC or AC coefficients.
std::string checkScan(Bytes segment, const Tables& tables, bool progressive) {
    const size_t components = segment.empty() ? 0 : segment[0];
    if (segment.size() < 4 + 2 * components) {
        return truncated;
    }
    const bool startsAtDc = segment[1 + 2 * components] == 0;
    for (size_t i = 0; i < components; ++i) {
        const uint8_t selected = segment[2 + 2 * i];
        const size_t dc = selected >> 4U;
        const size_t ac = selected & 15U;
        const bool hasDc = dc < 4 && tables[0].at(dc);
        const bool hasAc = ac < 4 && tables[1].at(ac);
        if ((!hasDc && (!progressive || startsAtDc)) || (!hasAc && (!progressive || !startsAtDc))) {
            return "a scan uses a Huffman table that is not defined";
        }
    }
    return "";
}

bool startsWith(Bytes bytes, Bytes magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

}  // namespace

bool startsAsJpeg(Bytes bytes) {
    constexpr std::array<uint8_t, 3> magic{0xFF, 0xD8, 0xFF};
    return startsWith(bytes, magic);
}

std::string jpegProblem(Bytes bytes) {
    Tables tables{};
    int scans = 0;
    bool progressive = false;
    std::string problem;
    while (problem.empty()) {
        // To the next marker: past coded data, in which 0 follows FF, and restarts.
        bytes = bytes.subspan(static_cast<size_t>(std::ranges::find(bytes, markerStart) - bytes.begin()));
        const auto code = std::ranges::find_if(bytes, [](uint8_t byte) { return byte != markerStart; });
        if (code == bytes.end() || *code == eoi) {
            break;
        }
        const uint8_t marker = *code;
        bytes = bytes.subspan(static_cast<size_t>(code - bytes.begin()) + 1);
        if (marker == 0 || (marker >= rst0 && marker <= soi)) {
            continue;
        }
        const size_t length = bytes.size() < 2 ? 0 : size_t{bytes[0]} << 8U | bytes[1];
        if (length < 2 || length > bytes.size()) {
            return truncated;
        }
        const Bytes segment = bytes.subspan(2, length - 2);
        bytes = bytes.subspan(length);
        progressive = progressive || marker == sofProgressive;
        if (marker == dht) {
            problem = readTables(segment, tables);
        } else if (marker == sos && ++scans > (progressive ? mostScans : mostComponents)) {
            problem = "it has too many scans";
        } else if (marker == sos) {
            problem = checkScan(segment, tables, progressive);
        }
    }
    return problem;
}

}  // namespace reflet
