// Errors for invalid command lines and their exit status.
#include "cli/program.h"

namespace reflet::wrong_use_test {
namespace {

constexpr int failed = 1;
constexpr int usage = 2;
const std::string cubes = "builtin:cubes";

class WrongUse : public ProgramTest {
protected:
    [[nodiscard]] Outcome renderWith(const Arguments& more) const {
        Arguments all{"-o", "a.png"};
        all.insert(all.end(), more.begin(), more.end());
        return render(cubes, all);
    }
    [[nodiscard]] Outcome set(const std::string& assignment) const { return renderWith({"--set", assignment}); }
};

TEST_F(WrongUse, AMissingSubcommandIsAskedFor) {
    EXPECT_TRUE(refused(run({}), usage, {"subcommand", "render", "list", "--help"}));
    EXPECT_TRUE(refused(run({"list"}), usage, {"reflet list", "scenes", "devices", "--help"}));
}

TEST_F(WrongUse, AnUnknownSubcommandIsNamedWithTheNearest) {
    EXPECT_TRUE(refused(run({"rendr", cubes}), usage, {"'rendr'", "did you mean 'render'"}));
    EXPECT_TRUE(refused(run({"list", "scene"}), usage, {"'scene'", "did you mean 'scenes'"}));
    EXPECT_TRUE(refused(run({"--frobnicate"}), usage, {"'--frobnicate'", "render"}));
}

TEST_F(WrongUse, AnUnknownOptionIsNamedWithTheNearest) {
    EXPECT_TRUE(refused(renderWith({"--siz", "8x8"}), usage, {"'--siz'", "did you mean '--size'", "--help"}));
    EXPECT_TRUE(refused(run({"list", "scenes", "--foo"}), usage, {"'--foo'", "reflet list scenes --help"}));
    EXPECT_TRUE(refused(renderWith({"second.glb"}), usage, {"'second.glb'", "--help"}));
    EXPECT_TRUE(refused(renderWith({"--camera-orbit", "1,2"}), usage, {"'--camera-orbit'", "use --orbit AZ,EL"}));
    EXPECT_TRUE(refused(renderWith({"--spp=64"}), usage, {"'--spp=64'", "--effort high"}));
    EXPECT_TRUE(refused(run({"reference", cubes, "--samples", "9"}), usage, {"use --spp N"}));
}

TEST_F(WrongUse, CamerasByAnglesNameTheirRanges) {
    EXPECT_TRUE(refused(renderWith({"--orbit", "-30,100"}), usage, {"--orbit", "-90 to 90", "'-30,100'"}));
    EXPECT_TRUE(refused(renderWith({"--fov", "200"}), usage,
                        {"--fov", "200 not in range 1 to 179 (see reflet render --help)"}));
    EXPECT_TRUE(refused(renderWith({"--sun", "1"}), usage, {"--sun", "-360 to 360"}));
    EXPECT_TRUE(refused(render(cubes, {"-o", "a.jpg"}), usage, {"a.jpg", ".png", "JPEG"}));
}

TEST_F(WrongUse, AMissingSceneIsAskedFor) {
    EXPECT_TRUE(refused(run({"render"}), usage, {"SCENE", "--help"}));
}

TEST_F(WrongUse, ARunThatWouldWriteNothingIsRefused) {
    EXPECT_TRUE(refused(render(cubes, {}), usage, {"-o FILE.png"}));
}

TEST_F(WrongUse, AnUnknownBuiltinSceneIsNamedWithTheNearestAndAll) {
    EXPECT_TRUE(refused(run({"render", "builtin:cubs", "-o", "a.png"}), usage,
                        {"'cubs'", "did you mean 'cubes'", "cornell, cave"}));
}

TEST_F(WrongUse, AnUnknownCameraIsReportedWithTheAvailableOnes) {
    EXPECT_TRUE(refused(renderWith({"--camera", "nowhere"}), usage, {"'nowhere'", "'main'"}));
    EXPECT_TRUE(refused(renderWith({"--scene", "3"}), usage, {"--scene 3", "one scene"}));
}

TEST_F(WrongUse, AnUnknownSettingIsNamedWithTheNearest) {
    EXPECT_TRUE(refused(set("trace_screen.maxstep=4"), usage,
                        {"'trace_screen.maxstep'", "did you mean 'trace_screen.max_steps'", "list settings"}));
}

TEST_F(WrongUse, AValueOutOfRangeIsReportedWithTheRange) {
    EXPECT_TRUE(refused(set("diffuse.rays=999"), usage, {"diffuse.rays", "0 to 256", "'999'"}));
    EXPECT_TRUE(refused(set("diffuse.rays=-1"), usage, {"diffuse.rays", "0 to 256", "'-1'"}));
    EXPECT_TRUE(refused(set("tonemap.exposure=24.5"), usage, {"tonemap.exposure", "-24 to 24", "'24.5'"}));
}

TEST_F(WrongUse, NanIsNoNumber) {
    for (const char* option : {"--fov", "--zoom", "--f-number", "--seconds"}) {
        EXPECT_TRUE(refused(run({"render", "builtin:cubes", option, "nan", "-o", "a.png"}), usage,
                            {option, "must be a number, is 'nan'"}));
    }
    EXPECT_TRUE(refused(run({"qualify", "--seconds", "-nan"}), usage, {"--seconds", "must be a number"}));
}

TEST_F(WrongUse, AValueOfTheWrongTypeIsReportedWithTheRightOne) {
    EXPECT_TRUE(refused(set("diffuse.rays=1.5"), usage, {"diffuse.rays", "a whole number", "'1.5'"}));
    EXPECT_TRUE(refused(set("tonemap.exposure=bright"), usage, {"tonemap.exposure", "a number", "'bright'"}));
    EXPECT_TRUE(refused(set("tonemap.exposure=nan"), usage, {"tonemap.exposure", "a number", "'nan'"}));
    EXPECT_TRUE(refused(set("tonemap.exposure="), usage, {"tonemap.exposure", "a number", "''"}));
    EXPECT_TRUE(refused(set("trace_screen.jitter=2"), usage, {"trace_screen.jitter", "true or false", "'2'"}));
    EXPECT_TRUE(refused(set("tonemap.curve=acse"), usage, {"tonemap.curve", "aces", "'acse'"}));
}

TEST_F(WrongUse, AnAssignmentWithoutEqualsSignOrNameIsRefused) {
    EXPECT_TRUE(refused(set("diffuse.rays"), usage, {"--set", "KEY=VALUE", "'diffuse.rays'"}));
    EXPECT_TRUE(refused(set("=4"), usage, {"''", "list settings"}));
}

TEST_F(WrongUse, AMessageIsOneLineWhateverNamesAreInIt) {
    EXPECT_TRUE(refused(set("two\nlines=3"), usage, {"'two\\nlines'"}));
}

TEST_F(WrongUse, AnUnknownPresetIsNamedWithTheNearest) {
    EXPECT_TRUE(refused(renderWith({"--preset", "fst"}), usage, {"'fst'", "did you mean 'fast'", "quality"}));
}

TEST_F(WrongUse, AnUnknownImageOfTheFrameIsNamedWithTheNearest) {
    EXPECT_TRUE(refused(renderWith({"--show", "norml"}), usage, {"'norml'", "did you mean 'normal'", "list shows"}));
    EXPECT_TRUE(refused(render(cubes, {"-o", "a.exr", "--aov", "direct,norml"}), usage, {"'norml'", "'normal'"}));
}

TEST_F(WrongUse, AovsNeedAnExrFile) {
    EXPECT_TRUE(refused(renderWith({"--aov", "normal"}), usage, {"--aov", "-o FILE.exr"}));
}

TEST_F(WrongUse, AShadowMapSharesNoFile) {
    EXPECT_TRUE(refused(render(cubes, {"-o", "a.exr", "--aov", "shadow_map"}), usage, {"--show shadow_map"}));
    EXPECT_TRUE(refused(render(cubes, {"-o", "a.exr", "--show", "shadow_map", "--aov", "depth"}), usage, {"--aov"}));
}

TEST_F(WrongUse, AnImageThatTheFrameDoesNotMakeIsNamedWithTheSettingThatMakesIt) {
    EXPECT_TRUE(refused(renderWith({"--show", "back_depth"}), 1, {"back_depth", "thickness_mode=second_layer"}));
    EXPECT_TRUE(quietSuccess(
        render(cubes, {"-o", "a.png", "--show", "back_depth", "--set", "trace_screen.thickness_mode=second_layer"})));
}

TEST_F(WrongUse, AnOutputOfUnknownFormatIsRefused) {
    EXPECT_TRUE(refused(render(cubes, {"-o", "a.jpg"}), usage, {"a.jpg", ".png", ".exr"}));
    EXPECT_TRUE(refused(render(cubes, {"-o", "picture"}), usage, {"picture", ".png", ".exr"}));
}

TEST_F(WrongUse, AnInvalidSizeIsRefused) {
    for (const char* size : {"0x0", "0x10", "10x0", "abc", "10x", "x10", "-1x5", "10x10x10", "1e3x5", "4294967297x1"}) {
        EXPECT_TRUE(refused(run({"render", cubes, "-o", "a.png", "--size", size}), usage, {"--size", size, "pixels"}));
    }
}

TEST_F(WrongUse, ASizeBeyondTheDevicesLimitIsReportedWithIt) {
    EXPECT_TRUE(refused(run({"render", cubes, "-o", "a.png", "--size", "4000000000x10"}), usage,
                        {"--size 4000000000x10", "up to"}));
}

TEST_F(WrongUse, NumbersAreChecked) {
    EXPECT_TRUE(refused(renderWith({"--frames", "0"}), usage, {"--frames", "0", "--help"}));
    EXPECT_TRUE(refused(renderWith({"--frames", "few"}), usage, {"--frames", "few", "--help"}));
    EXPECT_TRUE(refused(renderWith({"--seed", "lucky"}), usage, {"--seed", "lucky", "--help"}));
    EXPECT_TRUE(refused(renderWith({"--seed", "-1"}), usage, {"--seed", "-1", "--help"}));
}

TEST_F(WrongUse, AnOptionWithoutItsValueIsNamed) {
    EXPECT_TRUE(refused(render(cubes, {"-o"}), usage, {"--output", "--help"}));
}

TEST_F(WrongUse, AnUnknownDeviceIsReportedWithTheAvailableOnes) {
    const Outcome devices = run({"list", "devices"});
    ASSERT_EQ(devices.status, 0) << devices.err;
    EXPECT_TRUE(refused(renderWith({"--device", "abacus"}), failed, {"'abacus'", "available: 0 '"}));
    EXPECT_TRUE(refused(renderWith({"--device", "99"}), failed, {"'99'", "available: 0 '"}));
}

TEST_F(WrongUse, LeavesNoFiles) {
    EXPECT_EQ(set("diffuse.rays=999").status, usage);
    EXPECT_EQ(renderWith({"--device", "abacus"}).status, failed);
    EXPECT_EQ(renderWith({"--size", "0x0"}).status, usage);
    EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace reflet::wrong_use_test
