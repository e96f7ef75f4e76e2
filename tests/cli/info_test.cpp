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

}  // namespace
}  // namespace reflet::info_test
