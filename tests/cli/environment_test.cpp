// Light and background as a user chooses them: --environment, --background, and what files without light get.
#include "cli/program.h"

#include "base/image_file.h"
#include "base/json_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace reflet::environment_test {
namespace {

using nlohmann::json;

constexpr int usage = 2;

/// One triangle: (0,0,0), (1,0,0), (0,1,0); `lights` of KHR_lights_punctual, each at a node that is turned to shine
/// from above.
std::string triangleFile(const json& lights) {
    json file = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    if (!lights.empty()) {
        file["extensionsUsed"] = {"KHR_lights_punctual"};
        file["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    }
    for (size_t i = 0; i < lights.size(); ++i) {
        file["scenes"][0]["nodes"].push_back(1 + i);
        file["nodes"].push_back({{"translation", {0, 2, 1}},
                                 {"rotation", {-0.4794255, 0, 0, 0.8775826}},
                                 {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    return jsonText(file);
}

class ChosenLight : public ProgramTest {
protected:
    ChosenLight() {
        write("dark.gltf", triangleFile(json::array()));
        write("lamp.gltf", triangleFile({{{"type", "point"}, {"intensity", 30}}}));
        write("sun.gltf", triangleFile({{{"type", "directional"}, {"intensity", 3}}}));
    }

    /// The bytes of an EXR; the one line on standard error, if any, goes to `note_`.
    std::string picture(const std::string& scene, const Arguments& more) {
        Arguments all{"-o", "a.exr", "--preset", "direct"};
        all.insert(all.end(), more.begin(), more.end());
        const Outcome done = render(scene, all);
        EXPECT_EQ(done.status, 0) << done.err;
        EXPECT_LE(std::ranges::count(done.err, '\n'), 1) << done.err;
        note_ = done.err;
        return read("a.exr");
    }

    std::string note_;
};

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(ChosenLight, FilesWithoutEnoughLightGetSomeAndOneLineSaysSo) {
    const std::string sky = picture("dark.gltf", {});
    EXPECT_NE(note_.find("reflet: note: dark.gltf: no light: added a clear sky with its sun"), std::string::npos)
        << note_;
    EXPECT_NE(note_.find("--environment sky|studio|none|FILE"), std::string::npos) << note_;
    EXPECT_EQ(picture("dark.gltf", {"--environment", "sky"}), sky);
    EXPECT_EQ(note_, "") << "chosen, so there is nothing to tell";
    (void)picture("lamp.gltf", {});
    EXPECT_NE(note_.find("lamps but no environment: added a dim studio"), std::string::npos) << note_;
    (void)picture("sun.gltf", {});
    EXPECT_NE(note_.find("added a clear sky that fits its sun"), std::string::npos) << note_;
    const std::string none = picture("dark.gltf", {"--environment", "none"});
    EXPECT_EQ(note_, "");
    EXPECT_NE(none, sky);
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(ChosenLight, BuiltinScenesAndViewFilesThatStateLightKeepTheirs) {
    (void)picture("builtin:cornell", {});
    EXPECT_EQ(note_, "");
    write("sun.json", R"({"sun": {"irradiance": [1, 1, 1]}})");
    write("night.json", R"({"environment": {"radiance": [0, 0, 0]}})");
    write("time.json", R"({"time": 0})");
    (void)picture("dark.gltf", {"--view-file", "sun.json"});
    EXPECT_EQ(note_, "");
    const std::string night = picture("dark.gltf", {"--view-file", "night.json"});
    EXPECT_EQ(note_, "");
    EXPECT_EQ(night, picture("dark.gltf", {"--environment", "none"}));
    (void)picture("dark.gltf", {"--view-file", "time.json"});
    EXPECT_NE(note_, "") << "it does not speak of light";
}

TEST_F(ChosenLight, AFileOfAnEnvironmentIsTakenAndAWrongOneRefused) {
    const ImageLayer sky{"", {2, 1, {"R", "G", "B"}, {1, 2, 3, 1, 2, 3}}, PixelType::float32};
    writeExr(path("sky.exr"), {&sky, 1});
    write("view.json", R"({"environment": "sky.exr"})");
    const std::string chosen = picture("dark.gltf", {"--environment", "sky.exr"});
    EXPECT_EQ(picture("dark.gltf", {"--view-file", "view.json"}), chosen);
    const FloatImage image = layers("a.exr").at(0).image;
    EXPECT_EQ((std::vector<float>{image.data[0], image.data[1], image.data[2]}), (std::vector<float>{1, 2, 3}));
    EXPECT_TRUE(refused(render("dark.gltf", {"-o", "b.exr", "--environment", "absent.hdr"}), 1, {"absent.hdr"}));
    EXPECT_TRUE(
        refused(render("dark.gltf", {"-o", "b.exr", "--environment", "sun"}), 1, {"sun", "sky, studio or none"}));
    EXPECT_TRUE(refused(render("dark.gltf", {"-o", "b.exr", "--background", "pink"}), usage, {"pink", "transparent"}));
}

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(ChosenLight, BackgroundsGoIntoTheImagesOfRenderAndReference) {
    const auto shown = [&](const char* command, const char* background) {
        Arguments all{command, "dark.gltf", "--size", "32x18", "--environment", "studio",
                      "-o",    "a.png",     "-o",     "a.exr", "--background",  background};
        if (command == std::string("reference")) {
            all.insert(all.end(), {"--spp", "16"});
        } else {
            all.insert(all.end(), {"--preset", "direct", "--set", "temporal.enabled=true"});
        }
        const Outcome done = run(all);
        EXPECT_EQ(done.status, 0) << done.err;
        return readBitmap(path("a.png"));
    };
    for (const char* command : {"render", "reference"}) {
        const Bitmap white = shown(command, "white");
        EXPECT_EQ(white.channels, 3U);
        EXPECT_EQ(white.data[0], 255) << command;
        const Bitmap transparent = shown(command, "transparent");
        ASSERT_EQ(transparent.channels, 4U) << command;
        EXPECT_EQ(transparent.data[3], 0) << command;
        unsigned solid = 0;
        unsigned partial = 0;
        for (size_t i = 3; i < transparent.data.size(); i += 4) {
            solid += transparent.data[i] == 255 ? 1 : 0;
            partial += transparent.data[i] > 0 && transparent.data[i] < 255 ? 1 : 0;
        }
        EXPECT_GT(solid, 10U) << command;
        EXPECT_GT(partial, 5U) << command << ": edges are antialiased";
        const FloatImage values = layers("a.exr").at(0).image;
        EXPECT_EQ(values.channels, (std::vector<std::string>{"R", "G", "B", "A"})) << command;
        EXPECT_EQ(values.data[3], 0.0F) << command;
        const Bitmap blur = shown(command, "blur");
        EXPECT_NE(blur.data, shown(command, "environment").data) << command;
    }
}

TEST_F(ChosenLight, BackgroundsOfViewFilesAreKeptUnderAnOption) {
    write("view.json", R"({"background": [1, 0, 0], "environment": "sky"})");
    (void)picture("dark.gltf", {"-o", "a.png", "--view-file", "view.json", "--environment", "studio"});
    const Bitmap red = readBitmap(path("a.png"));
    EXPECT_EQ((std::vector<uint8_t>(red.data.begin(), red.data.begin() + 3)), (std::vector<uint8_t>{255, 0, 0}));
    (void)picture("dark.gltf", {"-o", "a.png", "--view-file", "view.json", "--background", "0,0,1"});
    const Bitmap blue = readBitmap(path("a.png"));
    EXPECT_EQ((std::vector<uint8_t>(blue.data.begin(), blue.data.begin() + 3)), (std::vector<uint8_t>{0, 0, 255}));
}

}  // namespace
}  // namespace reflet::environment_test
