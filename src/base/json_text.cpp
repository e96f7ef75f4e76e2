// JSON from and to text.
#include "base/json_text.h"

#include <nlohmann/json.hpp>

namespace reflet {

nlohmann::json parseJson(std::string_view text) {
    return nlohmann::json::parse(text);
}

nlohmann::json parseJsonIfValid(std::string_view text) {
    return nlohmann::json::parse(text, nullptr, false);
}

nlohmann::ordered_json parseOrderedJson(std::string_view text) {
    return nlohmann::ordered_json::parse(text);
}

std::string jsonText(const nlohmann::json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string jsonText(const nlohmann::ordered_json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace reflet
