// Runs the built program in a folder of its own, and captures its output.
#pragma once

#include "base/image_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// Result of a run. The status is above 128 if a signal or the time limit ended it.
struct Outcome {
    int status = 0;
    std::string out;
    std::string err;
};

using Arguments = std::vector<std::string>;
/// Environment variables.
using Variables = std::map<std::string, std::string>;

/// A test in an empty folder, which is the program's working folder and is removed afterwards.
class ProgramTest : public testing::Test {
protected:
    ProgramTest();
    ~ProgramTest() override;

    /// Standard output is captured, or goes to `out`.
    [[nodiscard]] Outcome run(const Arguments& arguments, const Variables& added = {},
                              const std::filesystem::path& out = {}) const;
    /// Another program, searched for in PATH.
    [[nodiscard]] Outcome runOther(const std::string& program, const Arguments& arguments,
                                   const Variables& added = {}) const;
    /// `reflet render SCENE --size 32x18` and more; with preset plain, which keeps no history, unless one is given.
    [[nodiscard]] Outcome render(const std::string& scene, const Arguments& more, const Variables& added = {}) const;

    /// As run(), with `signals` sent to the program: the first one once it has a handler for it and has used `work`
    /// seconds of CPU time, each further one when the previous one has been handled.
    [[nodiscard]] Outcome interrupt(const Arguments& arguments, const std::vector<int>& signals,
                                    double work = 0.0) const;

    /// As run(), but does not wait. Returns the process id, for finish().
    [[nodiscard]] int begin(const Arguments& arguments, const Variables& added = {}) const;
    [[nodiscard]] Outcome finish(int process) const;

    /// As run(), but kills it (SIGKILL) as soon as `reached` returns true, unless it ended before.
    [[nodiscard]] Outcome killWhen(const Arguments& arguments, const std::function<bool()>& reached) const;

    [[nodiscard]] std::filesystem::path path(std::string_view file) const { return folder_ / file; }
    void write(std::string_view file, std::string_view content) const;
    [[nodiscard]] std::string read(std::string_view file) const;
    /// An EXR's layers, each of the expected size and without NaN.
    [[nodiscard]] std::vector<ImageLayer> layers(std::string_view file, uint32_t width = 32,
                                                 uint32_t height = 18) const;
    /// Names of all files in the folder, sorted.
    [[nodiscard]] std::vector<std::string> files() const;

private:
    std::filesystem::path folder_;
    std::filesystem::path said_;                          ///< captured output of runs, outside of the folder
    mutable std::map<int, std::filesystem::path> begun_;  ///< the same of processes that run beside the test
};

/// Whether a program of that name is in PATH.
bool isInstalled(std::string_view program);

/// What a process has. Without memory it has ended.
struct ProcessUse {
    double residentMiB = 0.0;
    size_t files = 0;  ///< open
    size_t threads = 0;
};
ProcessUse useOf(int process);
std::ostream& operator<<(std::ostream& to, const ProcessUse& use);

/// CPU time of a process over all threads, in seconds.
double cpuSeconds(int process);

/// Status 0 and nothing on standard error.
testing::AssertionResult quietSuccess(const Outcome& run);

/// The status, nothing on standard output, and one line "reflet: …" with all of the words on standard error.
testing::AssertionResult refused(const Outcome& run, int status, std::initializer_list<std::string_view> words);

/// The first word of each line, which is the name in a list.
std::vector<std::string> firstWords(const std::string& text);

/// Mean of all values of all channels.
float mean(const FloatImage& image);

/// A glTF file with a triangle as its only mesh, and more properties of the document, such as "nodes".
std::string triangleAnd(const std::string& more);

}  // namespace reflet
