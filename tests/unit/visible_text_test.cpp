// Text from outside as it is shown, and every place that shows it.
#include "base/visible_text.h"
#include "base/document.h"
#include "base/error.h"
#include "base/json_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace reflet::visible_text_test {
namespace {

// C1 controls CSI and OSC, an override of direction, a line separator, a byte order mark, an escape, a line break, a
// broken byte and a character cut short.
constexpr std::array<std::string_view, 9> hidden{"\xC2\x9B", "\xC2\x9D", "\xE2\x80\xAE", "\xE2\x80\xA8", "\xEF\xBB\xBF",
                                                 "\x1B",     "\n",       "\x9B",         "\xE2\x80"};

TEST(VisibleText, ShowsHiddenCharactersAsEscapesAndLettersAsTheyAre) {
    const std::string letters =
        "Stra\xC3\x9F"
        "e \xE6\xB0\xB4 \xF0\x9F\x92\xA1 \\n 'a'";
    EXPECT_EQ(visibleText(letters), letters);
    EXPECT_EQ(visibleText("a\xC2\x9B"
                          "31m\xE2\x80\xAE\x1B\n\xFF"),
              "a\\x9b31m\\u202e\\x1b\\n\\xff");
    EXPECT_EQ(visibleText("\xF3\xA0\x81\x81"), "\\U000e0041");      // a tag, which no font shows
    EXPECT_EQ(visibleText("\xC0\x80\xED\xA0\x80\xF4\x90\x80\x80"),  // overlong, a surrogate, beyond Unicode
              "\\xc0\\x80\\xed\\xa0\\x80\\xf4\\x90\\x80\\x80");
    for (const std::string_view text : hidden) {
        const std::string once = visibleText(text);
        EXPECT_EQ(once[0], '\\');
        EXPECT_EQ(visibleText(once), once);
    }
}

TEST(VisibleText, IsCutBetweenCharacters) {
    EXPECT_EQ(oneLine("\xC3\xA4\xC3\xA4", 3), "\xC3\xA4...");
    EXPECT_EQ(oneLine("a\nb", 2), "a...");
    EXPECT_EQ(oneLine("ab", 2), "ab");
}

TEST(VisibleText, OfMessagesIsQuotedAndTheRestWhole) {
    const std::string longName = std::string(100, 'n') + "\x9B";
    const char* text = "c\n";
    EXPECT_EQ(messageText("{}: '{}' {{{:>4}}} {} '{}'", longName, longName, 7, text, 2.5),
              std::string(100, 'n') + "\\x9b: '" + std::string(80, 'n') + "...' {   7} c\\n '2.5'");
    EXPECT_EQ(messageText("{1} {0}", "a", "b"), "b a");
    const std::string path = "/a b/" + std::string(255, 'c') + "/";
    EXPECT_EQ(messageText("{}: no", path), path + ": no");
    EXPECT_EQ(messageText("{}: no", path + std::string(256, 'd') + "/e"), path + std::string(80, 'd') + ".../e: no");
}

TEST(VisibleText, IsWhatDocumentsHave) {
    for (const std::string_view text : hidden) {
        const std::string name = "a" + std::string(text) + "|`b";
        const TextTable table{{{"name", false}}, {{Phrase(name), Phrase(name, Phrase::Style::code)}}};
        const std::array<std::string, 3> all{markdownOf(table), escapeMarkdown(name), jsonText(nlohmann::json(name))};
        for (const std::string& shown : all) {
            for (std::string_view rest = shown; !rest.empty();) {
                const Character first = firstCharacter(rest);
                ASSERT_GT(first.length, 0U) << shown;
                EXPECT_TRUE(first.code == '\n' || !isHidden(first.code)) << shown;
                rest.remove_prefix(first.length);
            }
        }
        EXPECT_EQ(std::ranges::count(all[0], '\n'), 3) << all[0];  // head, rule, row
        EXPECT_EQ(std::ranges::count(all[1], '\n'), 0);
    }
    const std::string tag = "\xC2\x9B\xF3\xA0\x81\x81";
    EXPECT_EQ(jsonText(nlohmann::json(tag)), "\"\\u009b\\udb40\\udc41\"");
    EXPECT_EQ(parseJson(jsonText(nlohmann::json(tag))), tag);
}

}  // namespace
}  // namespace reflet::visible_text_test
