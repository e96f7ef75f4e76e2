// A minimal, strict parser for Reflet's own HTML: attributes in double quotation marks, every element closed.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::test {

struct Element {
    std::string name;
    std::map<std::string, std::string> attributes;  ///< values without entities decoded
    std::string text;                               ///< between the tag and the next one

    [[nodiscard]] bool has(const std::string& attribute) const { return attributes.contains(attribute); }
    /// "" if there is none.
    [[nodiscard]] std::string value(const std::string& attribute) const {
        return has(attribute) ? attributes.at(attribute) : "";
    }
};

struct Html {
    std::vector<Element> elements;      ///< in the order of their opening tags
    std::vector<std::string> mistakes;  ///< closing tags that do not match, elements left open, broken tags

    [[nodiscard]] std::vector<Element> named(std::string_view name) const;
};

Html parseHtml(std::string_view text);

}  // namespace reflet::test
