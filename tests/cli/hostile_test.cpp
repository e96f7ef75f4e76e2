// Broken or hostile input, and surroundings in which the program cannot work: one line and status 1, never a signal, a
// hang or a file that is left behind.
#include "base/json_text.h"
#include "cli/program.h"
#include "support/sanitizer.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>

namespace reflet::hostile_test {
namespace {

namespace fs = std::filesystem;
constexpr int failed = 1;
constexpr int usage = 2;

class Hostile : public ProgramTest {
protected:
    /// Runs "reflet REST" by a shell that redirects or limits it.
    [[nodiscard]] Outcome shell(const std::string& before, const std::string& rest) const {
        return runOther("sh", {"-c", before + " \"$0\" " + rest, REFLET_PROGRAM});
    }
    [[nodiscard]] Outcome withJson(const char* option, const std::string& json) const {
        write("x.json", json);
        return render("builtin:cubes", {option, "x.json", "--frames", "2", "-o", "a_#.png"});
    }
};

const std::string renderCubes = "render builtin:cubes --preset direct --size 32x18 -o a.png";
const std::string deep = std::string(100000, '[') + std::string(100000, ']');

TEST_F(Hostile, DeeplyNestedJsonIsAnErrorWhereverItIsRead) {
    for (const char* option : {"--settings", "--view-file", "--path"}) {
        for (const std::string& json : {deep, "{\"camera\":" + deep + "}"}) {
            EXPECT_TRUE(refused(withJson(option, json), failed, {"x.json", "nested more than 128"})) << option;
        }
    }
    ASSERT_EQ(render("builtin:cubes", {"--preset", "direct", "--frames", "2", "-o", "b_#.png"}).status, 0);
    const std::vector<std::string> names = files();
    const auto record =
        std::ranges::find_if(names, [](const std::string& n) { return n.ends_with(".json") && n != "x.json"; });
    ASSERT_NE(record, names.end());
    write(*record, "{\"settings\":" + deep + "}");
    EXPECT_TRUE(refused(render("builtin:cubes", {"--preset", "direct", "--frames", "2", "-o", "b_#.png"}), failed,
                        {"nested more than 128"}));
}

TEST_F(Hostile, PipesAndDevicesAreNotReadAsFiles) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo(path("pipe.hdr").c_str(), 0600), 0);
    for (const char* option : {"--settings", "--view-file", "--path"}) {
        for (const char* file : {"pipe", "/dev/zero"}) {
            EXPECT_TRUE(refused(render("builtin:cubes", {option, file, "--frames", "2", "-o", "a_#.png"}), failed,
                                {file, "not a regular file"}))
                << option;
        }
    }
    EXPECT_TRUE(
        refused(render("builtin:cubes", {"--environment", "pipe.hdr", "-o", "a.png"}), failed, {"regular file"}));
    EXPECT_TRUE(refused(render("pipe", {"-o", "a.png"}), failed, {"pipe", "not a file"}));
}

TEST_F(Hostile, APipeThatNothingReadsIsNotWaitedFor) {
    ASSERT_EQ(::mkfifo(path("pipe.png").c_str(), 0600), 0);
    EXPECT_TRUE(refused(render("builtin:cubes", {"-o", "pipe.png"}), failed, {"pipe.png", "nothing reads"}));
    EXPECT_TRUE(refused(run({"reference", "builtin:cubes", "--size", "8x8", "--spp", "1", "-o", "pipe.png"}), failed,
                        {"pipe.png", "nothing reads"}));
}

TEST_F(Hostile, AnOutputThatIsAnInputIsRefusedAndTheInputKept) {
    write("a.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"name": "empty"}]})");
    write("x.json", "{}");
    writePng(path("a.png"), {2, 2, 3, std::vector<uint8_t>(12, 10)});
    fs::create_symlink("a.gltf", path("link.json"));
    const std::string scene = read("a.gltf");
    const std::string picture = read("a.png");
    for (const char* target : {"a.gltf", "./a.gltf", "link.json", "x.json"}) {
        EXPECT_TRUE(refused(render("a.gltf", {"--settings", "x.json", "--timings", target}), usage,
                            {target, "would replace an input"}));
        EXPECT_TRUE(refused(run({"bench", "builtin:cubes", "a.gltf", "--view-file", "x.json", "--json", target}), usage,
                            {target, "would replace an input"}));
    }
    EXPECT_TRUE(refused(run({"compare", "a.png", "a.png", "--heatmap", "a.png"}), usage, {"would replace an input"}));
    EXPECT_TRUE(
        refused(run({"compare", "a_#.png", "b_#.png", "--heatmap", "a_#.png"}), usage, {"would replace an input"}));
    EXPECT_EQ(read("a.gltf"), scene);
    EXPECT_EQ(read("a.png"), picture);
    EXPECT_EQ(read("x.json"), "{}");
}

TEST_F(Hostile, AnOutputThatIsAFileOfTheSceneIsRefused) {
    const std::string texel("texel of no format");
    fs::create_directory(path("s"));
    write("s/a.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "%62.json", "byteLength": 2}],
        "images": [{"uri": "../x.png"}, {"uri": "map_01.png"}], "scenes": [{"nodes": [0]}], "nodes": [{"name": "n"}]})");
    write("s/b.json", "{}");
    write("s/map_01.png", texel);
    for (const char* target : {"s/map_01.png", "s/../s/map_01.png", "s/map_##.png"}) {
        EXPECT_TRUE(
            refused(render("s/a.gltf", {"-o", target}), usage, {target, "would replace an input", "map_01.png"}))
            << target;
    }
    EXPECT_TRUE(refused(run({"bench", "builtin:cubes", "s/a.gltf", "--json", "s/b.json"}), usage, {"would replace"}));
    writePng(path("a_1.png"), {2, 2, 3, std::vector<uint8_t>(12, 10)});
    EXPECT_TRUE(refused(run({"compare", "a_#.png", "a_#.png", "--heatmap", "a_1.png"}), usage, {"would replace"}));
    EXPECT_EQ(read("s/map_01.png"), texel);
    EXPECT_EQ(read("s/b.json"), "{}");
}

// Only in the name of a sequence's frames does # stand for digits.
TEST_F(Hostile, AFileMayHaveAnyNumberOfHashesInItsName) {
    write("#1#.json", "{}");
    for (const char* written : {"first", "once more, over its own output"}) {
        EXPECT_TRUE(quietSuccess(
            render("builtin:cubes", {"--preset", "direct", "--settings", "#1#.json", "--timings", "a#b#.json"})))
            << written;
        EXPECT_EQ(files(), (std::vector<std::string>{"#1#.json", "a#b#.json"})) << written;
        EXPECT_TRUE(parseJson(read("a#b#.json")).at("passes").contains("direct")) << written;
    }
}

TEST_F(Hostile, TwoOutputsOfOneNameAreRefused) {
    EXPECT_TRUE(refused(render("builtin:cubes", {"-o", "a.png", "--timings", "./a.png"}), usage, {"two outputs"}));
    EXPECT_TRUE(files().empty());
    // Frame 10 has one name in both.
    EXPECT_TRUE(
        refused(render("builtin:cubes", {"--frames", "2", "--first-frame", "9", "-o", "a_#.png", "-o", "a_##.png"}),
                usage, {"two outputs"}));
    EXPECT_TRUE(files().empty());
    fs::create_symlink("a.exr", path("link.exr"));
    EXPECT_TRUE(refused(render("builtin:cubes", {"-o", "a.exr", "-o", "link.exr"}), usage, {"two outputs"}));
}

TEST_F(Hostile, AListOfNamesFromAFileIsShort) {
    FloatImage image{1, 1, {}, {}};
    for (int i = 0; i < 500; ++i) {
        image.channels.push_back("channel" + std::to_string(i));
        image.data.push_back(1.0F);
    }
    writeExr(path("a.exr"), std::vector<ImageLayer>{{"", image}});
    const Outcome compared = run({"compare", "a.exr", "a.exr"});
    EXPECT_TRUE(refused(compared, failed, {"channel0, ", "and 480 more"}));
}

TEST_F(Hostile, NamesOfFilesDoNotCommandTheTerminal) {
    write("c1.gltf", triangleAnd(R"("nodes": [{"mesh": 0, "camera": 0, "name": "\u009b31m\u202e\u2028"}], "cameras": [{
        "type": "perspective", "perspective": {"yfov": 1, "znear": 1}, "name": "\u009b31m\u202e\u2028"}])"));
    const Outcome outcome = run({"reference", "c1.gltf", "--camera", "nosuch", "-o", "a.exr"});
    EXPECT_TRUE(refused(outcome, usage, {"'\\x9b31m\\u202e\\u2028'"}));
}

TEST_F(Hostile, WarningsOfAFileAreAtMostTwentyLines) {
    std::string names;
    for (int i = 0; i < 100; ++i) {
        names += (i == 0 ? "\"E" : ", \"E") + std::to_string(i) + "\"";
    }
    write("many.gltf", triangleAnd("\"nodes\": [{\"mesh\": 0}], \"extensionsUsed\": [" + names + "]"));
    const Outcome outcome = run({"reference", "many.gltf", "--camera", "nosuch", "-o", "a.exr"});
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 21) << outcome.err;  // and the error
    EXPECT_NE(outcome.err.find("more warnings of other kinds"), std::string::npos) << outcome.err;
}

TEST_F(Hostile, ADriversManifestThatIsNoJsonIsNamed) {
    write("bad.json", "{");
    EXPECT_TRUE(
        refused(shell("VK_DRIVER_FILES=bad.json VK_ICD_FILENAMES=bad.json", "list devices"), failed, {"bad.json"}));
}

TEST_F(Hostile, ComparingTakesNoMoreMemoryThanTheLimit) {
    writePng(path("a.png"), {1000, 100, 3, std::vector<uint8_t>(300000, 10)});
    EXPECT_TRUE(refused(run({"compare", "a.png", "a.png"}, {{"REFLET_MEMORY_LIMIT", "0.01"}}), failed,
                        {"a.png: to compare 1000 x 100 pixels takes", "REFLET_MEMORY_LIMIT"}));
    EXPECT_EQ(run({"compare", "a.png", "a.png"}).status, 0);
}

TEST_F(Hostile, AClosedOrFullStandardErrorStopsNothing) {
    for (const char* redirection : {" 2>&-", " 2>/dev/full", " 2>&- >&- <&-"}) {
        const Outcome drawn = shell("", renderCubes + " --environment sky" + redirection);
        EXPECT_EQ(drawn.status, 0) << redirection;
        EXPECT_GT(readBitmap(path("a.png")).width, 0U) << redirection;
        EXPECT_EQ(files(), std::vector<std::string>{"a.png"}) << redirection;
        fs::remove(path("a.png"));
        EXPECT_EQ(shell("", "render nowhere.gltf -o a.png" + std::string(redirection)).status, failed) << redirection;
        EXPECT_EQ(shell("", "render --nonsense" + std::string(redirection)).status, usage) << redirection;
        EXPECT_TRUE(files().empty()) << redirection;  // nothing was written to a file that became standard error
    }
}

TEST_F(Hostile, AWarningToAClosedStandardErrorStopsNothing) {
    write("a.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": ["NO_such"], "scenes": [{"nodes": [0]}],
                        "nodes": [{"mesh": 0}],
                        "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"}],
                        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})");
    EXPECT_EQ(shell("", "render a.gltf --preset direct --size 32x18 -o a.png 2>/dev/full").status, 0);
    EXPECT_TRUE(fs::exists(path("a.png")));
}

TEST_F(Hostile, AClosedStandardOutputIsAFailureNotASignal) {
    const Outcome closed = runOther("sh", {"-c", "{ \"$0\" list settings; echo $? >&2; } | true", REFLET_PROGRAM});
    EXPECT_TRUE(closed.err.ends_with("\n1\n") || closed.err == "0\n") << closed.err;  // 0: all fitted into the pipe
    EXPECT_EQ(shell("", "list settings >/dev/full").status, failed);
}

TEST_F(Hostile, AFullStandardOutputIsAFailure) {
    for (const char* rest : {"--version >/dev/full", "--help >/dev/full", "list scenes >/dev/full"}) {
        EXPECT_TRUE(refused(shell("", rest), failed, {"cannot write to standard output"})) << rest;
    }
}

TEST_F(Hostile, AFileSizeLimitIsAFailureAndLeavesNothing) {
    const Outcome limited = shell("ulimit -f 1;", "render builtin:cubes --preset plain --size 320x180 -o a.png");
    EXPECT_TRUE(refused(limited, failed, {"a.png: cannot be written", "too large"}));
    EXPECT_TRUE(files().empty());
}

TEST_F(Hostile, ALimitOfCpuTimeIsAFailureAndLeavesNothing) {
    const Outcome limited = shell("ulimit -t 2;", "reference builtin:cubes --spp 100000 -o a.png");
    EXPECT_TRUE(refused(limited, failed, {"ulimit -t"}));
    EXPECT_TRUE(files().empty());
}

TEST_F(Hostile, ALimitOfProcessesIsAFailureThatSaysHowToRaiseIt) {  // a software driver waited for ever
    if (::geteuid() != 0 || !isInstalled("setpriv") || !isInstalled("bash")) {
        GTEST_SKIP() << "needs root and setpriv, because the limit does not bind root, and others may have processes";
    }
    fs::permissions(path(""), fs::perms::all);
    const auto limited = [&](const std::string& rest) {
        return runOther("setpriv", {"--reuid=65534", "--regid=65534", "--clear-groups", "bash", "-c",
                                    "ulimit -u 1; exec \"$0\" " + rest, REFLET_PROGRAM});
    };
    if (limited("--version").status != 0) {
        GTEST_SKIP() << "the program cannot be run by another user, or with sanitizers";
    }
    EXPECT_TRUE(refused(limited("reference builtin:cubes --size 8x8 --spp 1 -o a.exr"), failed, {"ulimit -u"}));
    EXPECT_TRUE(refused(limited("render builtin:cubes --preset direct --size 8x8 -o a.png"), failed, {"ulimit -u"}));
    EXPECT_TRUE(files().empty());
}

TEST_F(Hostile, ACrashPrintsOneLineAndEndsWithStatusOne) {
    if (test::addressSanitizer) {
        GTEST_SKIP() << "AddressSanitizer reports crashes itself";
    }
    rlimit cores{};
    ::getrlimit(RLIMIT_CORE, &cores);
    const rlimit none{0, cores.rlim_max};
    ::setrlimit(RLIMIT_CORE, &none);  // inherited; with core files, crashes stay signals
    for (const int signal : {SIGSEGV, SIGABRT}) {
        const Outcome crashed = interrupt({"reference", "builtin:cubes", "--spp", "100000", "-o", "a.png"}, {signal});
        EXPECT_TRUE(refused(crashed, failed, {"internal error", "crashed"})) << signal;
        EXPECT_TRUE(files().empty());
    }
    ::setrlimit(RLIMIT_CORE, &cores);
}

TEST_F(Hostile, AStackThatIsTooSmallSaysHowToRaiseIt) {
    if (test::anySanitizer) {
        GTEST_SKIP() << "the sanitizer itself needs more";
    }
    // With 16 KiB the system may end the program before it begins: arguments and environment are there, too.
    const Outcome small = shell("ulimit -c 0; ulimit -s 24;", "reference builtin:cubes --size 8x8 --spp 1 -o a.png");
    EXPECT_TRUE(small.status == 0 || refused(small, failed, {"raise ulimit -s"})) << small.status << small.err;
}

TEST_F(Hostile, AFolderNamedLikeAFrameIsInTheWay) {
    fs::create_directory(path("a_1.png"));
    EXPECT_TRUE(refused(render("builtin:cubes", {"--preset", "direct", "--frames", "2", "-o", "a_#.png"}), failed,
                        {"a_1.png", "folder"}));
    EXPECT_TRUE(fs::exists(path("a_0.png")));
}

TEST_F(Hostile, ATextureThatChangesMakesASequenceAnotherOne) {
    writePng(path("t.png"), {2, 2, 3, std::vector<uint8_t>(12, 10)});
    write("a.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                        "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"}],
                        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                        "images": [{"uri": "t.png"}, {"uri": "../../../../../../../etc/passwd"}, {"uri": "pipe"}]})");
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    const Arguments sequence{"--preset", "direct", "--frames", "2", "-o", "a_#.png"};
    ASSERT_EQ(render("a.gltf", sequence).status, 0);
    EXPECT_EQ(render("a.gltf", sequence).status, 0);
    writePng(path("t.png"), {2, 2, 3, std::vector<uint8_t>(12, 20)});
    const Outcome other = render("a.gltf", sequence);
    EXPECT_EQ(other.status, failed);
    EXPECT_NE(other.err.find("scene_fingerprint was"), std::string::npos) << other.err;
}

TEST_F(Hostile, ErrorLinesQuoteOnlyTheBeginningOfLongTexts) {
    const std::string name(300000, 'k');
    for (const std::string& json : {"{\"" + name + "\": {}}", "{\"diffuse\": {\"" + name + "\": 1}}",
                                    "{\"diffuse\": {\"rays\": \"" + name + "\"}}", "{\"diffuse\": \"" + name + "\"}"}) {
        const Outcome wrong = withJson("--settings", json);
        EXPECT_TRUE(refused(wrong, failed, {"x.json"}));
        EXPECT_LT(wrong.err.size(), 8100U);
    }
}

TEST_F(Hostile, ReferencesOfSceneThatAreTooFarSayWhatIs) {
    write("far.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"mesh": 0, "name": "moon", "translation": [1e18, 0, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    const Outcome far =
        run({"reference", "far.gltf", "--spp", "1", "--size", "32x18", "--environment", "sky", "-o", "a.png"});
    EXPECT_TRUE(refused(far, failed, {"instance 1 'moon'", "1e+09 m"}));
    EXPECT_EQ(render("far.gltf", {"--preset", "direct", "-o", "a.png"}).status, 0);
}

TEST_F(Hostile, ReferencesFromTooFarAwaySeeNothing) {  // Embree ends the program at such rays
    write("far.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [1e19, 0, 0]}, {"camera": 1, "translation": [0, 0, 5]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}},
                    {"type": "orthographic", "orthographic": {"xmag": 1e38, "ymag": 1e38, "znear": 0, "zfar": 9}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    for (const char* camera : {"0", "1"}) {
        const Outcome far = run({"reference", "far.gltf", "--camera", camera, "--spp", "1", "--size", "8x8",
                                 "--environment", "sky", "-o", "a.png"});
        EXPECT_EQ(far.status, 0) << far.err;
    }
}

// Over 5 s: three processes that measure a scene.
TEST_F(Hostile, ATruthCacheThatIsBrokenIsMadeAnew) {
    const Arguments bench{"bench",         "builtin:cubes",
                          "--size",        "32x18",
                          "--first",       "1",
                          "--warmup",      "1",
                          "--frames",      "1",
                          "--truth-cache", "cache",
                          "--preset",      "direct",
                          "--truth-spp",   "2",
                          "--json",        "out.json",
                          "--no-bandwidth"};
    const Outcome first = run(bench);
    ASSERT_EQ(first.status, 0) << first.err;
    for (const auto& entry : fs::directory_iterator(path("cache"))) {
        if (entry.path().extension() == ".json") {
            write(entry.path().string(), "{\"samples\": \"many\"}");
        }
    }
    const Outcome again = run(bench);
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_NE(again.err.find("this cached ground truth will be made anew"), std::string::npos) << again.err;
    EXPECT_EQ(run(bench).err.find("anew"), std::string::npos);
}

}  // namespace
}  // namespace reflet::hostile_test
