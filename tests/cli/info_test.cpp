// What `reflet info` prints of files with very many lights, cameras and variants.
#include "cli/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace reflet::info_test {
namespace {

class Info : public ProgramTest {};

TEST_F(Info, ListsTheFirstOfManyAndTheirNumber) {
    constexpr int many = 2000;
    std::string cameras;
    std::string nodes;
    std::string children;
    for (int i = 0; i < many; ++i) {
        cameras += fmt::format(R"({}{{"type":"perspective","name":"c{}","perspective":{{"yfov":1,"znear":0.1}}}})",
                               i > 0 ? "," : "", i);
        nodes += fmt::format(R"(,{{"camera":{}}})", i);
        children += fmt::format("{}{}", i > 0 ? "," : "", i + 1);
    }
    nodes = R"({"mesh":0,"children":[)" + children + "]}" + nodes;
    write("many.gltf", triangleAnd(R"("cameras":[)" + cameras + R"(],"nodes":[)" + nodes + "]"));
    const Outcome text = run({"info", "many.gltf"});
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_LT(std::ranges::count(text.out, '\n'), 40) << text.out;
    EXPECT_NE(text.out.find("'c0', perspective"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("… and 1980 more; --json lists all"), std::string::npos) << text.out;
    const Outcome json = run({"info", "many.gltf", "--json"});
    EXPECT_EQ(json.status, 0);
    EXPECT_NE(json.out.find("\"c1999\""), std::string::npos);
}

// SECURITY.md: no text of a file reaches the terminal as it is.
TEST_F(Info, NamesFromTheFileAreShownEscaped) {
    const std::string name = R"(x\u202e\u001b]0;y\u0007\nz)";
    write(
        "names.gltf",
        triangleAnd(fmt::format(
            R"("nodes":[{{"mesh":0,"children":[1],"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}},{{"camera":0}}],)"
            R"("cameras":[{{"type":"perspective","name":"{0}","perspective":{{"yfov":1,"znear":0.1}}}}],)"
            R"("extensionsUsed":["KHR_materials_variants","KHR_lights_punctual","{0}"],"extensions":{{)"
            R"("KHR_lights_punctual":{{"lights":[{{"type":"point","name":"{0}"}}]}},)"
            R"("KHR_materials_variants":{{"variants":[{{"name":"{0}"}}]}}}})",
            name)));
    for (const Arguments& command : {Arguments{"info", "names.gltf"}, Arguments{"list", "variants", "names.gltf"}}) {
        const Outcome shown = run(command);
        EXPECT_EQ(shown.status, 0) << shown.err;
        EXPECT_NE(shown.out.find(R"(x\u202e\x1b]0;y\x07\nz)"), std::string::npos) << shown.out;
        EXPECT_EQ((shown.out + shown.err).find_first_of("\x1b\a"), std::string::npos);
        EXPECT_EQ((shown.out + shown.err).find("\u202e"), std::string::npos);
    }
}

}  // namespace
}  // namespace reflet::info_test
