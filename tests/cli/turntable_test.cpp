// Films: `reflet turntable`, sequences as films; contact sheets; --quiet and --json.
#include "base/json.h"
#include "cli/program.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace reflet::turntable_test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class Films : public ProgramTest {
protected:
    [[nodiscard]] Outcome turntable(const Arguments& more, const Variables& added = {}) const {
        Arguments all{"turntable", "builtin:cubes", "--size", "32x24", "--effort", "draft", "--preset", "plain"};
        all.insert(all.end(), more.begin(), more.end());
        return run(all, added);
    }
    /// Milliseconds of each frame of a WebP animation and its number of loops, from the chunks of the file (RFC 9649).
    struct Animation {
        std::vector<int> milliseconds;
        int loops = -1;
        uint32_t width = 0;
        uint32_t height = 0;
    };
    [[nodiscard]] Animation animation(const std::string& file) const {
        const std::string bytes = read(file);
        const auto at = [&](size_t i, int count) {
            uint32_t value = 0;
            for (int k = count; k-- > 0;) {
                value = value << 8U | static_cast<unsigned char>(bytes.at(i + static_cast<size_t>(k)));
            }
            return value;
        };
        Animation found;
        EXPECT_EQ(bytes.substr(0, 4) + bytes.substr(8, 4), "RIFFWEBP");
        EXPECT_EQ(at(4, 4) + 8, bytes.size());
        for (size_t i = 12; i + 8 <= bytes.size(); i += 8 + at(i + 4, 4) + at(i + 4, 4) % 2) {
            const std::string chunk = bytes.substr(i, 4);
            if (chunk == "ANIM") {
                found.loops = static_cast<int>(at(i + 12, 2));
            } else if (chunk == "ANMF") {
                found.milliseconds.push_back(static_cast<int>(at(i + 20, 3)));
            } else if (chunk == "VP8X") {
                found.width = at(i + 12, 3) + 1;
                found.height = at(i + 15, 3) + 1;
            }
        }
        return found;
    }
};

// Over 5 s: its processes each have their shaders compiled by the driver.
TEST_F(Films, ATurntableIsAWebpThatLoopsAndResumesWithTheSameBytes) {
    const Arguments film{"--seconds", "0.5", "--fps", "8", "-o", "a.webp"};
    ASSERT_TRUE(quietSuccess(turntable(film)));
    EXPECT_EQ(files(), (Names{"a.webp"})) << "frames are removed";
    const Animation whole = animation("a.webp");
    EXPECT_EQ(whole.milliseconds, (std::vector<int>{125, 125, 125, 125}));
    EXPECT_EQ(whole.loops, 0) << "forever";
    EXPECT_EQ(whole.width, 32U);
    EXPECT_EQ(whole.height, 24U);
    const std::string bytes = read("a.webp");
    fs::remove(path("a.webp"));
    const Outcome killed = killWhen({"turntable", "builtin:cubes", "--size", "32x24", "--effort", "draft", "--preset",
                                     "plain", "--seconds", "0.5", "--fps", "8", "-o", "a.webp"},
                                    [&] { return fs::exists(path("a.webp.frames/frame_000001.png")); });
    EXPECT_GT(killed.status, 128) << "it ended too early";
    Arguments again = film;
    again.insert(again.end(), {"--json"});
    const Outcome resumed = turntable(again);
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_LT(parseJson(resumed.out).at("rendered"), 4);
    EXPECT_EQ(parseJson(resumed.out).at("outputs"), nlohmann::json({"a.webp"}));
    EXPECT_EQ(read("a.webp"), bytes);
}

TEST_F(Films, FramesOfATurntableAreStillsOfTheirDirection) {
    ASSERT_TRUE(quietSuccess(turntable({"--orbit", "0,20,5", "--look-at", "0,0.5,0", "--seconds", "1", "--fps", "4",
                                        "--share", "2/4", "-o", "f_#.png", "--light", "scene"})));
    EXPECT_EQ(files(), (Names{"f_#.png.sequence.json", "f_1.png"}));
    const Bitmap frame = readBitmap(path("f_1.png"));
    const auto differenceTo = [&](const std::string& azimuth) {
        EXPECT_TRUE(quietSuccess(run({"render", "builtin:cubes", "--size", "32x24", "--preset", "plain", "--orbit",
                                      azimuth + ",20,5", "--look-at", "0,0.5,0", "-o", "still.png"})));
        const Bitmap still = readBitmap(path("still.png"));
        double sum = 0.0;
        for (size_t i = 0; i < frame.data.size(); ++i) {
            sum += std::abs(int(frame.data[i]) - int(still.data[i]));
        }
        return sum;
    };
    EXPECT_LT(differenceTo("90"), 0.6 * differenceTo("-90")) << "but for noise";
    const Outcome rests = turntable({"--animate", "-o", "g_#.png"});
    EXPECT_NE(rests.err.find("--animate: the scene has no animation"), std::string::npos) << rests.err;
}

TEST_F(Films, OtherFormatsAreMadeByFfmpegOrRefusedBeforeTheWork) {
    const Arguments film{"--seconds", "0.5", "--fps", "4", "-o", "a.mp4"};
    EXPECT_TRUE(refused(turntable(film, {{"PATH", "/nowhere"}}), 2, {"ffmpeg", ".webp"}));
    EXPECT_TRUE(files().empty());
    // In place of ffmpeg: what it is asked for goes into the film.
    fs::create_directory(path("bin"));
    write("bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last\"\n");
    fs::permissions(path("bin/ffmpeg"), fs::perms::owner_all);
    const Variables found{{"PATH", path("bin").string() + ":/usr/bin:/bin"}};
    ASSERT_TRUE(quietSuccess(turntable(film, found)));
    const std::string asked = read("a.mp4");
    for (const char* word :
         {"-framerate 4 ", "-start_number 0 ", "a.mp4.frames/frame_%06d.png", "-frames:v 2 ", "libx264"}) {
        EXPECT_NE(asked.find(word), std::string::npos) << word << ": " << asked;
    }
    EXPECT_FALSE(fs::exists(path("a.mp4.frames")));
    write("bin/ffmpeg", "#!/bin/sh\nexit 7\n");
    fs::permissions(path("bin/ffmpeg"), fs::perms::owner_all);
    EXPECT_EQ(turntable(film, found).status, 1);
    EXPECT_TRUE(fs::exists(path("a.mp4.frames/frame_000001.png"))) << "frames stay";
}

TEST_F(Films, ASequenceIsAFilmOnceAllSharesAreThere) {
    const auto share = [&](const std::string& which) {
        return render("builtin:cubes", {"--frames", "2", "--path", "orbit", "--share", which, "-o", "b.webp"});
    };
    const Outcome first = share("1/2");
    EXPECT_EQ(first.status, 0);
    EXPECT_NE(first.err.find("1 of 2 frames are missing"), std::string::npos) << first.err;
    EXPECT_FALSE(fs::exists(path("b.webp")));
    EXPECT_TRUE(quietSuccess(share("2/2")));
    EXPECT_EQ(animation("b.webp").milliseconds.size(), 2U);
    EXPECT_TRUE(refused(render("builtin:cubes", {"-o", "c.webp"}), 2, {"--frames", "turntable"}));
    EXPECT_EQ(files(), (Names{"b.webp"}));
}

TEST_F(Films, AContactSheetHasAllPicturesAndTheirNames) {
    ASSERT_TRUE(quietSuccess(render("builtin:cubes", {"-o", "a.png", "-o", "b.exr", "--aov", "depth"})));
    const Outcome made = run({"contact-sheet", "a.png", "b.exr", "b.exr:depth", "-o", "sheet.png", "--cell", "40x30",
                              "--columns", "2", "--gap", "8", "--json"});
    ASSERT_EQ(made.status, 0) << made.err;
    const Bitmap sheet = readBitmap(path("sheet.png"));
    EXPECT_EQ(parseJson(made.out).at("size"), (nlohmann::json{sheet.width, sheet.height}));
    EXPECT_EQ(sheet.width, 8U + 2 * 48U);
    EXPECT_GE(sheet.height, 8U + 2 * 38U);
    const Bitmap a = readBitmap(path("a.png"));  // 32x18, in the middle of the first cell
    const size_t corner = (size_t(8 + 6) * sheet.width + 8 + 4) * 3;
    const uint32_t channels = a.channels;
    for (size_t x = 0; x < a.width; ++x) {
        ASSERT_EQ(sheet.data[corner + 3 * x + 1], a.data[channels * x + 1]) << x;
    }
    EXPECT_TRUE(refused(run({"contact-sheet", "a.png", "-o", "a.png"}), 2, {"a.png", "would replace an input"}));
    EXPECT_TRUE(refused(run({"contact-sheet", "a.tga", "-o", "s.png"}), 2, {"a.tga"}));
}

TEST_F(Films, ScriptsGetJsonOrSilence) {
    write("dark.gltf", triangleAnd(R"("nodes": [{"mesh": 0}])"));
    const Outcome noted = render("dark.gltf", {"-o", "a.png"});
    EXPECT_NE(noted.err.find("note:"), std::string::npos) << noted.err;
    const Outcome quiet = render("dark.gltf", {"-o", "a.png", "--quiet", "--json", "--save-view", "v.json"});
    EXPECT_TRUE(quietSuccess(quiet));
    EXPECT_EQ(parseJson(quiet.out).at("outputs"), nlohmann::json({"a.png"}));
    ASSERT_TRUE(fs::exists(path("v.json")));
    EXPECT_EQ(render("dark.gltf", {"-o", "b.png", "--view-file", "v.json"}).status, 0);
    EXPECT_EQ(read("a.png"), read("b.png")) << "the saved view gives the same picture";
}

}  // namespace
}  // namespace reflet::turntable_test
