// Readers of input files with too little memory: each allocation fails in turn. The reader must throw Error or
// std::bad_alloc, leak nothing, and read the file when it is tried again.
#include "fault/allocations.h"

#include "base/error.h"
#include "base/image_file.h"
#include "base/json.h"
#include "base/json_text.h"
#include "fault/effort.h"
#include "renderer/presets.h"
#include "renderer/settings.h"
#include "scene/camera_path.h"
#include "scene/environment.h"
#include "scene/gltf/gltf.h"
#include "scene/view_file.h"
#include "support/sanitizer.h"
#include "unit/gltf_encoders.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace reflet::fault {
namespace {

namespace fs = std::filesystem;
using Read = std::function<void()>;

struct Ends {
    uint64_t done = 0;
    uint64_t errors = 0;
    uint64_t badAllocs = 0;
    uint64_t terminated = 0;
};

/// What libraries do that a reader cannot mend.
struct Allowed {
    bool leaks = false;
    bool otherReasons = false;  ///< errors that do not name memory
};

// One attempt; the text is empty if it ended as it should.
std::string attempt(const Read& read, Allocator allocator, uint64_t number, bool always, Ends& ends, Allowed allowed) {
    std::optional<test::UncheckedLeaks> unchecked;
    if (allowed.leaks) {
        unchecked.emplace();
    }
    const FailingAllocation failing(allocator, number, always);
    try {
        read();
        FailingAllocation::stop();
        ++ends.done;
    } catch (const Error& error) {
        FailingAllocation::stop();
        ++ends.errors;
        if (!allowed.otherReasons && std::string_view(error.what()).find("memory") == std::string_view::npos) {
            return std::string("another error: ") + error.what();
        }
    } catch (const std::bad_alloc&) {
        FailingAllocation::stop();
        ++ends.badAllocs;
    } catch (const std::exception& error) {
        FailingAllocation::stop();
        return std::string("another exception: ") + error.what();
    }
    const int64_t leaked = allowed.leaks ? 0 : FailingAllocation::live();
    return leaked > 0 ? std::to_string(leaked) + " allocations leaked" : "";
}

/// What is swept.
struct Reader {
    const char* name;
    Read read;
    uint64_t most = 0;  ///< numbers of allocations that are tried, spread over all; 0: each
    /// nlohmann-json leaks elements if memory runs out while it parses, and its destructor allocates: if that fails it
    /// ends the process (the program then says so, see cli/last_resort.h). Each attempt has a process of its own.
    bool json = false;
    bool onlyByNew = false;  ///< stb_image_write and libwebp end the process if malloc fails
    Allowed allowed{};
};

// In a process of its own, which std::terminate may end for lack of memory.
std::string attemptApart(const Read& read, Allocator allocator, uint64_t number, Ends& ends) {
    constexpr int terminated = 42;
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(20 * test::slowness);
        std::set_terminate([] { ::_exit(terminated); });
        Ends own;
        const std::string wrong = attempt(read, allocator, number, false, own, {true, allocator == Allocator::malloc});
        std::fputs(wrong.c_str(), stderr);
        std::fflush(stderr);
        ::_exit(!wrong.empty() ? 1 : own.done > 0 ? 10 : own.errors > 0 ? 11 : 12);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ends.done += code == 10 ? 1 : 0;
    ends.errors += code == 11 ? 1 : 0;
    ends.badAllocs += code == 12 ? 1 : 0;
    ends.terminated += code == terminated ? 1 : 0;
    return (code >= 10 && code <= 12) || code == terminated ? "" : "status " + std::to_string(code);
}

// Constructors of OpenEXR leak if they throw, and its threads only say that they failed; stb_image_write leaks.
constexpr Allowed thirdParty{.leaks = true, .otherReasons = true};

void failEach(const Reader& reader, Allocator allocator, bool always) {
    Ends ends;
    ASSERT_EQ(attempt(reader.read, allocator, 0, false, ends, {true, false}), "") << reader.name;
    const uint64_t count = FailingAllocation::count();
    const uint64_t stride = testsAll() || reader.most == 0 ? 1 : std::max<uint64_t>(count / reader.most, 1);
    Allowed allowed = reader.allowed;
    allowed.otherReasons |= allocator == Allocator::malloc;  // decoders that malloc fails in take the file for broken
    const char* kind = allocator == Allocator::malloc ? "malloc" : "new";
    ends = {};
    for (uint64_t number = 1; number <= count; number += stride) {
        const std::string wrong = reader.json ? attemptApart(reader.read, allocator, number, ends)
                                              : attempt(reader.read, allocator, number, always, ends, allowed);
        EXPECT_EQ(wrong, "") << reader.name << ", allocation " << number << " of " << count << " by " << kind
                             << (always ? " and all later ones" : "");
    }
    if (testsAll()) {
        std::printf("%-12s %-6s %-4s %6d allocations: %d Error, %d bad_alloc, %d terminated, %d went on\n", reader.name,
                    kind, always ? "all" : "one", int(count), int(ends.errors), int(ends.badAllocs),
                    int(ends.terminated), int(ends.done));
    }
    EXPECT_EQ(attempt(reader.read, allocator, 0, false, ends, {true, false}), "") << reader.name;
}

void failEach(const Reader& reader) {
    reader.read();  // makes what is kept for the process
    for (const Allocator allocator : {Allocator::operatorNew, Allocator::malloc}) {
        for (const bool always : {false, true}) {
            if ((!always || !reader.json) && (allocator == Allocator::operatorNew || !reader.onlyByNew)) {
                failEach(reader, allocator, always);
            }
        }
    }
}

fs::path fileOf(const char* name, const std::string& content) {
    const fs::path file = test::testFolder() / name;
    test::writeBytes(file, content);
    return file;
}

TEST(FailingAllocations, GltfIsReadOrRefused) {
    const fs::path all = fileOf("everything.gltf", test::everything().gltfBytes());
    failEach({.name = "gltf", .read = [&] { (void)loadGltf(all, {.strict = true}); }, .most = 60, .json = true});
    const fs::path packed = fileOf("compressed.glb", test::compressed().glbBytes());
    failEach({.name = "glb",
              .read = [&] { (void)loadGltf(packed, {.strict = true}); },
              .most = 60,
              .json = true,
              .onlyByNew = true});
}

TEST(FailingAllocations, ImagesAreReadOrRefused) {
    const fs::path folder = test::testFolder();
    writePng(folder / "a.png", {4, 3, 4, std::vector<uint8_t>(48, 77)});
    failEach({.name = "png", .read = [&] { (void)readBitmap(folder / "a.png"); }});
    writeExr(folder / "a.exr", std::vector<ImageLayer>{{"", {4, 3, {"R", "G", "B"}, std::vector<float>(36, 0.5F)}}});
    failEach({.name = "exr",
              .read = [&] { (void)readEnvironmentImage(folder / "a.exr"); },
              .most = 100,
              .allowed = thirdParty});
    const fs::path hdr =
        fileOf("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x81\x80\x40\x20\x81");
    failEach({.name = "hdr", .read = [&] { (void)readEnvironmentImage(hdr); }});
}

TEST(FailingAllocations, ImagesAreWrittenOrNot) {
    const fs::path folder = test::testFolder();
    const Bitmap bitmap{4, 3, 4, std::vector<uint8_t>(48, 77)};
    failEach({.name = "write png",
              .read = [&] { writePng(folder / "a.png", bitmap); },
              .onlyByNew = true,
              .allowed = thirdParty});
    const std::vector<ImageLayer> layers{{"", {4, 3, {"R", "G", "B"}, std::vector<float>(36, 0.5F)}}};
    failEach(
        {.name = "write exr", .read = [&] { writeExr(folder / "a.exr", layers); }, .most = 100, .allowed = thirdParty});
    const auto files = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
    EXPECT_EQ(files, 2);
    EXPECT_EQ(readBitmap(folder / "a.png").data, bitmap.data);
    EXPECT_EQ(readExr(folder / "a.exr").front().image.data, layers.front().image.data);
}

TEST(FailingAllocations, JsonFilesAreReadOrRefused) {
    View view;
    view.lampRadius = 0.1F;
    const fs::path views = fileOf("view.json", jsonText(viewJson(view), 2));
    const Read readView = [&] {
        View read;
        applyViewFile(views, read);
    };
    failEach({.name = "view file", .read = readView, .most = 60, .json = true});
    const fs::path path = fileOf("path.json", R"({"keyframes": [
        {"time": 0, "position": [0, 0, 5], "target": [0, 0, 0]},
        {"time": 1, "position": [5, 0, 0], "target": [0, 0, 0], "fov_y": 30}], "loop": false})");
    failEach({.name = "camera path", .read = [&] { (void)loadCameraPath(path, Camera{}); }, .most = 60, .json = true});
    Settings preset;
    applyPreset(preset, "quality");
    const fs::path settings = fileOf("settings.json", jsonText(settingsJson(preset, Settings{}), 2));
    const Read readSettings = [&] {
        Settings read;
        applySettingsJson(read, parseJsonFile(settings), settings.string());
    };
    failEach({.name = "settings", .read = readSettings, .most = 60, .json = true});
}

}  // namespace
}  // namespace reflet::fault
