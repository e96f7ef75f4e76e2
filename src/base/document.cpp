// Writes documents.
#include "base/document.h"

#include "base/visible_text.h"
#include "base/wrap.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace reflet {

namespace {

std::string flat(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return visibleText(text);
}

// In code a backslash escapes nothing but a bar in a table, and no backquote.
std::string codeInMarkdown(const std::string& text) {
    if (text.find('`') != std::string::npos) {
        return escapeMarkdown(text);
    }
    std::string result = "`";
    for (const char c : flat(text)) {
        result += c == '|' ? "\\|" : std::string(1, c);
    }
    return result + "`";
}

std::string markdownOf(const Phrase& words) {
    switch (words.style) {
        case Phrase::Style::code:
            return codeInMarkdown(words.text);
        case Phrase::Style::emphasis:
            return "*" + escapeMarkdown(words.text) + "*";
        default:
            return escapeMarkdown(words.text);
    }
}

// The lines of a table in plain text.
struct Grid {
    std::vector<std::vector<std::string>> rows;  // of equal length; the first is the head
    std::vector<bool> toTheRight;
};

Grid gridOf(const TextTable& table) {
    Grid grid;
    std::vector<std::string>& head = grid.rows.emplace_back();
    for (const TextTable::Column& column : table.columns) {
        head.push_back(column.name);
        grid.toTheRight.push_back(column.isNumber);
    }
    for (const TextTable::Row& cells : table.rows) {
        std::ranges::transform(cells, std::back_inserter(grid.rows.emplace_back()),
                               [](const Phrase& words) { return flat(words.text); });
    }
    return grid;
}

std::vector<size_t> widthsOf(const Grid& grid) {
    std::vector<size_t> widths(grid.rows.front().size());
    for (const auto& row : grid.rows) {
        for (size_t i = 0; i < row.size(); ++i) {
            widths[i] = std::max(widths[i], characters(row[i]));
        }
    }
    return widths;
}

constexpr size_t gap = 2;

size_t widthOf(const Grid& grid) {
    const std::vector<size_t> widths = widthsOf(grid);
    return std::accumulate(widths.begin(), widths.end(), gap * (widths.size() - 1));
}

Grid turned(const Grid& grid) {
    Grid result;
    for (size_t column = 0; column < grid.rows.front().size(); ++column) {
        std::vector<std::string>& row = result.rows.emplace_back();
        std::ranges::transform(grid.rows, std::back_inserter(row), [&](const auto& r) { return r[column]; });
    }
    result.toTheRight.assign(grid.rows.size(), true);
    result.toTheRight.front() = false;
    return result;
}

std::string lineOf(const std::vector<std::string>& row, const Grid& grid, const std::vector<size_t>& widths) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) {
        const std::string space(widths[i] - characters(row[i]), ' ');
        line += grid.toTheRight[i] ? space + row[i] : row[i] + space;
        line += i + 1 < row.size() ? std::string(gap, ' ') : "";
    }
    return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

// What the two forms of a document differ in.
struct Writer {
    std::string_view beforeHeading;
    std::function<std::string(const Phrase&)> words;
    std::function<std::string(const TextTable&)> table;
};

std::string written(const std::vector<Section>& document, const Writer& writer) {
    std::string text;
    for (const Section& section : document) {
        text += &section == document.data() ? "" : "\n";
        if (!section.heading.empty()) {
            text += std::string(writer.beforeHeading) + writer.words(section.heading) + "\n";
        }
        if (!section.text.empty()) {
            text += section.heading.empty() ? "" : "\n";
            for (const Phrase& words : section.text) {
                text += writer.words(words);
            }
            text += "\n";
        }
        if (section.table) {
            text += section.heading.empty() && section.text.empty() ? "" : "\n";
            text += writer.table(*section.table);
        }
    }
    return text;
}

}  // namespace

std::string escapeMarkdown(std::string_view text) {
    std::string result;
    for (const char c : flat(std::string(text))) {
        if (std::string_view("\\`*_[]<>|#").find(c) != std::string_view::npos) {
            result += '\\';
        }
        result += c;
    }
    return result;
}

std::string markdownOf(const TextTable& table) {
    std::string text = "|";
    std::string rule = "|";
    for (const TextTable::Column& column : table.columns) {
        text += " " + column.name + " |";
        rule += column.isNumber ? "--:|" : "---|";
    }
    text += "\n" + rule + "\n";
    for (const TextTable::Row& row : table.rows) {
        text += "|";
        for (const Phrase& cell : row) {
            text += cell.text.empty() ? " |" : " " + markdownOf(cell) + " |";
        }
        text += "\n";
    }
    return text;
}

std::string markdownOf(const std::vector<Section>& document) {
    return written(document, {"### ", [](const Phrase& words) { return markdownOf(words); },
                              [](const TextTable& table) { return markdownOf(table); }});
}

std::string plainTextOf(const TextTable& table, size_t width) {
    const Grid whole = gridOf(table);
    const Grid other = turned(whole);
    const Grid& grid = widthOf(whole) > width && widthOf(other) < widthOf(whole) ? other : whole;
    const std::vector<size_t> widths = widthsOf(grid);
    std::string text;
    for (size_t i = 0; i < grid.rows.size(); ++i) {
        text += lineOf(grid.rows[i], grid, widths);
        if (i == 0) {
            text += std::string(widthOf(grid), '-') + "\n";
        }
    }
    return text;
}

std::string plainTextOf(const std::vector<Section>& document, size_t width) {
    return written(document, {"", [](const Phrase& words) { return words.text; },
                              [&](const TextTable& table) { return plainTextOf(table, width); }});
}

}  // namespace reflet
