// Readers of input files with too little memory: each allocation fails in turn. The reader must throw Error or
// std::bad_alloc, leak nothing, and read the file when it is tried again.
#include "fault/allocations.h"

#include "base/error.h"
#include "base/image_file.h"
#include "base/json.h"
#include "base/json_text.h"
#include "fault/sweep.h"
#include "renderer/presets.h"
#include "renderer/settings.h"
#include "scene/camera_path.h"
#include "scene/environment.h"
#include "scene/gltf/gltf.h"
#include "scene/view_file.h"
#include "unit/gltf_encoders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace reflet::fault {
namespace {

namespace fs = std::filesystem;
using Read = std::function<void()>;

struct Ends {
    uint64_t done = 0;
    uint64_t errors = 0;
    uint64_t badAllocs = 0;
};

// One attempt; the text is empty if it ended as it should.
std::string attempt(const Read& read, Allocator allocator, uint64_t number, bool always, Ends& ends) {
    std::string wrong;
    {
        const FailingAllocation failing(allocator, number, always);
        try {
            read();
            FailingAllocation::stop();
            ++ends.done;
        } catch (const Error& error) {
            FailingAllocation::stop();
            ++ends.errors;
            if (std::string(error.what()).find("memory") == std::string::npos) {
                wrong = std::string("another error: ") + error.what();
            }
        } catch (const std::bad_alloc&) {
            FailingAllocation::stop();
            ++ends.badAllocs;
        } catch (const std::exception& error) {
            FailingAllocation::stop();
            wrong = std::string("another exception: ") + error.what();
        }
    }
    if (wrong.empty() && FailingAllocation::live() > 0) {
        wrong = std::to_string(FailingAllocation::live()) + " allocations leaked";
    }
    return wrong;
}

// most: numbers that are tried, spread over all; 0: each.
void failEach(const char* name, const Read& read, uint64_t most) {
    read();  // makes what is kept for the process
    for (const Allocator allocator : {Allocator::operatorNew, Allocator::malloc}) {
        Ends none;
        ASSERT_EQ(attempt(read, allocator, 0, false, none), "");
        const uint64_t count = FailingAllocation::count();
        if (count == 0) {
            continue;  // malloc cannot be replaced
        }
        const uint64_t stride = testsAll() || most == 0 ? 1 : std::max<uint64_t>(count / most, 1);
        for (const bool always : {false, true}) {
            Ends ends;
            for (uint64_t number = 1; number <= count; number += stride) {
                const std::string wrong = attempt(read, allocator, number, always, ends);
                ASSERT_EQ(wrong, "") << name << ", allocation " << number << " of " << count
                                     << (allocator == Allocator::malloc ? " by malloc" : " by new")
                                     << (always ? " and all later ones" : "");
            }
            if (testsAll()) {
                std::printf("%-12s %-6s %-7s %6d allocations: %d Error, %d bad_alloc, %d went on\n", name,
                            allocator == Allocator::malloc ? "malloc" : "new", always ? "all" : "one", int(count),
                            int(ends.errors), int(ends.badAllocs), int(ends.done));
            }
        }
        EXPECT_EQ(attempt(read, allocator, 0, false, none), "");
    }
}

fs::path fileOf(const char* name, const std::string& content) {
    const fs::path file = test::testFolder() / name;
    test::writeBytes(file, content);
    return file;
}

TEST(FailingAllocations, GltfIsReadOrRefused) {
    const fs::path all = test::everything().writeGltf(test::testFolder() / "everything.gltf");
    failEach(
        "gltf", [&] { (void)loadGltf(all, {.strict = true}); }, 60);
    const fs::path packed = fileOf("compressed.glb", test::compressed().glbBytes());
    failEach(
        "glb", [&] { (void)loadGltf(packed, {.strict = true}); }, 60);
}

TEST(FailingAllocations, ImagesAreReadOrRefused) {
    const fs::path folder = test::testFolder();
    writePng(folder / "a.png", {4, 3, 4, std::vector<uint8_t>(48, 77)});
    failEach(
        "png", [&] { (void)readBitmap(folder / "a.png"); }, 0);
    writeExr(folder / "a.exr", std::vector<ImageLayer>{{"", {4, 3, {"R", "G", "B"}, std::vector<float>(36, 0.5F)}}});
    failEach(
        "exr", [&] { (void)readEnvironmentImage(folder / "a.exr"); }, 100);
    const fs::path hdr =
        fileOf("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x81\x80\x40\x20\x81");
    failEach(
        "hdr", [&] { (void)readEnvironmentImage(hdr); }, 0);
}

TEST(FailingAllocations, ImagesAreWrittenOrNot) {
    const fs::path folder = test::testFolder();
    const Bitmap bitmap{4, 3, 4, std::vector<uint8_t>(48, 77)};
    failEach(
        "write png", [&] { writePng(folder / "a.png", bitmap); }, 0);
    const std::vector<ImageLayer> layers{{"", {4, 3, {"R", "G", "B"}, std::vector<float>(36, 0.5F)}}};
    failEach(
        "write exr", [&] { writeExr(folder / "a.exr", layers); }, 100);
    const auto files = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
    EXPECT_EQ(files, 2);
    EXPECT_EQ(readBitmap(folder / "a.png").data, bitmap.data);
    EXPECT_EQ(readExr(folder / "a.exr").front().image.data, layers.front().image.data);
}

TEST(FailingAllocations, JsonFilesAreReadOrRefused) {
    View view;
    view.lampRadius = 0.1F;
    view.probes = {Probe{}};
    const fs::path views = fileOf("view.json", jsonText(viewJson(view), 2));
    failEach(
        "view file",
        [&] {
            View read;
            applyViewFile(views, read);
        },
        200);
    const fs::path path = fileOf("path.json", R"({"keyframes": [
        {"time": 0, "position": [0, 0, 5], "target": [0, 0, 0]},
        {"time": 1, "position": [5, 0, 0], "target": [0, 0, 0], "fov_y": 30}], "loop": false})");
    failEach(
        "camera path", [&] { (void)loadCameraPath(path, Camera{}); }, 200);
    Settings preset;
    applyPreset(preset, "quality");
    const fs::path settings = fileOf("settings.json", jsonText(settingsJson(preset, Settings{}), 2));
    failEach(
        "settings",
        [&] {
            Settings read;
            applySettingsJson(read, parseJsonFile(settings), settings.string());
        },
        200);
}

}  // namespace
}  // namespace reflet::fault
