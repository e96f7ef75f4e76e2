// Strict reading of JSON files.
#include "base/json.h"

#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "unit/message_of.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>

namespace reflet::json_test {
namespace {

using test::messageOf;

/// The error message of parseJsonFile for this content, without the file's name.
std::string parseErrorOf(const std::string& content) {
    const auto path = std::filesystem::path(::testing::TempDir()) / "reflet_json_test.json";
    writeFileAtomically(path, content);
    const std::string message = messageOf([&] { parseJsonFile(path); });
    std::filesystem::remove(path);
    return message.starts_with(path.string()) ? message.substr(path.string().size()) : message;
}

TEST(JsonFile, ThatIsWellFormedIsRead) {
    EXPECT_EQ(parseErrorOf(R"([{"a": 1, "b": {"a": 2}}, {"a": 1}, "\u00e9", -1.5e3, null, true])"), "no error");
}

TEST(JsonFile, ThatIsMalformedIsAnErrorWithTheLineAndColumnWhereReadingStopped) {
    EXPECT_TRUE(parseErrorOf("{\n\n  \"a\" 1}").starts_with(":3:7: ")) << parseErrorOf("{\n\n  \"a\" 1}");
    EXPECT_TRUE(parseErrorOf("").starts_with(":1:1: "));
    EXPECT_TRUE(parseErrorOf("[1,\n").starts_with(":2:1: ")) << parseErrorOf("[1,\n");
}

TEST(JsonFile, WithAKeyTwiceInOneObjectIsAnError) {
    EXPECT_EQ(parseErrorOf(R"({"a": {"b": [{"c": 1, "c": 2}]}})"), ": a.b.c: duplicate key");
}

TEST(JsonFile, DeeplyNestedIsAnError) {
    EXPECT_EQ(parseErrorOf(std::string(200000, '[')), ": is nested more than 128 levels deep");
    EXPECT_EQ(parseErrorOf(std::string(128, '[') + std::string(128, ']')), "no error");
}

TEST(JsonNode, SaysWhereInTheFileItStands) {
    const auto json = parseJson(R"({"a": {"b": [1, "two"]}})");
    const JsonNode root(json, "f.json");
    EXPECT_EQ(root.path(), "");
    EXPECT_EQ(root.find("missing"), std::nullopt);
    const JsonNode element = root.find("a")->find("b")->at(1);
    EXPECT_EQ(element.path(), "a.b[1]");
    EXPECT_EQ(element.json(), "two");
    EXPECT_EQ(messageOf([&] { element.complain("is wrong"); }), "f.json: a.b[1]: is wrong");
    EXPECT_EQ(messageOf([&] { root.complain("is wrong"); }), "f.json: is wrong");
}

TEST(JsonNode, OnAnyJsonTheTypedReadersReturnOrThrow) {
    for (const char* text : {"null", "true", "1", "\"x\"", "[]", "[1,2]", "{}", "{\"x\":1}"}) {
        const auto json = parseJson(text);
        const JsonNode node(json, "f.json");
        messageOf([&] { (void)node.number(0, 1); });
        messageOf([&] { (void)node.numbers(2, 0, 9); });
        messageOf([&] { node.requireKeys(std::array<std::string, 1>{"y"}); });
        messageOf([&] { (void)node.find("x"); });
    }
}

TEST(JsonTexts, AreThoseUnderTheKeyInElementsOfTheArrays) {
    constexpr std::array<std::string_view, 2> arrays{"buffers", "images"};
    const auto textsIn = [&](const char* text) { return jsonTextsIn(text, arrays, "uri"); };
    const std::vector<std::string> both{"a", "b"};
    EXPECT_EQ(textsIn(R"({"images":[{"n":{"uri":"no"},"uri":"a"},["no"],3,{"uri":4},{"uri":["no"]},{"uri":"b"}]})"),
              both);
    EXPECT_EQ(textsIn(R"({"buffers":[{"uri":"a"}],"meshes":[{"uri":"no"}],"images":[{"name":"no","uri":"b"}]})"), both);
    for (const char* none : {"[]", "3", "\"uri\"", R"({"uri":"a"})", R"({"images":{"x":{"uri":"a"}}})",
                             R"([{"images":[{"uri":"a"}]}])", R"({"x":{"images":[{"uri":"a"}]}})"}) {
        EXPECT_TRUE(textsIn(none).empty()) << none;
    }
    EXPECT_THROW((void)textsIn(R"({"images":[{"uri":"a"},)"), Error);
}

}  // namespace
}  // namespace reflet::json_test
