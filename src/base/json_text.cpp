// JSON from and to text.
#include "base/json_text.h"

#include "base/error.h"

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
    return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string jsonText(const nlohmann::ordered_json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace reflet
