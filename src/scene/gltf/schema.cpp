// Checks a glTF document against the part of the specification that the loader reads, driven by tables with one row per
// property, after the JSON schemas of the Khronos glTF 2.0 specification, 2021.
#include "scene/gltf/schema.h"

#include "base/json_text.h"
#include "scene/gltf/schema_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace reflet {

namespace {

using gltf_schema::Field;
using gltf_schema::Type;
using nlohmann::json;

constexpr double maxInteger = 9007199254740992.0;  // 2^53: all integers up to here are exact in a double
constexpr size_t maxObjects = size_t(1) << 21U;    // `{}` is two bytes, but a tinygltf object takes up to 2 KiB

/// Location of a value in the document: a linked list to the root, so that paths cost nothing until they are printed.
struct Place {
    const Place* parent = nullptr;
    std::string_view name{};
    size_t index = 0;  ///< if name is empty

    [[nodiscard]] std::string path() const {
        const std::string before = parent != nullptr ? parent->path() : "";
        if (name.empty()) {
            return fmt::format("{}[{}]", before, index);
        }
        return before.empty() ? std::string(name) : fmt::format("{}.{}", before, name);
    }
};

class Checker {
public:
    Checker(const json& document, GltfReport& report) : report_(report) {
        for (const auto& [name, value] : document.items()) {
            if (value.is_array()) {
                sizes_[name] = value.size();
            }
        }
        countOf(document, "lights", "/extensions/KHR_lights_punctual/lights");
        countOf(document, "variants", "/extensions/KHR_materials_variants/variants");
    }

    json object(json& value, std::span<const Field> fields, const Place* place) {
        if (!value.is_object()) {
            fail(place, "is {}, not an object", kindOf(value));
        }
        if (++objects_ > maxObjects) {
            report_.refuse(pathOf(place), "exceeds the limit of {} objects", maxObjects);
        }
        json result = json::object();
        for (const Field& field : fields) {
            const auto found = value.find(field.name);
            const Place inner{.parent = place, .name = field.name};
            if (found != value.end() && field.anyType && !found->is_object()) {
                continue;
            }
            if (found == value.end() && field.required) {
                fail(&inner, "is missing");
            }
            if (found != value.end() && !addProperty(result, *found, field, inner) && place == nullptr) {
                sizes_.erase(field.name);
            }
        }
        requireVariant(result, fields, place);
        return result;
    }

private:
    /// Of an array that an extension adds.
    void countOf(const json& document, const char* name, const char* path) {
        const json::json_pointer pointer(path);
        if (document.contains(pointer) && document[pointer].is_array()) {
            sizes_[name] = document[pointer].size();
        }
    }

    template <class... Args>
    [[noreturn]] void fail(const Place* place, fmt::format_string<Args...> format, Args&&... args) const {
        report_.fail(pathOf(place), format, std::forward<Args>(args)...);
    }

    static std::string pathOf(const Place* place) { return place != nullptr ? place->path() : "JSON"; }

    static std::string kindOf(const json& value) {
        const std::string type = value.type_name();
        return (type == "object" || type == "array" ? "an " : type == "null" ? "" : "a ") + type;
    }

    /// False if the value is invalid, and is left out.
    bool addProperty(json& object, json& value, const Field& field, const Place& place) {
        const auto add = [&] {
            json checked = property(value, field, place);
            object[field.name] = std::move(checked);
        };
        if (field.required || field.vital) {
            add();
            return true;
        }
        const bool ofElements = field.standIn != nullptr || field.without == nullptr;
        return report_.tolerate(ofElements ? "its default will be used" : field.without, add);
    }

    /// A camera and a spot light must have an object that is named like their type.
    void requireVariant(const json& object, std::span<const Field> fields, const Place* place) const {
        const auto type = object.find("type");
        for (const Field& field : fields) {
            const Place inner{.parent = place, .name = field.name};
            if (type != object.end() && *type == field.name && !object.contains(field.name)) {
                fail(&inner, "is missing");
            }
        }
    }

    /// False if the element is invalid, and is replaced or left out.
    bool addElement(json& array, json& value, const Field& field, const Place& place) {
        const auto add = [&] { array.push_back(single(value, field, place)); };
        if (field.standIn == nullptr) {
            add();
            return true;
        }
        return field.without != nullptr ? report_.tolerate(field.without, add)
                                        : report_.tolerateUntilUsed(field.name, place.index, add);
    }

    json property(json& value, const Field& field, const Place& place) {
        if (!field.array) {
            return single(value, field, place);
        }
        if (!value.is_array()) {
            fail(&place, "is {}, not an array", kindOf(value));
        }
        if (field.items != 0 && value.size() != field.items) {
            fail(&place, "has {} elements, not {}", value.size(), field.items);
        }
        json result = json::array();
        for (size_t i = 0; i < value.size(); ++i) {
            const bool isValid = addElement(result, value[i], field, {.parent = &place, .index = i});
            value[i] = nullptr;  // frees it: the document is in memory once
            if (!isValid && *field.standIn != '\0') {
                result.push_back(parseJson(field.standIn));
            }
        }
        return result;
    }

    json single(json& value, const Field& field, const Place& place) {
        switch (field.type) {
            case Type::boolean:
                if (!value.is_boolean()) {
                    fail(&place, "is {}, not true or false", kindOf(value));
                }
                return value;
            case Type::text:
                return text(value, field, place);
            case Type::number:
                return number(value, field, place);
            case Type::integer:
                return integer(value, field, place);
            case Type::index:
                return index(value, field.refersTo, place);
            case Type::indexMap:
                return indexMap(value, field, place);
            case Type::object:
                return object(value, field.fields, &place);
        }
        fail(&place, "has an unknown type");
    }

    [[nodiscard]] json text(const json& value, const Field& field, const Place& place) const {
        if (!value.is_string()) {
            fail(&place, "is {}, not a string", kindOf(value));
        }
        const auto& string = value.get_ref<const std::string&>();
        if (!field.words.empty() && std::find(field.words.begin(), field.words.end(), string) == field.words.end()) {
            fail(&place, "is \"{}\", not one of {}", string.substr(0, 40), fmt::join(field.words, " "));
        }
        return value;
    }

    [[nodiscard]] json number(const json& value, const Field& field, const Place& place) {
        if (!value.is_number()) {
            fail(&place, "is {}, not a number", kindOf(value));
        }
        const auto number = value.get<double>();
        if (number >= field.min && number <= field.max) {
            return value;
        }
        const double nearest = std::clamp(number, field.min, field.max);
        const auto check = [&] { fail(&place, "is {}, not between {} and {}", number, field.min, field.max); };
        if (!field.clamps || std::abs(nearest) == std::numeric_limits<float>::max()) {
            check();
        }
        report_.tolerate(fmt::format("{} will be used", nearest), check);
        return nearest;
    }

    [[nodiscard]] json integer(const json& value, const Field& field, const Place& place) const {
        if (!value.is_number()) {
            fail(&place, "is {}, not an integer", kindOf(value));
        }
        const auto number = value.get<double>();
        if (number != std::floor(number)) {
            fail(&place, "is {}, not an integer", number);
        }
        const double min = std::max(field.min, 0.0);
        const double max = std::min(field.max, maxInteger);
        if (!(number >= min && number <= max)) {
            fail(&place, "is {}, not between {} and {}", number, min, max);
        }
        const auto result = static_cast<uint64_t>(number);  // converts 3.0 and 3e0, too, which tinygltf ignores
        if (result % field.multipleOf != 0) {
            fail(&place, "is {}, not a multiple of {}", result, field.multipleOf);
        }
        if (!field.numbers.empty() &&
            std::find(field.numbers.begin(), field.numbers.end(), result) == field.numbers.end()) {
            fail(&place, "is {}, not one of {}", result, fmt::join(field.numbers, " "));
        }
        return result;
    }

    [[nodiscard]] json index(const json& value, const char* refersTo, const Place& place) {
        json result = integer(value, {.name = "", .type = Type::index}, place);
        const auto size = sizes_.find(refersTo);
        const size_t count = size != sizes_.end() ? size->second : 0;
        if (result.get<uint64_t>() >= count) {
            fail(&place, "is {}, but there are {} {}", result.get<uint64_t>(), count, refersTo);
        }
        report_.use(refersTo, result.get<uint64_t>());
        return result;
    }

    json indexMap(const json& value, const Field& field, const Place& place) {
        if (!value.is_object()) {
            fail(&place, "is {}, not an object", kindOf(value));
        }
        json result = json::object();
        for (const auto& entry : value.items()) {
            const std::string& name = entry.key();  // not structured bindings, which Clang 14 cannot capture
            const json& item = entry.value();
            if (!gltf_schema::knownAttribute(name)) {
                continue;
            }
            const Place inner{.parent = &place, .name = std::string_view(name)};
            const auto add = [&] {
                result[name] = field.refersTo != nullptr ? index(item, field.refersTo, inner)
                                                         : integer(item, {.name = "", .max = 4294967295.0}, inner);
            };
            if (field.without == nullptr || field.array || name == "POSITION") {
                add();
            } else {
                report_.tolerate(field.without, add);
            }
        }
        return result;
    }

    GltfReport& report_;
    std::map<std::string, size_t, std::less<>> sizes_;
    size_t objects_ = 0;
};

}  // namespace

bool knownGltfExtension(const std::string& name) {
    const auto& known = gltf_schema::knownExtensions;
    return std::find(known.begin(), known.end(), name) != known.end();
}

const json& arrayIn(const json& object, const char* name) {
    static const json none = json::array();
    const auto found = object.find(name);
    return found != object.end() ? *found : none;
}

json checkedGltfDocument(json document, GltfReport& report) {
    return Checker(document, report).object(document, gltf_schema::document(), nullptr);
}

}  // namespace reflet
