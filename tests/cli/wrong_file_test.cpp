// Errors for invalid files, folders or machines.
#include "cli/program.h"

#include <filesystem>

namespace reflet::wrong_file_test {
namespace {

constexpr int failed = 1;
const std::string cubes = "builtin:cubes";
const Variables noDriver{{"VK_ICD_FILENAMES", "/nowhere/none.json"}, {"VK_DRIVER_FILES", "/nowhere/none.json"}};

class WrongFile : public ProgramTest {
protected:
    [[nodiscard]] Outcome renderScene(const std::string& scene) const { return render(scene, {"-o", "a.png"}); }
    [[nodiscard]] Outcome withSettings(std::string_view json) const {
        write("s.json", json);
        return render(cubes, {"-o", "a.png", "--settings", "s.json"});
    }
    [[nodiscard]] Outcome withView(std::string_view json) const {
        write("v.json", json);
        return render(cubes, {"-o", "a.png", "--view-file", "v.json"});
    }
};

TEST_F(WrongFile, AMissingSceneFileIsNamed) {
    EXPECT_TRUE(refused(renderScene("absent.gltf"), failed, {"absent.gltf", "no file"}));
    EXPECT_TRUE(refused(renderScene("."), failed, {".", "not a file"}));
}

TEST_F(WrongFile, ABrokenGltfIsNamedWithThePlace) {
    write("broken.gltf", "{ \"asset\": ");
    EXPECT_TRUE(refused(renderScene("broken.gltf"), failed, {"broken.gltf", "JSON", "line 1"}));
    write("old.gltf", R"({ "asset": { "version": "1.0" } })");
    EXPECT_TRUE(refused(renderScene("old.gltf"), failed, {"old.gltf", "version"}));
    write("short.glb", "glTF");
    EXPECT_TRUE(refused(renderScene("short.glb"), failed, {"short.glb"}));
    write("picture.png", "\x89PNG\r\n");
    EXPECT_TRUE(refused(renderScene("picture.png"), failed, {"picture.png", "JSON"}));
}

TEST_F(WrongFile, AGltfThatCanBeDrawnInPartIsRefusedOnlyIfStrict) {
    write("slip.gltf", R"({"asset": {"version": "2.0"}, "scene": 7, "scenes": [{}]})");
    EXPECT_TRUE(refused(render("slip.gltf", {"-o", "a.png", "--strict"}), failed, {"slip.gltf", "scene: is 7"}));
    const Outcome forgiving = renderScene("slip.gltf");
    EXPECT_NE(forgiving.err.find("warning: slip.gltf: scene: its default will be used: is 7"), std::string::npos)
        << forgiving.err;
}

TEST_F(WrongFile, ASettingsFileThatIsMissingOrMalformedIsNamedWithThePlace) {
    EXPECT_TRUE(refused(render(cubes, {"-o", "a.png", "--settings", "absent.json"}), failed, {"absent.json"}));
    EXPECT_TRUE(refused(withSettings("{\n  \"diffuse\": { \"rays\": 4, }\n}"), failed, {"s.json:2:27", "'}'"}));
    EXPECT_TRUE(refused(withSettings("[]"), failed, {"s.json", "must be an object"}));
    EXPECT_TRUE(refused(withSettings(R"({"diffuse": 4})"), failed, {"s.json", "diffuse", "must be an object", "4"}));
    EXPECT_TRUE(
        refused(withSettings(R"({"diffuse": {"rays": 1, "rays": 2}})"), failed, {"diffuse.rays", "duplicate key"}));
}

TEST_F(WrongFile, AnUnknownSettingInAFileIsNamedWithTheNearest) {
    EXPECT_TRUE(refused(withSettings(R"({"diffuse": {"ray": 4}})"), failed,
                        {"s.json", "'diffuse.ray'", "did you mean 'diffuse.rays'"}));
    EXPECT_TRUE(refused(withSettings(R"({"difuse": {}})"), failed, {"s.json", "'difuse'", "did you mean 'diffuse'"}));
}

TEST_F(WrongFile, ASettingInAFileIsCheckedForRangeAndType) {
    EXPECT_TRUE(refused(withSettings(R"({"diffuse": {"rays": 999}})"), failed, {"s.json", "0 to 256", "'999'"}));
    EXPECT_TRUE(refused(withSettings(R"({"diffuse": {"rays": "4"}})"), failed, {"s.json", "a whole number"}));
    EXPECT_TRUE(refused(withSettings(R"({"diffuse": {"rays": [4]}})"), failed, {"s.json", "a whole number"}));
    EXPECT_TRUE(refused(withSettings(R"({"tonemap": {"curve": "ace"}})"), failed, {"s.json", "aces", "'ace'"}));
    EXPECT_TRUE(refused(withSettings(R"({"tonemap": {"curve": 4}})"), failed, {"s.json", "aces", "'4'"}));
    EXPECT_TRUE(refused(withSettings(R"({"trace_screen": {"jitter": "on"}})"), failed, {"s.json", "true or false"}));
}

TEST_F(WrongFile, AViewFileIsCheckedWithThePlace) {
    EXPECT_TRUE(refused(render(cubes, {"-o", "a.png", "--view-file", "absent.json"}), failed, {"absent.json"}));
    EXPECT_TRUE(refused(withView("{\n  \"camera\": }"), failed, {"v.json:2:13"}));
    EXPECT_TRUE(refused(withView(R"({"camera": {"positon": [1, 2, 3]}})"), failed,
                        {"v.json: camera.positon", "did you mean 'position'"}));
    EXPECT_TRUE(refused(withView(R"({"camera": {"position": [1, 2]}})"), failed, {"camera.position", "3 numbers"}));
    EXPECT_TRUE(refused(withView(R"({"camera": {"fov_y": 180}})"), failed, {"camera.fov_y", "179 degrees", "180"}));
}

TEST_F(WrongFile, AnEnvironmentImageThatCannotBeReadIsNamed) {
    EXPECT_TRUE(
        refused(withView(R"({"environment": {"image": "absent.hdr"}})"), failed, {"absent.hdr", "No such file"}));
    write("sky.hdr", "no picture");
    EXPECT_TRUE(refused(withView(R"({"environment": {"image": "sky.hdr"}})"), failed, {"sky.hdr", "Radiance HDR"}));
}

TEST_F(WrongFile, AnOutputThatCannotBeWrittenIsNamedBeforeAnyWork) {
    EXPECT_TRUE(refused(render(cubes, {"-o", "absent/a.png"}), failed, {"absent/a.png", "create the folder 'absent'"}));
    std::filesystem::create_directory(path("folder.png"));
    EXPECT_TRUE(refused(render(cubes, {"-o", "folder.png"}), failed, {"folder.png", "is a folder"}));
    EXPECT_TRUE(refused(render(cubes, {"-o", "a.png", "--timings", "absent/t.json"}), failed, {"absent/t.json"}));
    EXPECT_EQ(files(), std::vector<std::string>{"folder.png"});
}

TEST_F(WrongFile, WithoutAVulkanDriverTheMessageSaysWhatToInstall) {
    EXPECT_TRUE(refused(render(cubes, {"-o", "a.png"}, noDriver), failed, {"Vulkan", "mesa-vulkan-drivers"}));
    EXPECT_TRUE(refused(run({"list", "devices"}, noDriver), failed, {"Vulkan", "mesa-vulkan-drivers"}));
}

TEST_F(WrongFile, APictureThatIsThereSurvivesAFailingRender) {
    write("a.png", "the old picture");
    EXPECT_EQ(render(cubes, {"-o", "a.png"}, noDriver).status, failed);
    EXPECT_EQ(render(cubes, {"-o", "a.png", "-o", "absent/b.png"}).status, failed);
    EXPECT_EQ(render("absent.glb", {"-o", "a.png"}).status, failed);
    EXPECT_EQ(read("a.png"), "the old picture");
    EXPECT_EQ(files(), std::vector<std::string>{"a.png"});
}

}  // namespace
}  // namespace reflet::wrong_file_test
