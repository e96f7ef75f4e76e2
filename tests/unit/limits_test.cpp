// Limits on what input files may make the program take, and reading of files that are none.
#include "base/limits.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/json_text.h"
#include "base/message.h"
#include "base/text.h"
#include "gltf_builder.h"
#include "gltf_encoders.h"
#include "scene/gltf/container.h"
#include "scene/gltf/files.h"
#include "unit/message_of.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <array>
#include <cstdlib>

namespace reflet::test::limits_test {
namespace {

namespace fs = std::filesystem;

/// Sets the limit for one test.
class MemoryLimit {
public:
    explicit MemoryLimit(const char* gib) { ::setenv("REFLET_MEMORY_LIMIT", gib, 1); }
    ~MemoryLimit() { ::unsetenv("REFLET_MEMORY_LIMIT"); }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;
    MemoryLimit(MemoryLimit&&) = delete;
    MemoryLimit& operator=(MemoryLimit&&) = delete;
};

bool has(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

/// An empty folder.
fs::path emptyFolder(const char* name) {
    const fs::path folder = testFolder() / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

TEST(Limits, OfMemoryAreEightGibibytesOrWhatTheEnvironmentSays) {
    EXPECT_EQ(memoryLimit(), uint64_t{8} << 30U);
    {
        const MemoryLimit limit("0.5");
        EXPECT_EQ(memoryLimit(), uint64_t{1} << 29U);
    }
    for (const char* text : {"much", "-1", "0", "1e99", "nan", "8 GiB"}) {
        const MemoryLimit limit(text);
        EXPECT_TRUE(has(messageOf([] { (void)memoryLimit(); }), "REFLET_MEMORY_LIMIT must be a number of GiB")) << text;
    }
}

TEST(Limits, AnImageThatTakesAQuarterOfTheMemorySaysHowToAllowIt) {
    EXPECT_EQ(imageExcess(8192, 8192, textureBytesPerPixel), "");
    const std::string excess = imageExcess(16384, 16384, textureBytesPerPixel);
    EXPECT_TRUE(has(excess, "16384 x 16384 pixels")) << excess;
    EXPECT_TRUE(has(excess, "REFLET_MEMORY_LIMIT to 22 ")) << excess;
    EXPECT_LT(excess.size(), 200U) << excess;  // more is cut off
    const MemoryLimit limit("22");
    EXPECT_EQ(imageExcess(16384, 16384, textureBytesPerPixel), "");
    EXPECT_NE(imageExcess(UINT64_MAX, UINT64_MAX, textureBytesPerPixel), "");
}

TEST(Limits, OfAnImageHoldInGltfFilesAndAlone) {
    GltfBuilder b = triangle();
    b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", b.addTexture({1, 2, 3, 255})}}}}}});
    b.document["meshes"][0]["primitives"][0]["material"] = 0;
    const Bitmap picture{512, 512, 3, std::vector<uint8_t>(size_t{512} * 512 * 3)};
    const fs::path folder = emptyFolder("image_limits");
    writePng(folder / "a.png", picture);
    b.document["images"][0] = {{"uri", "a.png"}};
    const fs::path scene = b.writeGltf(folder / "scene.gltf");
    EXPECT_EQ(complaint(scene), "");
    EXPECT_EQ(messageOf([&] { (void)readBitmap(folder / "a.png"); }), "no error");
    const MemoryLimit limit("0.01");
    EXPECT_TRUE(complaint(scene).starts_with("images[0]: takes ")) << complaint(scene);
    EXPECT_TRUE(has(messageOf([&] { (void)readBitmap(folder / "a.png"); }), "REFLET_MEMORY_LIMIT"));
}

TEST(Limits, JsonOfASceneIsChargedBeforeItIsParsed) {
    GltfBuilder b = triangle();
    b.document["extras"] = nlohmann::json::array();
    for (int i = 0; i < 5000; ++i) {
        b.document["extras"].push_back(nlohmann::json::array());
    }
    const fs::path scene = b.writeGltf(emptyFolder("json_limits") / "scene.gltf");
    EXPECT_EQ(complaint(scene), "");
    const MemoryLimit limit("0.001");  // 5000 values are counted as 1.3 MB
    EXPECT_TRUE(complaint(scene).starts_with("JSON: takes the scene past the limit of 0.001 GiB")) << complaint(scene);
}

TEST(Limits, OfJsonAreItsDepthItsValuesAndItsSize) {
    EXPECT_EQ(jsonExcess(std::string(128, '[')), "");
    EXPECT_EQ(jsonExcess(std::string(129, '[')), "is nested more than 128 levels deep");
    EXPECT_EQ(jsonExcess("[\"" + std::string(200, '[') + "\\\"" + std::string(200, '{') + "\"]"), "");
    EXPECT_EQ(jsonExcess("[1,[2],{\"a\":3}]", {.values = 5}), "has more than 5 values");
    EXPECT_EQ(jsonExcess("[1,[2],{\"a\":3}]", {.values = 6}), "");
    for (const char* text : {"[1]", "{\"a\":1}"}) {
        EXPECT_TRUE(has(messageOf([&] { (void)parseJson(text, {.depth = 0}); }), "nested")) << text;
    }
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_TRUE(has(messageOf([&] { (void)parseJson(deep); }), "nested"));
    EXPECT_TRUE(has(messageOf([&] { (void)parseJsonIfValid(deep); }), "nested"));
    EXPECT_TRUE(has(messageOf([&] { (void)parseOrderedJson(deep); }), "nested"));
}

TEST(Limits, AJsonFileThatIsTooLargeIsRefusedBeforeItIsRead) {
    const fs::path file = emptyFolder("large_json") / "a.json";
    writeFileAtomically(file, "{}");
    fs::resize_file(file, uint64_t{1} << 40U);  // takes no space on the disk
    EXPECT_TRUE(has(messageOf([&] { (void)parseJsonFile(file); }), "more than the limit of 64 MiB"));
    fs::remove(file);
}

TEST(Limits, MessagesQuoteOnlyTheBeginningOfLongTexts) {
    EXPECT_EQ(oneLine(std::string(300, 'x')), std::string(80, 'x') + "...");
    const std::string name(1'000'000, 'k');
    const fs::path file = emptyFolder("long_key") / "a.json";
    for (const std::string& text : {"{\"" + name + "\": 1}", "{\"" + name + "\": 1, \"" + name + "\": 2}", "[\"" + name,
                                    "[" + name, "[1" + std::string(100000, '1') + "e999999]"}) {
        writeFileAtomically(file, text);
        const std::string message = messageOf([&] {
            const nlohmann::json json = parseJsonFile(file);
            JsonNode(json, file).requireKeys(std::array<std::string, 1>{"y"});
        });
        EXPECT_LT(message.size(), 800U) << message.substr(0, 1000);
        EXPECT_NE(message, "no error");
    }
    EXPECT_EQ(nearestName(name, std::array<std::string, 1>{"k"}), std::nullopt);
}

TEST(Limits, MessagesListOnlyTheFirstNames) {
    EXPECT_EQ(listed({}), "none");
    std::vector<std::string> names{"a", "b\n", std::string(100, 'c')};
    EXPECT_EQ(listed(names), "a, b\\n, " + std::string(60, 'c') + "...");
    names.assign(20, "x");
    EXPECT_TRUE(listed(names).ends_with(", x"));
    names.assign(1000, "x");
    EXPECT_TRUE(listed(names).ends_with(", x and 980 more"));
}

TEST(RegularFiles, AreAllThatIsRead) {
    const fs::path folder = emptyFolder("no_files");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    for (const fs::path& path : {folder / "pipe", fs::path("/dev/zero")}) {
        EXPECT_EQ(messageOf([&] { (void)readFile(path); }),
                  path.string() + ": cannot be read: it is a pipe or a device, not a regular file");
    }
}

TEST(RegularFiles, OfAnyNameThatTheFileSystemAllowsCanBeWritten) {
    const fs::path folder = emptyFolder("long_name");
    writeFileAtomically(folder / std::string(255, 'n'), "content");
    EXPECT_EQ(readFile(folder / std::string(255, 'n')), "content");
}

TEST(RegularFiles, ThatAreBeingWrittenAreRemovedWhenTheProgramEndsAtOnce) {
    const fs::path folder = emptyFolder("ending");
    {
        const AtomicFile file(folder / "x", AtomicFile::Naming::atOnce);
        EXPECT_FALSE(fs::is_empty(folder));
        removeTemporaryFiles();
        EXPECT_TRUE(fs::is_empty(folder));
    }
    writeFileAtomically(folder / "y", "content");
    removeTemporaryFiles();
    EXPECT_TRUE(fs::exists(folder / "y"));
}

/// All that is visited, one text per file.
std::vector<std::string> visited(const fs::path& scene) {
    std::vector<std::string> files;
    visitGltfFiles(scene, [&](std::span<const uint8_t> bytes) { files.emplace_back(bytes.begin(), bytes.end()); });
    return files;
}

TEST(SceneFiles, AreTheSceneAndAllThatItsImagesName) {
    const fs::path folder = emptyFolder("scene_files");
    writeFileAtomically(folder / "a b.png", "texels");
    GltfBuilder b = triangle();
    b.add("images", {{"uri", "a%20b.png"}});
    const auto glb = visited(b.writeGlb(folder / "scene.glb"));
    ASSERT_EQ(glb.size(), 2U);
    EXPECT_EQ(glb[0], readFile(folder / "scene.glb"));
    EXPECT_EQ(glb[1], "texels");
    EXPECT_EQ(visited(b.writeGltf(folder / "scene.gltf")).back(), "texels");
}

TEST(SceneFiles, OutsideOfTheFolderOrThatAreNoneAreNotOpened) {
    const fs::path folder = emptyFolder("outside");
    writeFileAtomically(folder / "secret", "secret");
    fs::create_directory(folder / "inside");
    ASSERT_EQ(::mkfifo((folder / "inside/pipe").c_str(), 0600), 0);
    fs::create_symlink(folder / "secret", folder / "inside/link");
    fs::create_symlink("/dev/zero", folder / "inside/zero");
    GltfBuilder b = triangle();
    for (const char* uri : {"../secret", "%2e%2e/secret", "link", "zero", "pipe", "/etc/passwd", "gone.png"}) {
        b.add("images", {{"uri", uri}});
    }
    b.add("images", {{"uri", 5}});
    b.add("images", 7);
    const auto files = visited(b.writeGltf(folder / "inside/scene.gltf"));
    ASSERT_EQ(files.size(), 8U);  // the last two have no URI
    for (size_t i = 1; i < files.size(); ++i) {
        EXPECT_TRUE(has(files[i], "leads out of") || has(files[i], "is not a file") ||
                    has(files[i], "there is no file"))
            << i << files[i].substr(0, 100);
    }
}

// As if the file or a folder on the way to it had become a link after the loader looked.
TEST(SceneFiles, ALinkThatAppearsAfterTheCheckIsNotFollowed) {
    const fs::path folder = fs::canonical(emptyFolder("swapped"));
    fs::create_directories(folder / "inside/textures");
    writeFileAtomically(folder / "inside/textures/a.png", "texels");
    writeFileAtomically(folder / "a.png", "secret");
    fs::create_symlink("../a.png", folder / "inside/link");
    fs::create_symlink("..", folder / "inside/up");
    const fs::path inside = folder / "inside";
    const GltfReport report("scene.gltf", nullptr);
    const auto read = [&](const char* name) { return readFileBytes(inside / name, 6, "images[0]", report, inside); };
    EXPECT_EQ(read("textures/a.png").size(), 6U);
    EXPECT_THROW((void)read("link"), Error);
    EXPECT_THROW((void)read("up/a.png"), Error);
}

}  // namespace
}  // namespace reflet::test::limits_test
