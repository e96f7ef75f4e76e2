// Texts of errors.
#include "base/error.h"

#include "base/visible_text.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace reflet {

namespace {

/// What a format has at one place: "{}", "{:g}", or "{2}".
struct Field {
    size_t end = 0;       ///< after its brace
    std::string_view id;  ///< "" or a number
    std::string_view spec;
};

Field fieldAt(std::string_view format, size_t open) {
    const size_t close = format.find('}', open);
    const std::string_view inside = format.substr(open + 1, close - open - 1);
    const size_t colon = std::min(inside.find(':'), inside.size());
    return {close + 1, inside.substr(0, colon), inside.substr(colon)};
}

std::optional<std::string_view> textOf(const fmt::format_args::format_arg& arg) {
    return fmt::visit_format_arg(
        [](const auto& value) -> std::optional<std::string_view> {
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, fmt::string_view>) {
                return std::string_view(value.data(), value.size());
            } else if constexpr (std::is_same_v<Value, const char*>) {
                return value;
            } else {
                return std::nullopt;
            }
        },
        arg);
}

// visibleText. No name of a file is longer than 255 bytes: longer words are no path that exists, and are cut.
std::string shownText(std::string_view text) {
    constexpr size_t longestName = 255;
    const std::string visible = visibleText(text);
    const std::string_view all = visible;
    std::string result;
    for (size_t at = 0; at < all.size();) {
        const size_t end = std::min(all.find_first_of(" /", at), all.size());
        const std::string_view word = all.substr(at, end - at);
        result += word.size() > longestName ? oneLine(word) : std::string(word);
        result += all.substr(end, 1);
        at = end + 1;
    }
    return result;
}

}  // namespace

std::string formatMessage(fmt::string_view format, fmt::format_args args) {
    const std::string_view text(format.data(), format.size());
    std::string result;
    int next = 0;
    for (size_t i = 0; i < text.size();) {
        if ((text[i] == '{' || text[i] == '}') && text.substr(i + 1, 1) == text.substr(i, 1)) {
            result += text[i];
            i += 2;
        } else if (text[i] == '{') {
            const Field field = fieldAt(text, i);
            int index = next;
            if (field.id.empty()) {
                ++next;
            } else {
                std::from_chars(field.id.data(), field.id.data() + field.id.size(), index);
            }
            const std::optional<std::string_view> value = textOf(args.get(index));
            const bool quoted = i > 0 && text[i - 1] == '\'' && text.substr(field.end, 1) == "'";
            if (value && field.spec.empty()) {
                result += quoted ? oneLine(*value) : shownText(*value);
            } else {
                result += fmt::vformat("{" + std::to_string(index) + std::string(field.spec) + "}", args);
            }
            i = field.end;
        } else {
            result += text[i++];
        }
    }
    return result;
}

void checkFailed(const char* condition, const char* file, int line, const std::string& detail) {
    throw std::logic_error(fmt::format("internal error at {}:{}: {} does not hold: {}", file, line, condition, detail));
}

}  // namespace reflet
