// Suggests the name that a mistyped one was meant to be: optimal string alignment distance.
#include "base/text.h"

#include "base/ascii.h"
#include "base/error.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace reflet {
namespace {

// Lower case, without underscores: "maxSteps" is "max_steps".
std::string lettersOf(std::string_view text) {
    std::string result;
    for (const char letter : text) {
        if (letter != '_') {
            result += asciiLower(letter);
        }
    }
    return result;
}

/// Number of insertions, deletions, replacements and swaps of neighbouring letters that turn a into b.
size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<size_t> beforeLast(b.size() + 1);
    std::vector<size_t> last(b.size() + 1);
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        beforeLast.swap(last);
        last.swap(row);
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
            }
        }
    }
    return row[b.size()];
}

/// "pos" for "position", "steps" for "trace_screen.max_steps".
bool onePartOfOther(std::string_view a, std::string_view b) {
    const auto [shorter, longer] = a.size() < b.size() ? std::pair(a, b) : std::pair(b, a);
    return shorter.size() >= 3 && longer.find(shorter) != std::string_view::npos;
}

}  // namespace

std::optional<std::string> nearestName(std::string_view name, std::span<const std::string> names) {
    constexpr size_t longest = 100;  // comparing takes time for each pair of letters, and no known name is as long
    if (name.size() > longest) {
        return std::nullopt;
    }
    const std::string wanted = lettersOf(name);
    std::optional<std::string> nearest;
    size_t nearestDistance = std::numeric_limits<size_t>::max();
    for (const std::string& candidate : names) {
        const std::string known = lettersOf(candidate);
        const size_t distance = editDistance(wanted, known);
        const bool near = 2 * distance < std::max(wanted.size(), known.size()) || onePartOfOther(wanted, known);
        if (near && distance < nearestDistance) {
            nearest = candidate;
            nearestDistance = distance;
        }
    }
    return nearest;
}

std::string suggestion(std::string_view name, std::span<const std::string> names) {
    const std::optional<std::string> nearest = nearestName(name, names);
    return nearest ? fmt::format("; did you mean '{}'?", *nearest) : "";
}

std::string snakeCase(std::string_view camelCase) {
    std::string result;
    for (const char letter : camelCase) {
        if (isAsciiUpper(letter)) {
            result += '_';
        }
        result += asciiLower(letter);
    }
    return result;
}

}  // namespace reflet
