// Documents as Markdown and as plain text.
#include "base/document.h"
#include "base/wrap.h"

#include <gtest/gtest.h>

namespace reflet::document_test {
namespace {

TextTable sample() {
    return {{{"pass"}, {"ms", true}}, {{asCode("a_b"), "1.5"}, {"all | of", "10.25"}, {"größer", ""}}};
}

TEST(Document, TablesAsMarkdownEscapeAllButCode) {
    EXPECT_EQ(markdownOf(sample()),
              "| pass | ms |\n|---|--:|\n| `a_b` | 1.5 |\n| all \\| of | 10.25 |\n| größer | |\n");
}

TEST(Document, TablesAsPlainTextAreAligned) {
    EXPECT_EQ(plainTextOf(sample(), 80),
              "pass         ms\n"
              "---------------\n"
              "a_b         1.5\n"
              "all | of  10.25\n"
              "größer\n");
}

TEST(Document, TablesThatAreTooWideAreTurnedIfThatHelps) {
    const TextTable wide{{{"scene"}, {"a long name", true}, {"another one", true}}, {{"cubes", "1", "2"}}};
    EXPECT_EQ(plainTextOf(wide, 20),
              "scene        cubes\n"
              "------------------\n"
              "a long name      1\n"
              "another one      2\n");
    EXPECT_TRUE(plainTextOf(wide, 80).starts_with("scene  a long name  another one\n"));
}

TEST(Document, SectionsAreSeparatedByEmptyLines) {
    const std::vector<Section> document{
        {"", {"By ", asCode("x_y"), ", 3 * 4."}, sample()}, {"One_two", {}, sample()}, {"", {"End."}, {}}};
    const std::string markdown = markdownOf(sample());
    EXPECT_EQ(markdownOf(document),
              "By `x_y`, 3 \\* 4.\n\n" + markdown + "\n### One\\_two\n\n" + markdown + "\nEnd.\n");
    const std::string plain = plainTextOf(sample(), 80);
    EXPECT_EQ(plainTextOf(document, 80), "By x_y, 3 * 4.\n\n" + plain + "\nOne_two\n\n" + plain + "\nEnd.\n");
}

TEST(Wrapped, BreaksBetweenWords) {
    EXPECT_EQ(wrapped("one two three", 7), (std::vector<std::string>{"one two", "three"}));
    EXPECT_EQ(wrapped("ä ö ü", 3), (std::vector<std::string>{"ä ö", "ü"}));
    EXPECT_EQ(firstWordsOf("one two three", 13), "one two three");
    EXPECT_EQ(firstWordsOf("one two three", 11), "one two ...");
}

}  // namespace
}  // namespace reflet::document_test
