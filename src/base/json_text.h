// JSON from and to text. nlohmann's parser and serializer are templates that take seconds to compile: these are the
// only places that compile them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// What a JSON text may have. Parsed values take 20 to 100 bytes each, "[]" alone three bytes of text; and much of what
/// reads, compares or writes a value calls itself for each level.
struct JsonLimits {
    uint64_t bytes = uint64_t{64} << 20U;
    uint64_t values = 4'000'000;  ///< numbers, texts, arrays, objects ...
    int depth = 128;              ///< of nested arrays and objects
};

/// Upper bound on the number of values in a text, which need not be valid JSON.
uint64_t jsonValues(std::string_view text);

/// Which limit the text exceeds, as the end of an error message; empty: none. All parsers below ask it first.
std::string jsonExcess(std::string_view text, const JsonLimits& limits = {});

/// The byte of a text, counted from 1, at which the parser stopped with this error (a nlohmann::json::exception): of a
/// number beyond the range of doubles the first, which nlohmann-json does not tell. 0: unknown.
size_t jsonErrorByte(const std::exception& error, std::string_view text);

/// Throws nlohmann::json::exception, or Error if the text exceeds a limit.
nlohmann::json parseJson(std::string_view text, const JsonLimits& limits = {});
/// The same; a value that is_discarded() where the text is not JSON.
nlohmann::json parseJsonIfValid(std::string_view text);
/// As parseJson; objects keep the order of their keys.
nlohmann::ordered_json parseOrderedJson(std::string_view text);

/// The texts named `key` in the objects that these arrays of a document hold: the values of {"ARRAY": [{"KEY":
/// "..."}]}, in the text's order. Keeps nothing else of the document. Throws Error if the text is not JSON or exceeds a
/// limit.
std::vector<std::string> jsonTextsIn(std::string_view text, std::span<const std::string_view> arrays,
                                     std::string_view key, const JsonLimits& limits = {});

/// With `indent` spaces per level; -1: all in one line. Bytes that are not UTF-8 become U+FFFD.
std::string jsonText(const nlohmann::json& json, int indent = -1);
std::string jsonText(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace reflet
