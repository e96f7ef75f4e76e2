// JSON files, read strictly: every complaint names the file and the place in it.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// Throws Error: a file that cannot be read, malformed JSON ("FILE:LINE:COLUMN: ..."), a key that is given twice in
/// one object.
nlohmann::json parseJsonFile(const std::filesystem::path& path);

/// A value of a JSON file together with where it stands. Refers to the file's root value, which must outlive it.
class JsonNode {
public:
    /// The root of what parseJsonFile read.
    JsonNode(const nlohmann::json& root, const std::filesystem::path& file) : JsonNode(&root, file.string(), "") {}

    [[nodiscard]] const nlohmann::json& json() const { return *value_; }
    /// Keys from the root, such as "camera.position[1]"; empty at the root.
    [[nodiscard]] const std::string& path() const { return path_; }

    /// Throws Error "FILE: PATH: what".
    [[noreturn]] void complain(std::string_view what) const;
    /// Throws Error "FILE: PATH: must be what, is VALUE".
    [[noreturn]] void complainMustBe(std::string_view what) const;

    /// Complains unless this is an object with no other keys than these; names the nearest.
    void requireKeys(std::span<const std::string> known) const;
    /// The value of a key of this object, if it is there.
    [[nodiscard]] std::optional<JsonNode> find(const std::string& key) const;
    /// An element of this array; index < json().size().
    [[nodiscard]] JsonNode at(size_t index) const;

    /// This number. Complains if it is none or outside min..max; `unit` is for the message.
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
