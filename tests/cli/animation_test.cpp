// `--time` and animated glTF files.
#include "base/json_text.h"
#include "cli/program.h"

#include <nlohmann/json.hpp>

#include <cstring>

namespace reflet::animation_test {
namespace {

using nlohmann::json;

std::string base64(const std::vector<float>& floats) {
    static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes(floats.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), floats.data(), bytes.size());
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k) {
            bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

/// A large triangle that moves from x = -1 to 1 in 2 s, or is static at x.
std::string triangleFile(bool moves, float x) {
    const std::vector<float> data{-1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 2, -1, 0, 0, 1, 0, 0};
    const auto view = [](int offset, int length) {
        return json{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
    };
    const auto accessor = [](int bufferView, int count, const char* type) {
        return json{{"bufferView", bufferView}, {"componentType", 5126}, {"count", count}, {"type", type}};
    };
    json file{{"asset", {{"version", "2.0"}}},
              {"buffers",
               {{{"byteLength", data.size() * 4}, {"uri", "data:application/octet-stream;base64," + base64(data)}}}},
              {"bufferViews", {view(0, 36), view(36, 8), view(44, 24)}},
              {"accessors", {accessor(0, 3, "VEC3"), accessor(1, 2, "SCALAR"), accessor(2, 2, "VEC3")}},
              {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
              {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}}}},
              {"nodes", {{{"mesh", 0}, {"translation", {x, 0, 0}}}, {{"camera", 0}, {"translation", {0, 0, 4}}}}},
              {"scenes", {{{"nodes", {0, 1}}}}},
              {"scene", 0}};
    if (moves) {
        file["animations"] =
            json::array({{{"samplers", {{{"input", 1}, {"output", 2}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}});
    }
    return jsonText(file);
}

class Animation : public ProgramTest {
protected:
    Animation() {
        write("moving.gltf", triangleFile(true, 0.0F));
        write("half.gltf", triangleFile(false, 0.5F));
        write("start.gltf", triangleFile(false, -1.0F));
        write("late.json", R"({"time": 1.5})");
    }
    [[nodiscard]] std::string picture(const std::string& scene, const Arguments& more) const {
        Arguments all{"-o", "picture.exr", "--environment", "none", "--preset", "direct"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(quietSuccess(render(scene, all)));
        return read("picture.exr");
    }
};

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Animation, ARenderAtATimeHasTheBytesOfOneOfAStaticFile) {
    const std::string half = picture("half.gltf", {});
    EXPECT_EQ(picture("moving.gltf", {"--time", "1.5"}), half);
    EXPECT_EQ(picture("moving.gltf", {"--time", "3.5"}), half) << "it repeats after 2 s";
    EXPECT_EQ(picture("moving.gltf", {"--view-file", "late.json"}), half);
    const std::string start = picture("start.gltf", {});
    EXPECT_NE(start, half);
    EXPECT_EQ(picture("moving.gltf", {}), start) << "the animation's start, not the node's own transform";
    EXPECT_EQ(picture("moving.gltf", {"--view-file", "late.json", "--time", "0"}), start) << "--time overrides";
    EXPECT_EQ(picture("half.gltf", {"--time", "7"}), half) << "static";
}

TEST_F(Animation, TheReferenceSeesTheSceneAtThatTime) {
    const auto trace = [&](const std::string& scene, const Arguments& more) {
        Arguments all{"reference", scene, "--size", "32x18", "--spp", "2", "-o", "truth.exr"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(run(all).status, 0);
        return read("truth.exr");
    };
    EXPECT_EQ(trace("moving.gltf", {"--time", "1.5"}), trace("half.gltf", {}));
    EXPECT_NE(trace("moving.gltf", {"--time", "1.5"}), trace("moving.gltf", {}));
}

TEST_F(Animation, AnInvalidTimeIsRefused) {
    EXPECT_TRUE(refused(render("moving.gltf", {"-o", "a.png", "--time", "-1"}), 2, {"--time", "-1"}));
    EXPECT_TRUE(refused(render("moving.gltf", {"-o", "a.png", "--time", "nan"}), 2, {"--time"}));
    EXPECT_EQ(render("moving.gltf", {"-o", "a.png", "--time", "soon"}).status, 2);
}

TEST_F(Animation, OneOfSeveralClipsIsChosen) {
    json file = json::parse(triangleFile(true, 0.5F));
    json clip = file["animations"][0];
    clip["name"] = "go\nhome";
    file["animations"] = {file["animations"][0], clip};
    file["animations"][0]["name"] = "stay";
    write("clips.gltf", jsonText(file));
    EXPECT_EQ(run({"render", "clips.gltf", "--animation", "list"}).out, "stay\ngo\\nhome\n");
    const Outcome info = run({"info", "clips.gltf"});
    EXPECT_NE(info.out.find("'stay', 2 s, 1 channels\n"), std::string::npos) << info.out;
    EXPECT_NE(info.out.find("does not play unless --animation names it"), std::string::npos) << info.out;
    const auto trace = [&](const std::string& scene, const Arguments& more) {
        Arguments all{"reference", scene, "--size", "16x9", "--spp", "1", "-o", "truth.exr"};
        all.insert(all.end(), more.begin(), more.end());
        const Outcome traced = run(all);
        EXPECT_EQ(traced.status, 0) << traced.err;
        return std::pair(read("truth.exr"), traced.err);
    };
    EXPECT_EQ(trace("clips.gltf", {"--animation", "none"}).first, trace("half.gltf", {}).first) << "the rest pose";
    EXPECT_EQ(trace("clips.gltf", {"--animation", "1"}).first, trace("start.gltf", {}).first);
    const std::string note = trace("clips.gltf", {}).second;
    EXPECT_NE(note.find("1 other animation of what 'stay' moves does not play"), std::string::npos) << note;
    EXPECT_TRUE(
        refused(render("clips.gltf", {"-o", "a.png", "--animation", "run"}), 2, {"no animation 'run'", "stay"}));
    EXPECT_TRUE(
        refused(render("builtin:moving", {"-o", "a.png", "--animation", "0"}), 2, {"--animation 0", "built-in"}));
}

}  // namespace
}  // namespace reflet::animation_test
