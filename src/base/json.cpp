// Strict reading of JSON files, with nlohmann-json.
#include "base/json.h"

#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/message.h"
#include "base/text.h"

#include <algorithm>
#include <functional>
#include <set>

namespace reflet {
namespace {

using nlohmann::json;

/// nlohmann-json silently keeps the last of duplicate keys. This parser callback throws instead.
class DuplicateKeys {
public:
    explicit DuplicateKeys(std::string file) : file_(std::move(file)) {}

    bool operator()(int /*depth*/, json::parse_event_t event, json& parsed) {
        if (event == json::parse_event_t::object_start) {
            objects_.emplace_back();
        } else if (event == json::parse_event_t::object_end) {
            objects_.pop_back();
        } else if (event == json::parse_event_t::key) {
            auto& [keys, current] = objects_.back();
            current = parsed.get<std::string>();
            if (!keys.insert(current).second) {
                fail("{}: {}: duplicate key", file_, oneLine(currentPath()));
            }
        }
        return true;
    }

private:
    struct Object {
        std::set<std::string> keys;
        std::string current;
    };

    [[nodiscard]] std::string currentPath() const {
        std::string path;
        for (const Object& object : objects_) {
            path += (path.empty() ? "" : ".") + object.current;
        }
        return path;
    }

    std::string file_;
    std::vector<Object> objects_;  ///< open objects, outermost first
};

/// "LINE:COLUMN" of a byte, counted from 1 like nlohmann-json does.
std::string lineAndColumn(std::string_view text, size_t byte) {
    const std::string_view before = text.substr(0, byte == 0 ? 0 : byte - 1);
    const size_t lineStart = before.rfind('\n') + 1;  // npos + 1 is 0
    return fmt::format("{}:{}", std::ranges::count(before, '\n') + 1, before.size() - lineStart + 1);
}

/// Without nlohmann's "[json.exception.parse_error.101] parse error at line 1, column 2: ".
std::string jsonReason(const json::exception& error) {
    std::string text = error.what();
    if (text.starts_with('[')) {
        text.erase(0, text.find("] ") + 2);
    }
    if (text.starts_with("parse error")) {
        text.erase(0, text.find(": ") + 2);
    }
    return oneLine(text, 300);  // it quotes the token that it stopped at
}

/// The JSON text of a value, if it is short.
std::string shown(const json& value) {
    std::string text = jsonText(value);
    if (text.size() <= 60) {
        return text;
    }
    return value.is_object() ? "an object" : value.is_array() ? "a long array" : "a long text";
}

}  // namespace

json parseJsonFile(const std::filesystem::path& path) {
    const JsonLimits limits;
    const std::string text = readFile(path, limits.bytes);
    if (const std::string excess = jsonExcess(text, limits); !excess.empty()) {
        fail("{}: {}", path.string(), excess);
    }
    try {
        // By reference: the parser copies its callback.
        DuplicateKeys duplicateKeys(path.string());
        return json::parse(text, std::ref(duplicateKeys));
    } catch (const json::exception& error) {
        fail("{}:{}: {}", path.string(), lineAndColumn(text, jsonErrorByte(error, text)), jsonReason(error));
    }
}

void JsonNode::complain(std::string_view what) const {
    fail("{}: {}{}{}", file_, oneLine(path_), path_.empty() ? "" : ": ", what);
}

void JsonNode::complainMustBe(std::string_view what) const {
    complain(fmt::format("must be {}, is {}", what, shown(*value_)));
}

void JsonNode::requireKeys(std::span<const std::string> known) const {
    if (!value_->is_object()) {
        complainMustBe("an object");
    }
    for (const auto& [key, value] : value_->items()) {
        if (std::ranges::find(known, key) == known.end()) {
            const std::string nearest = suggestion(key, known);
            find(key)->complain("unknown key" +
                                (nearest.empty() ? fmt::format("; there are {}", fmt::join(known, ", ")) : nearest));
        }
    }
}

std::optional<JsonNode> JsonNode::find(const std::string& key) const {
    const auto found = value_->find(key);
    if (found == value_->end()) {
        return std::nullopt;
    }
    return JsonNode(&*found, file_, path_.empty() ? key : path_ + "." + key);
}

JsonNode JsonNode::at(size_t index) const {
    return {&value_->at(index), file_, fmt::format("{}[{}]", path_, index)};
}

double JsonNode::number(double min, double max, std::string_view unit) const {
    if (!value_->is_number()) {
        complainMustBe("a number");
    }
    const auto result = value_->get<double>();
    if (!(result >= min && result <= max)) {  // NaN fails too
        complainMustBe(fmt::format("between {:g} and {:g}{}{}", min, max, unit.empty() ? "" : " ", unit));
    }
    return result;
}

std::vector<double> JsonNode::numbers(size_t count, double min, double max, std::string_view unit) const {
    if (!value_->is_array() || value_->size() != count || !std::ranges::all_of(*value_, &json::is_number)) {
        complainMustBe(fmt::format("{} numbers", count));
    }
    std::vector<double> result;
    for (size_t i = 0; i < count; ++i) {
        result.push_back(at(i).number(min, max, unit));
    }
    return result;
}

}  // namespace reflet
