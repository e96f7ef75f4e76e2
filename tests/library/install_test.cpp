// The library as others get it: installed, moved elsewhere, found by CMake and pkg-config, or as a part of their
// project.
#include "support/sanitizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

namespace reflet::test {
namespace {

namespace fs = std::filesystem;

struct Ran {
    int status = 0;
    std::string said;
};

Ran run(const std::string& command) {
    Ran ran;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    std::array<char, 4096> buffer{};
    while (const size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
        ran.said.append(buffer.data(), count);
    }
    ran.status = WEXITSTATUS(pclose(pipe));
    return ran;
}

void expectRuns(const std::string& command) {
    const Ran ran = run(command);
    ASSERT_EQ(ran.status, 0) << command << '\n' << ran.said;
}

class Install : public ::testing::Test {
protected:
    Install() : folder_(fs::temp_directory_path() / ("reflet-install-" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~Install() override { fs::remove_all(folder_); }

    void SetUp() override {
        if (anySanitizer) {
            GTEST_SKIP()
                << "programs outside of the build are linked without the sanitizer that the library then needs";
        }
    }

    [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
    void write(const std::string& name, const std::string& text) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << text;
    }
    // To one place, and then moved to another.
    void install() const {
        expectRuns(std::string("cmake --install " REFLET_BUILD " --prefix ") + at("first"));
        fs::rename(at("first"), at("prefix"));
    }
    [[nodiscard]] std::string configure(const std::string& source, const std::string& build) const {
        return "cmake -S " + source + " -B " + at(build) +
               " -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=" + at("prefix") +
               " -DCMAKE_C_FLAGS='-Wall -Wextra -Wpedantic -Werror'";
    }

    fs::path folder_;
};

constexpr const char* validation =
    "VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_"
    "VALIDATION_EXT,VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT ";

// A program under validation has nothing to say.
void expectSilent(const Ran& ran) {
    ASSERT_EQ(ran.status, 0) << ran.said;
    // Advice of newer layers that cannot be followed: LocalSizeId needs a feature that hosts need not enable, and what
    // a host does before and after is not known.
    std::istringstream lines(ran.said);
    for (std::string line; std::getline(lines, line);) {
        const bool advice = line.find("BestPractices-SpirvDeprecated_WorkgroupSize") != std::string::npos ||
                            line.find("BestPractices-pipeline-stage-flags2-compute") != std::string::npos;
        EXPECT_TRUE(advice || (line.find("alidation ") == std::string::npos && line.find("VUID") == std::string::npos &&
                               line.find("UNASSIGNED") == std::string::npos && line.find("SYNC-") == std::string::npos))
            << line;
    }
    EXPECT_NE(ran.said.find("written: "), std::string::npos) << ran.said;
}

// An example's picture of 128x72 pixels.
class RoomPicture {
public:
    explicit RoomPicture(const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        bytes_.assign((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        EXPECT_GT(bytes_.size(), 128U * 72U * 3U) << path;
        bytes_.resize(std::max<size_t>(bytes_.size(), size_t(128) * 72 * 3));
    }
    [[nodiscard]] std::array<uint8_t, 3> pixel(size_t x, size_t y) const {
        const size_t i = bytes_.size() - 3 * (128 * 72 - (128 * y + x));
        return {uint8_t(bytes_[i]), uint8_t(bytes_[i + 1]), uint8_t(bytes_[i + 2])};
    }
    void expectRoom() const {
        const auto wall = pixel(10, 30);
        EXPECT_GT(wall[0], 2 * wall[1]) << "the left wall is red";
        const auto mirror = pixel(80, 22);
        EXPECT_GT(int(mirror[2]), 80) << "the mirror reflects the sky";
        const auto shadow = pixel(97, 60);  // lit by the sky and the walls alone
        EXPECT_GT(int(shadow[2]), 30);
        const auto floor = pixel(50, 60);
        EXPECT_GT(int(floor[0]), int(shadow[0]) + 30) << "in the sun";
    }

private:
    std::string bytes_;
};

// Over 5 s: builds a program and runs it under validation.
TEST_F(Install, TheExampleInCFindsItAndRendersThePicture) {
    install();
    expectRuns(configure(REFLET_SOURCE "/examples/c", "c"));
    expectRuns("cmake --build " + at("c"));
    expectSilent(run(validation + at("c/reflet_c_example") + " " + at("room.ppm") + " 128 72 4"));
    RoomPicture(at("room.ppm")).expectRoom();
}

// Over 5 s: builds programs and runs them under validation.
TEST_F(Install, HostsOfRenderPassesAndOfTwoEyesRenderThePicture) {
    install();
    for (const char* name : {"renderpass", "stereo"}) {
        expectRuns(configure(REFLET_SOURCE "/examples/" + std::string(name), name));
        expectRuns("cmake --build " + at(name));
        const std::string program = at(name) + "/reflet_" + name + "_example ";
        expectSilent(run(validation + program + at(name) + ".ppm 128 72 14"));  // of three sizes
    }
    RoomPicture(at("renderpass.ppm")).expectRoom();
    const RoomPicture left(at("stereo.ppm-left.ppm"));
    const RoomPicture right(at("stereo.ppm-right.ppm"));
    left.expectRoom();
    EXPECT_GT(right.pixel(10, 30)[0], 2 * right.pixel(10, 30)[1]) << "the left wall is red";
    int differs = 0;
    for (size_t i = 0; i < size_t(128) * 72; ++i) {
        differs += left.pixel(i % 128, i / 128) != right.pixel(i % 128, i / 128) ? 1 : 0;
    }
    EXPECT_GT(differs, 128 * 72 / 2) << "eyes apart";
}

TEST_F(Install, TheOtherExamplesBuild) {
    install();
    for (const char* name : {"denoise", "raytraced", "window"}) {
        expectRuns(configure(REFLET_SOURCE "/examples/" + std::string(name), name));
        expectRuns("cmake --build " + at(name));
    }
}

TEST_F(Install, PkgConfigKnowsIt) {
    install();
    write("use.c",
          "#include <reflet/reflet.h>\nint main(void) { return refletVersion() == REFLET_VERSION ? 0 : 1; }\n");
    const std::string path = "PKG_CONFIG_PATH=$(dirname $(find " + at("prefix") + " -name reflet.pc)) ";
    expectRuns("cd " + folder_.string() + " && cc use.c -std=c11 -Wall -Werror $(" + path +
               "pkg-config --static --cflags --libs reflet) -o use && LD_LIBRARY_PATH=$(dirname $(find " +
               at("prefix") + " -name 'libreflet.*' | head -1)) ./use");
    const Ran version = run(path + "pkg-config --modversion reflet");
    EXPECT_EQ(version.said, "0.2.0\n");
}

TEST_F(Install, TheProgramComesWithManualCompletionAndDesktopData) {
    install();
    const std::string share = at("prefix") + "/share/";
    for (const char* file : {"man/man1/reflet.1.gz", "bash-completion/completions/reflet",
                             "zsh/vendor-completions/_reflet", "fish/vendor_completions.d/reflet.fish",
                             "applications/org.reflet.Reflet.desktop", "metainfo/org.reflet.Reflet.metainfo.xml",
                             "icons/hicolor/scalable/apps/org.reflet.Reflet.svg", "doc/reflet/copyright"}) {
        EXPECT_TRUE(fs::exists(share + file) && fs::file_size(share + file) > 0) << file;
    }
    EXPECT_NE(run("gzip -dc " + share + "man/man1/reflet.1.gz").said.find(".TH REFLET 1"), std::string::npos);
    expectRuns("bash -n " + share + "bash-completion/completions/reflet");
    if (run("command -v desktop-file-validate").status == 0) {
        expectRuns("desktop-file-validate " + share + "applications/org.reflet.Reflet.desktop");
    }
    if (run("command -v appstreamcli").status == 0) {
        expectRuns("appstreamcli validate --no-net " + share + "metainfo/org.reflet.Reflet.metainfo.xml");
    }
}

TEST_F(Install, AnotherMinorVersionIsRefused) {
    install();
    write("use/CMakeLists.txt",
          "cmake_minimum_required(VERSION 3.22)\nproject(use C CXX)\nfind_package(reflet 0.9 CONFIG REQUIRED)\n");
    const Ran ran = run(configure(at("use"), "used"));
    EXPECT_NE(ran.status, 0);
    EXPECT_NE(ran.said.find("0.2.0"), std::string::npos) << ran.said;
}

// Over 5 s: CMake looks at compilers and libraries.
// Before CMake fails in words of its own.
TEST_F(Install, AFolderWithANameThatCMakeCannotHandleIsNamedFirst) {
    for (const std::string name : {"a#b", "a[b]", "a\"b", "a;b"}) {
        fs::create_directories(folder_ / name);
        fs::copy_file(fs::path(REFLET_SOURCE) / "CMakeLists.txt", folder_ / name / "CMakeLists.txt");
        const Ran ran = run("cd '" + at(name) + "' && cmake -S . -B build");
        EXPECT_NE(ran.status, 0);
        EXPECT_NE(ran.said.find("move or rename it"), std::string::npos) << ran.said;
    }
}

// The first block of CMake in the guide.
std::string guidesFetchContent() {
    std::ifstream file(REFLET_SOURCE "/docs/library.md");
    const std::string guide{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const std::string open = "```cmake\n";
    const size_t start = guide.find(open) + open.size();
    return guide.substr(start, guide.find("```", start) - start);
}

// The sources are here: nothing is fetched.
TEST_F(Install, IsAPartOfAnotherProject) {
    write("host/CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.22)
project(host C CXX)
add_executable(host main.c)
)" + guidesFetchContent() + R"(
foreach(property INTERFACE_COMPILE_OPTIONS INTERFACE_LINK_OPTIONS)
    get_target_property(value reflet::reflet ${property})
    if(value)
        message(FATAL_ERROR "${property}: ${value}")
    endif()
endforeach()
foreach(target reflet_program reflet_scene unit_tests)
    if(TARGET ${target})
        message(FATAL_ERROR "${target}")
    endif()
endforeach()
if(CMAKE_BUILD_TYPE)
    message(FATAL_ERROR "${CMAKE_BUILD_TYPE}")
endif()
)");
    write("host/main.c", "#include <reflet/reflet.h>\nint main(void) { return 0; }\n");
    expectRuns("cmake -S " + at("host") + " -B " + at("built") +
               " -G Ninja -DREFLET_EXAMPLES=ON -DFETCHCONTENT_SOURCE_DIR_REFLET=" REFLET_SOURCE);
    EXPECT_NE(run("ninja -C " + at("built") + " -t targets all").said.find("reflet_window_example: phony"),
              std::string::npos);
}

// Without the indentation, which differs inside of functions.
std::string withoutIndentation(const std::string& path) {
    std::ifstream file(path);
    std::string text;
    for (std::string line; std::getline(file, line);) {
        const size_t start = line.find_first_not_of(' ');
        text += (start == std::string::npos ? "" : line.substr(start)) + '\n';
    }
    return text;
}

TEST(LibraryGuide, ShowsCodeOfTheExample) {
    const std::string guide = withoutIndentation(REFLET_SOURCE "/docs/library.md");
    const std::string example = withoutIndentation(REFLET_SOURCE "/examples/c/main.c");
    size_t blocks = 0;
    const std::string open = "```c\n";
    for (size_t at = guide.find(open); at != std::string::npos; at = guide.find(open, at + 1), ++blocks) {
        const size_t start = at + open.size();
        const std::string code = guide.substr(start, guide.find("```", start) - start);
        EXPECT_NE(example.find(code), std::string::npos) << code;
    }
    EXPECT_GE(blocks, 7U);
}

TEST(Exports, AreThoseOfTheHeader) {
    const Ran symbols = run("nm -D --defined-only " REFLET_EXPORTS " | awk '{print $NF}'");
    const Ran declared = run("grep -oE 'reflet[A-Za-z]+\\(' " REFLET_SOURCE "/include/reflet/reflet.h | tr -d '('");
    const auto lines = [](const std::string& text) {
        std::set<std::string> all;
        for (size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos; start = end + 1) {
            all.insert(text.substr(start, text.find_first_of("@\n", start) - start));
        }
        return all;
    };
    EXPECT_GT(lines(declared.said).size(), 20U);
    EXPECT_EQ(lines(symbols.said), lines(declared.said));
    const Ran soname = run("objdump -p " REFLET_EXPORTS " | grep SONAME");
    EXPECT_NE(soname.said.find(".so.0\n"), std::string::npos) << soname.said;
    const Ran needed = run("objdump -p " REFLET_EXPORTS " | grep NEEDED");
    EXPECT_EQ(needed.said.find("fmt"), std::string::npos) << needed.said;
    EXPECT_EQ(needed.said.find("spirv"), std::string::npos) << needed.said;
    EXPECT_EQ(needed.said.find("vulkan"), std::string::npos) << needed.said;
}

}  // namespace
}  // namespace reflet::test
