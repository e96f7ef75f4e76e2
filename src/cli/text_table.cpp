// Tables for a terminal.
#include "cli/text_table.h"

#include <algorithm>
#include <numeric>

namespace reflet {

namespace {

struct Table {
    std::vector<std::vector<std::string>> rows;  ///< of equal length; the first is the head
    std::vector<bool> toTheRight;                ///< a column's numbers end in line
};

size_t characters(std::string_view text) {
    return static_cast<size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string trimmed(const std::string& text) {
    const size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::string plain(std::string_view text) {
    std::string result;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size()) {
            result += text[++i];
        } else if (text[i] != '`') {
            result += text[i];
        }
    }
    return result;
}

std::vector<std::string> cellsOf(std::string_view line) {
    std::vector<std::string> cells;
    std::string cell;
    for (size_t i = 1; i < line.size(); ++i) {
        if (line[i] == '\\' && i + 1 < line.size()) {
            cell += line[i];
            cell += line[++i];
        } else if (line[i] == '|') {
            cells.push_back(trimmed(plain(cell)));
            cell.clear();
        } else {
            cell += line[i];
        }
    }
    return cells;
}

Table tableOf(const std::vector<std::string_view>& lines) {
    Table table;
    size_t columns = 0;
    for (size_t i = 0; i < lines.size(); ++i) {
        const std::vector<std::string> cells = cellsOf(lines[i]);
        if (i == 1) {
            std::ranges::transform(cells, std::back_inserter(table.toTheRight),
                                   [](const std::string& rule) { return rule.ends_with(':'); });
        } else {
            table.rows.push_back(cells);
        }
        columns = std::max(columns, cells.size());
    }
    for (auto& row : table.rows) {
        row.resize(columns);
    }
    table.toTheRight.resize(columns);
    return table;
}

std::vector<size_t> widthsOf(const Table& table) {
    std::vector<size_t> widths(table.rows.front().size());
    for (const auto& row : table.rows) {
        for (size_t i = 0; i < row.size(); ++i) {
            widths[i] = std::max(widths[i], characters(row[i]));
        }
    }
    return widths;
}

constexpr size_t gap = 2;

size_t widthOf(const Table& table) {
    const std::vector<size_t> widths = widthsOf(table);
    return std::accumulate(widths.begin(), widths.end(), gap * (widths.size() - 1));
}

Table turned(const Table& table) {
    Table result;
    for (size_t column = 0; column < table.rows.front().size(); ++column) {
        std::vector<std::string>& row = result.rows.emplace_back();
        std::ranges::transform(table.rows, std::back_inserter(row), [&](const auto& r) { return r[column]; });
    }
    result.toTheRight.assign(table.rows.size(), true);
    result.toTheRight.front() = false;
    return result;
}

std::string lineOf(const std::vector<std::string>& row, const Table& table, const std::vector<size_t>& widths) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) {
        const std::string space(widths[i] - characters(row[i]), ' ');
        line += table.toTheRight[i] ? space + row[i] : row[i] + space;
        line += i + 1 < row.size() ? std::string(gap, ' ') : "";
    }
    return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

std::string textOf(const Table& whole, size_t width) {
    const Table other = turned(whole);
    const Table& table = widthOf(whole) > width && widthOf(other) < widthOf(whole) ? other : whole;
    const std::vector<size_t> widths = widthsOf(table);
    std::string text;
    for (size_t i = 0; i < table.rows.size(); ++i) {
        text += lineOf(table.rows[i], table, widths);
        if (i == 0) {
            text += std::string(widthOf(table), '-') + "\n";
        }
    }
    return text;
}

std::vector<std::string_view> linesOf(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

}  // namespace

std::vector<std::string> wrapped(std::string_view text, size_t width) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        if (!lines.empty() && characters(lines.back()) + 1 + characters(word) <= width) {
            lines.back() += ' ';
            lines.back() += word;
        } else {
            lines.emplace_back(word);
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::string firstWordsOf(std::string_view text, size_t width) {
    if (characters(text) <= width) {
        return std::string(text);
    }
    const std::vector<std::string> lines = wrapped(text, width - std::min<size_t>(width, 4));
    return lines.empty() ? "" : lines.front() + " ...";
}

std::string alignedTables(std::string_view markdown, size_t width) {
    std::string text;
    std::vector<std::string_view> table;
    const auto endTable = [&] {
        if (!table.empty()) {
            text += textOf(tableOf(table), width);
            table.clear();
        }
    };
    for (const std::string_view line : linesOf(markdown)) {
        if (line.starts_with('|')) {
            table.push_back(line);
            continue;
        }
        endTable();
        const size_t words = line.find_first_not_of("# ");
        text += plain(line.starts_with('#') && words != std::string_view::npos ? line.substr(words) : line) + "\n";
    }
    endTable();
    return text;
}

}  // namespace reflet
