// JSON from and to text. nlohmann's parser and serializer are templates that take seconds to compile: these are the
// only places that compile them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace reflet {

/// Throws nlohmann::json::parse_error.
nlohmann::json parseJson(std::string_view text);
/// The same; a value that is_discarded() where the text is not JSON.
nlohmann::json parseJsonIfValid(std::string_view text);
/// As parseJson; objects keep the order of their keys.
nlohmann::ordered_json parseOrderedJson(std::string_view text);

/// With `indent` spaces per level; -1: all in one line. Bytes that are not UTF-8 become U+FFFD.
std::string jsonText(const nlohmann::json& json, int indent = -1);
std::string jsonText(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace reflet
