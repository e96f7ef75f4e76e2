// Runs the built program by posix_spawn, with its output in files, because pipes could fill up and block.
#include "cli/program.h"

#include "base/error.h"
#include "base/file.h"
#include "support/sanitizer.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

namespace reflet {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::seconds limit(120 * test::slowness);  // reached only if the program hangs
constexpr std::chrono::milliseconds pause(2);
constexpr int killed = 128;

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    std::ranges::transform(texts, std::back_inserter(result), [](std::string& text) { return text.data(); });
    result.push_back(nullptr);
    return result;
}

std::vector<std::string> environment(const Variables& added) {
    std::vector<std::string> result;
    for (char** variable = ::environ; *variable != nullptr; ++variable) {
        const std::string text = *variable;
        if (!added.contains(text.substr(0, text.find('=')))) {
            result.push_back(text);
        }
    }
    std::ranges::transform(added, std::back_inserter(result),
                           [](const auto& variable) { return variable.first + "=" + variable.second; });
    return result;
}

int waitFor(pid_t child) {
    const auto end = std::chrono::steady_clock::now() + limit;
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        if (std::chrono::steady_clock::now() > end) {
            ::kill(child, SIGKILL);
            ::waitpid(child, &status, 0);
            break;
        }
        std::this_thread::sleep_for(pause);
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : killed + WTERMSIG(status);
}

struct Places {
    fs::path folder;
    fs::path out;
    fs::path err;
};

pid_t start(const std::string& program, const Arguments& arguments, const Variables& added, const Places& places) {
    Arguments all{program};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<std::string> variables = environment(added);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, places.folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, places.out.c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, places.err.c_str(), flags, 0600);
    pid_t child = 0;
    const int error =
        ::posix_spawnp(&child, program.c_str(), &actions, nullptr, pointers(all).data(), pointers(variables).data());
    posix_spawn_file_actions_destroy(&actions);
    REFLET_CHECK(error == 0, "{} cannot be started", program);
    return child;
}

/// Whether the process has a handler for the signal, according to the kernel.
bool catches(pid_t process, int signal) {
    std::ifstream file(fmt::format("/proc/{}/status", process));
    const std::string name = "SigCgt:";
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with(name)) {
            return (std::stoull(line.substr(name.size()), nullptr, 16) >> (signal - 1) & 1U) != 0;
        }
    }
    return false;
}

/// Waits for the condition; false if the process ends or the time limit is reached first.
bool waitUntil(pid_t process, const std::function<bool()>& reached) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!reached()) {
        siginfo_t ended{};
        if (::waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
            ended.si_pid != 0 || std::chrono::steady_clock::now() > end) {
            return false;
        }
        std::this_thread::sleep_for(pause);
    }
    return true;
}

fs::path makeFolder() {
    std::string name = (fs::temp_directory_path() / "reflet-cli-XXXXXX").string();
    REFLET_CHECK(::mkdtemp(name.data()) != nullptr, "{} cannot be made", name);
    return name;
}

}  // namespace

ProcessUse useOf(int process) {
    const fs::path folder = fs::path("/proc") / std::to_string(process);
    ProcessUse use;
    std::ifstream file(folder / "status");
    for (std::string word; file >> word;) {
        if (word == "VmRSS:") {
            file >> use.residentMiB;
            use.residentMiB /= 1024.0;
        } else if (word == "Threads:") {
            file >> use.threads;
        }
    }
    std::error_code ended;
    for (auto i = fs::directory_iterator(folder / "fd", ended); i != fs::directory_iterator(); i.increment(ended)) {
        ++use.files;
    }
    return use;
}

std::ostream& operator<<(std::ostream& to, const ProcessUse& use) {
    return to << use.residentMiB << " MiB resident, " << use.files << " files, " << use.threads << " threads";
}

double cpuSeconds(int process) {
    clockid_t clock = 0;
    timespec time{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0) {
        return 0.0;
    }
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool isInstalled(std::string_view program) {
    const char* variable = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): tests have one thread
    std::istringstream folders(variable == nullptr ? "" : variable);
    for (std::string folder; std::getline(folders, folder, ':');) {
        std::error_code ignored;
        if (fs::exists(fs::path(folder) / program, ignored)) {
            return true;
        }
    }
    return false;
}

ProgramTest::ProgramTest() : folder_(makeFolder()), said_(makeFolder()) {}

ProgramTest::~ProgramTest() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    fs::remove_all(said_, ignored);
}

Outcome ProgramTest::run(const Arguments& arguments, const Variables& added, const fs::path& out) const {
    const Places places{folder_, out.empty() ? said_ / "out" : out, said_ / "err"};
    const int status = waitFor(start(REFLET_PROGRAM, arguments, added, places));
    return {status, out.empty() ? readFile(said_ / "out") : "", readFile(said_ / "err")};
}

Outcome ProgramTest::runOther(const std::string& program, const Arguments& arguments, const Variables& added) const {
    const int status = waitFor(start(program, arguments, added, {folder_, said_ / "out", said_ / "err"}));
    return {status, readFile(said_ / "out"), readFile(said_ / "err")};
}

Outcome ProgramTest::interrupt(const Arguments& arguments, const std::vector<int>& signals, double work) const {
    const pid_t child = start(REFLET_PROGRAM, arguments, {}, {folder_, said_ / "out", said_ / "err"});
    const int first = signals.front();
    EXPECT_TRUE(waitUntil(child, [&] { return catches(child, first) && cpuSeconds(child) >= work * test::slowness; }));
    ::kill(child, first);
    for (size_t i = 1; i < signals.size(); ++i) {
        // The handler resets itself (SA_RESETHAND).
        EXPECT_TRUE(waitUntil(child, [&] { return !catches(child, signals[i - 1]); }));
        ::kill(child, signals[i]);
    }
    const int status = waitFor(child);
    return {status, readFile(said_ / "out"), readFile(said_ / "err")};
}

int ProgramTest::begin(const Arguments& arguments, const Variables& added) const {
    const fs::path own = said_ / std::to_string(begun_.size());  // several may run at once
    fs::create_directory(own);
    const int process = start(REFLET_PROGRAM, arguments, added, {folder_, own / "out", own / "err"});
    begun_[process] = own;
    return process;
}

Outcome ProgramTest::finish(int process) const {
    const int status = waitFor(process);
    const fs::path& own = begun_.at(process);
    return {status, readFile(own / "out"), readFile(own / "err")};
}

Outcome ProgramTest::killWhen(const Arguments& arguments, const std::function<bool()>& reached) const {
    const pid_t child = start(REFLET_PROGRAM, arguments, {}, {folder_, said_ / "out", said_ / "err"});
    if (waitUntil(child, reached)) {
        ::kill(child, SIGKILL);
    }
    const int status = waitFor(child);
    return {status, readFile(said_ / "out"), readFile(said_ / "err")};
}

Outcome ProgramTest::render(const std::string& scene, const Arguments& more, const Variables& added) const {
    Arguments all{"render", scene, "--size", "32x18"};
    if (std::ranges::find(more, "--preset") == more.end()) {
        all.insert(all.end(), {"--preset", "plain"});
    }
    all.insert(all.end(), more.begin(), more.end());
    return run(all, added);
}

void ProgramTest::write(std::string_view file, std::string_view content) const {
    writeFileAtomically(path(file), content);
}

std::string ProgramTest::read(std::string_view file) const {
    return readFile(path(file));
}

std::vector<ImageLayer> ProgramTest::layers(std::string_view file, uint32_t width, uint32_t height) const {
    std::vector<ImageLayer> all = readExr(path(file));
    for (const ImageLayer& layer : all) {
        EXPECT_EQ(layer.image.width, width) << layer.name;
        EXPECT_EQ(layer.image.height, height) << layer.name;
        EXPECT_TRUE(std::ranges::all_of(layer.image.data, [](float v) { return std::isfinite(v); })) << layer.name;
    }
    return all;
}

std::vector<std::string> ProgramTest::files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
        names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    return names;
}

testing::AssertionResult quietSuccess(const Outcome& run) {
    if (run.status == 0 && run.err.empty()) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "status " << run.status << ", said: " << run.err;
}

testing::AssertionResult refused(const Outcome& run, int status, std::initializer_list<std::string_view> words) {
    const auto failure = testing::AssertionFailure() << "status " << run.status << ", said: " << run.err << run.out;
    if (run.status != status || !run.out.empty() || !run.err.starts_with("reflet: ")) {
        return failure;
    }
    if (std::ranges::count(run.err, '\n') != 1 || !run.err.ends_with('\n')) {
        return testing::AssertionFailure() << "not one line: " << run.err;
    }
    for (const std::string_view word : words) {
        if (run.err.find(word) == std::string::npos) {
            return testing::AssertionFailure() << "no '" << word << "' in: " << run.err;
        }
    }
    return testing::AssertionSuccess();
}

std::vector<std::string> firstWords(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (const std::string word = line.substr(0, line.find(' ')); !word.empty()) {
            words.push_back(word);
        }
    }
    return words;
}

float mean(const FloatImage& image) {
    double sum = 0.0;
    for (const float value : image.data) {
        sum += value;
    }
    return static_cast<float>(sum / static_cast<double>(image.data.size()));
}

std::string triangleAnd(const std::string& more) {
    return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3,
        "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "scenes": [{"nodes": [0]}], )" +
           more + "}";
}

}  // namespace reflet
