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

/// Collects what jsonTextsIn returns, from the parser's events.
class TextsIn final : public nlohmann::json_sax<nlohmann::json> {
public:
    TextsIn(std::span<const std::string_view> arrays, std::string_view key) : arrays_(arrays), key_(key) {}

    bool null() override { return true; }
    bool boolean(bool /*value*/) override { return true; }
    bool number_integer(number_integer_t /*value*/) override { return true; }
    bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
    bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
    bool binary(binary_t& /*value*/) override { return true; }

    bool string(string_t& value) override {
        if (inArray_ && atKey_ && isArray_ == std::vector<bool>{false, true, false}) {
            found.push_back(std::move(value));
        }
        return true;
    }
    bool key(string_t& name) override {
        if (isArray_.size() == 1) {
            inArray_ = std::ranges::find(arrays_, name) != arrays_.end();
        }
        atKey_ = name == key_;
        return true;
    }
    bool start_object(std::size_t /*size*/) override { return open(false); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t /*size*/) override { return open(true); }
    bool end_array() override { return close(); }
    bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                     const nlohmann::detail::exception& /*error*/) override {
        return false;
    }

    std::vector<std::string> found;

private:
    bool open(bool array) {
        isArray_.push_back(array);
        return true;
    }
    bool close() {
        isArray_.pop_back();
        atKey_ = false;
        return true;
    }

    std::span<const std::string_view> arrays_;
    std::string_view key_;
    std::vector<bool> isArray_;  ///< per level that is open
    bool inArray_ = false;
    bool atKey_ = false;
};

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

size_t jsonErrorByte(const std::exception& error, std::string_view text) {
    if (const auto* parse = dynamic_cast<const nlohmann::json::parse_error*>(&error); parse != nullptr) {
        return parse->byte;
    }
    std::string_view number = error.what();  // "... number overflow parsing '1e999'"
    number.remove_prefix(number.find('\'') + 1);
    number = number.substr(0, number.find('\''));
    bool inText = false;
    for (size_t i = 0; i < text.size() && !number.empty(); ++i) {
        if (!inText && text.substr(i).starts_with(number)) {
            return i + 1;
        }
        if (inText && text[i] == '\\') {
            ++i;
        } else if (text[i] == '"') {
            inText = !inText;
        }
    }
    return 0;
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

std::vector<std::string> jsonTextsIn(std::string_view text, std::span<const std::string_view> arrays,
                                     std::string_view key, const JsonLimits& limits) {
    refuseExcess(text, limits);
    TextsIn texts(arrays, key);
    if (!nlohmann::json::sax_parse(text, &texts)) {
        fail("the text is not JSON");
    }
    return std::move(texts.found);
}

std::string jsonText(const nlohmann::json& json, int indent) {
    return withoutHidden(json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string jsonText(const nlohmann::ordered_json& json, int indent) {
    return withoutHidden(json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace reflet
