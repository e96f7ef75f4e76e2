// Documents of headings, paragraphs and tables, and two forms of them: Markdown and plain text for a terminal.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// A part of a text, in one style. Plain text drops the styles.
struct Phrase {
    enum class Style : uint8_t { plain, code, emphasis };

    Phrase() = default;
    Phrase(std::string text_, Style style_ = Style::plain) : text(std::move(text_)), style(style_) {}
    Phrase(const char* text_) : text(text_) {}

    std::string text;
    Style style = Style::plain;
};

inline Phrase asCode(std::string text) {
    return {std::move(text), Phrase::Style::code};
}

struct TextTable {
    struct Column {
        std::string name;       ///< written as it is, not escaped
        bool isNumber = false;  ///< its values are aligned to the right
    };
    using Row = std::vector<Phrase>;  ///< a cell for each column

    std::vector<Column> columns;
    std::vector<Row> rows;
};

/// Any of its parts may be empty.
struct Section {
    std::string heading;
    std::vector<Phrase> text;
    std::optional<TextTable> table;
};

/// Escapes what Markdown would take for markup; a new line becomes a space.
std::string escapeMarkdown(std::string_view text);

std::string markdownOf(const TextTable& table);
/// Headings are of the third level.
std::string markdownOf(const std::vector<Section>& document);

/// Columns are aligned by spaces. A table wider than `width` characters is turned: a line for each column, where that
/// is narrower.
std::string plainTextOf(const TextTable& table, size_t width);
std::string plainTextOf(const std::vector<Section>& document, size_t width);

}  // namespace reflet
