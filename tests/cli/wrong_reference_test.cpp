// Errors of `reflet reference` and their exit status.
#include "cli/reference_program.h"

#include <filesystem>

namespace reflet::wrong_reference_test {
namespace {

constexpr int failed = 1;
constexpr int usage = 2;

class WrongReference : public Reference {
protected:
    [[nodiscard]] Outcome wrong(const Arguments& more) const {
        Arguments all{"-o", "a.exr", "--spp", "1"};
        all.insert(all.end(), more.begin(), more.end());
        return reference(cubes, all);
    }
};

TEST_F(WrongReference, ARunThatWouldWriteNothingIsRefused) {
    EXPECT_TRUE(refused(reference(cubes, {}), usage, {"nothing to write", "-o FILE.exr", "reflet reference --help"}));
}

TEST_F(WrongReference, AnOutputOfUnknownFormatIsRefused) {
    EXPECT_TRUE(refused(reference(cubes, {"-o", "a.jpg"}), usage, {"a.jpg", ".exr", ".png"}));
    EXPECT_TRUE(refused(reference(cubes, {"-o", "a.exr", "-o", "picture"}), usage, {"picture", ".exr", ".png"}));
    EXPECT_EQ(files(), Names{});
}

TEST_F(WrongReference, NumbersAreChecked) {
    const std::vector<Names> all{{"--spp", "0"},      {"--spp", "-1"},     {"--spp", "1048577"}, {"--spp", "few"},
                                 {"--bounces", "-1"}, {"--bounces", "x"},  {"--noise", "-0.1"},  {"--noise", "nan"},
                                 {"--noise", "low"},  {"--threads", "-1"}, {"--seed", "-1"},     {"--size", "0x4"}};
    for (const Names& option : all) {
        Arguments more{"-o", "a.exr"};
        more.insert(more.end(), option.begin(), option.end());
        Arguments whole{"reference", cubes};
        whole.insert(whole.end(), more.begin(), more.end());
        EXPECT_TRUE(refused(run(whole), usage, {option[0], option[1]})) << option[0] << " " << option[1];
    }
    EXPECT_EQ(files(), Names{});
}

TEST_F(WrongReference, ASizeBeyondTheFilesLimitIsReportedWithIt) {
    EXPECT_TRUE(refused(run({"reference", cubes, "-o", "a.exr", "--size", "4000000000x10"}), usage,
                        {"--size 4000000000x10", "up to 65536 pixels a side"}));
}

TEST_F(WrongReference, ChoicesAreChecked) {
    EXPECT_TRUE(refused(wrong({"--filter", "x"}), usage, {"--filter", "x", "box", "center", "--help"}));
    EXPECT_TRUE(refused(wrong({"--sampling", "x"}), usage, {"--sampling", "x", "cosine", "uniform", "--help"}));
    EXPECT_TRUE(refused(wrong({"--camera", "nowhere"}), usage, {"'nowhere'", "'main'"}));
    EXPECT_TRUE(refused(wrong({"--preset", "fst"}), usage, {"'fst'", "did you mean 'fast'"}));
    EXPECT_TRUE(refused(wrong({"--set", "materials.lambert=1"}), usage, {"did you mean 'materials.lambert_only'"}));
}

TEST_F(WrongReference, LayersAndTheOptionsOfOneAreChecked) {
    EXPECT_TRUE(
        refused(wrong({"--layers", "normals"}), usage, {"'normals'", "did you mean 'normal'", "sun_visibility"}));
    EXPECT_TRUE(refused(wrong({"--layers", "depth,depth"}), usage, {"--layers", "'depth'", "twice"}));
    EXPECT_TRUE(refused(wrong({"--ao-radius", "2"}), usage, {"--ao-radius", "--layers ambient_occlusion"}));
    for (const Names& option : {Names{"--ao-radius", "0"}, Names{"--ao-radius", "nan"}, Names{"--ao-falloff", "1.5"}}) {
        EXPECT_TRUE(
            refused(wrong({"--layers", "ambient_occlusion", option[0], option[1]}), usage, {option[0], option[1]}));
    }
    EXPECT_EQ(files(), Names{});
}

TEST_F(WrongReference, AnUnknownOptionIsNamedWithTheNearest) {
    EXPECT_TRUE(refused(wrong({"--bounce", "3"}), usage, {"'--bounce'", "did you mean '--bounces'"}));
    EXPECT_TRUE(refused(wrong({"--frobnicate"}), usage, {"'--frobnicate'", "reflet reference --help"}));
    EXPECT_TRUE(refused(run({"reference"}), usage, {"SCENE", "--help"}));
    EXPECT_TRUE(refused(run({"referense", cubes}), usage, {"did you mean 'reference'"}));
}

TEST_F(WrongReference, ASceneOrViewFileThatIsBrokenIsNamedWithThePlace) {
    write("broken.gltf", "{ \"asset\": ");
    write("v.json", R"({"camera": {"positon": [1, 2, 3]}})");
    write("a.exr", "the old picture");
    EXPECT_TRUE(refused(reference("broken.gltf", {"-o", "a.exr"}), failed, {"broken.gltf", "JSON", "line 1"}));
    EXPECT_TRUE(refused(reference("absent.glb", {"-o", "a.exr"}), failed, {"absent.glb", "no file"}));
    EXPECT_TRUE(refused(reference("builtin:cubs", {"-o", "a.exr"}), usage, {"'cubs'", "did you mean 'cubes'"}));
    EXPECT_TRUE(refused(wrong({"--view-file", "v.json"}), failed, {"v.json: camera.positon", "did you mean"}));
    EXPECT_EQ(read("a.exr"), "the old picture");
    EXPECT_EQ(files(), (Names{"a.exr", "broken.gltf", "v.json"}));
}

TEST_F(WrongReference, AnOutputThatCannotBeWrittenIsNamedBeforeAnyWork) {
    const std::string manySamples = "1000000";  // would take forever
    EXPECT_TRUE(refused(reference(cubes, {"--spp", manySamples, "-o", "a.exr", "-o", "absent/a.exr"}), failed,
                        {"absent/a.exr", "create the folder 'absent'"}));
    std::filesystem::create_directory(path("folder.exr"));
    EXPECT_TRUE(
        refused(reference(cubes, {"--spp", manySamples, "-o", "folder.exr"}), failed, {"folder.exr", "is a folder"}));
    EXPECT_EQ(files(), Names{"folder.exr"});
}

}  // namespace
}  // namespace reflet::wrong_reference_test
