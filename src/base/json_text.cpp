// JSON from and to text.
#include "base/json_text.h"

#include "base/error.h"
#include "base/visible_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet {

namespace {

struct Extent {
    uint64_t values = 1;
    int depth = 0;
};

// Counts what is outside of texts. The parser's callback could tell the depth, but takes time quadratic in the length
// of arrays.
Extent extentOf(std::string_view text) {
    Extent extent;
    int depth = 0;
    bool inText = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inText) {
            i += c == '\\' ? 1 : 0;
            inText = c != '"';
        } else if (c == '"') {
            inText = true;
        } else if (c == '[' || c == '{') {
            extent.depth = std::max(extent.depth, ++depth);
            ++extent.values;
        } else if (c == ']' || c == '}') {
            --depth;
        } else if (c == ',') {
            ++extent.values;
        }
    }
    return extent;
}

void refuseExcess(std::string_view text, const JsonLimits& limits) {
    if (const std::string excess = jsonExcess(text, limits); !excess.empty()) {
        fail("the JSON {}", excess);
    }
}

// Valid JSON in UTF-8 with hidden characters beyond ASCII, which are in texts alone, as JSON's own escapes: the
// serializer knows those of ASCII, and terminals obey some of the others.
std::string withoutHidden(std::string text) {
    if (std::ranges::all_of(text, [](unsigned char c) { return c < 0x7FU; })) {
        return text;
    }
    std::string result;
    for (std::string_view rest = text; !rest.empty();) {
        const Character first = firstCharacter(rest);
        const size_t length = std::max<size_t>(first.length, 1);
        const auto code = static_cast<uint32_t>(first.code);
        if (code < 0x7FU || !isHidden(first.code)) {
            result += rest.substr(0, length);
        } else if (code < 0x10000U) {
            result += fmt::format("\\u{:04x}", code);
        } else {
            result += fmt::format("\\u{:04x}\\u{:04x}", 0xD7C0U + (code >> 10U), 0xDC00U + (code & 0x3FFU));
        }
        rest.remove_prefix(length);
    }
    return result;
}

}  // namespace

uint64_t jsonValues(std::string_view text) {
    return extentOf(text).values;
}

std::string jsonExcess(std::string_view text, const JsonLimits& limits) {
    if (text.size() > limits.bytes) {
        return fmt::format("has {} bytes, more than the limit of {} MiB", text.size(), limits.bytes >> 20U);
    }
    const Extent extent = extentOf(text);
    if (extent.depth > limits.depth) {
        return fmt::format("is nested more than {} levels deep", limits.depth);
    }
    if (extent.values > limits.values) {
        return fmt::format("has more than {} values", limits.values);
    }
    return "";
}

nlohmann::json parseJson(std::string_view text, const JsonLimits& limits) {
    refuseExcess(text, limits);
    return nlohmann::json::parse(text);
}

nlohmann::json parseJsonIfValid(std::string_view text) {
    refuseExcess(text, {});
    return nlohmann::json::parse(text, nullptr, false);
}

nlohmann::ordered_json parseOrderedJson(std::string_view text) {
    refuseExcess(text, {});
    return nlohmann::ordered_json::parse(text);
}

std::string jsonText(const nlohmann::json& json, int indent) {
    return withoutHidden(json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string jsonText(const nlohmann::ordered_json& json, int indent) {
    return withoutHidden(json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace reflet
