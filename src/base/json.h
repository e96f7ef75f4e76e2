// Strict reading of JSON files: every error names the file and the position in it.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// Throws Error: an unreadable file, one that exceeds JsonLimits (base/json_text.h), malformed JSON ("FILE:LINE:COLUMN:
/// ..."), a duplicate key in an object.
nlohmann::json parseJsonFile(const std::filesystem::path& path);

/// A value of a JSON file with its path. Refers to the root value, which must outlive it.
class JsonNode {
public:
    /// The root value from parseJsonFile.
    JsonNode(const nlohmann::json& root, const std::filesystem::path& file) : JsonNode(&root, file.string(), "") {}

    [[nodiscard]] const nlohmann::json& json() const { return *value_; }
    /// Keys from the root, such as "camera.position[1]"; empty at the root.
    [[nodiscard]] const std::string& path() const { return path_; }

    /// Throws Error "FILE: PATH: what".
    [[noreturn]] void complain(std::string_view what) const;
    /// Throws Error "FILE: PATH: must be what, is VALUE".
    [[noreturn]] void complainMustBe(std::string_view what) const;

    /// Throws Error unless this is an object that has only these keys; suggests the nearest.
    void requireKeys(std::span<const std::string> known) const;
    /// The value of a key of this object, if present.
    [[nodiscard]] std::optional<JsonNode> find(const std::string& key) const;
    /// An element of this array; index < json().size().
    [[nodiscard]] JsonNode at(size_t index) const;

    /// This number. Throws Error if it is no number or outside min..max; `unit` is for the message.
    [[nodiscard]] double number(double min, double max, std::string_view unit = "") const;
    /// This array of exactly `count` numbers.
    [[nodiscard]] std::vector<double> numbers(size_t count, double min, double max, std::string_view unit = "") const;

private:
    JsonNode(const nlohmann::json* value, std::string file, std::string path)
        : value_(value), file_(std::move(file)), path_(std::move(path)) {}

    const nlohmann::json* value_;
    std::string file_;
    std::string path_;
};

}  // namespace reflet
