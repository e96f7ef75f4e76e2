// Runs two programs alternately.
#include "measure/bench/against.h"

#include "base/error.h"
#include "base/json.h"
#include "base/progress.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

namespace reflet {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// Removed by the destructor.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "reflet-bench-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            fail("{}: cannot create a folder there", fs::temp_directory_path().string());
        }
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    TemporaryFolder(TemporaryFolder&&) = delete;
    TemporaryFolder& operator=(TemporaryFolder&&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

// Returns the exit status. Drops standard output, and with `quiet` standard error.
int runProgram(const std::string& program, Words words, bool quiet) {
    words.insert(words.begin(), program);
    std::vector<char*> arguments;
    std::ranges::transform(words, std::back_inserter(arguments), [](std::string& word) { return word.data(); });
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {1, 2}) {
        if (stream == 1 || quiet) {
            posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
        }
    }
    pid_t child = 0;
    const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
        failUsage("--against {}: cannot be run: {}", program, std::generic_category().message(error));
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

nlohmann::json runFor(const std::string& program, const Words& words, const fs::path& file) {
    if (const int status = runProgram(program, words, false); status != 0) {
        fail("{} exited with status {}", program, status);
    }
    return parseJsonFile(file);
}

// Adds the medians of one state of a bench's only run.
void addBench(const nlohmann::json& state, Samples& samples) {
    std::vector<gpu::PassTime> passes;
    if (state.contains("frame_ms")) {
        passes.push_back({"frame", state.at("frame_ms").at("median")});
    }
    for (const auto& [name, pass] : state.at("passes").items()) {
        passes.push_back({name, pass.at("median"), pass.at("bytes"), pass.at("raster")});
    }
    std::optional<Recording> recording;
    if (state.contains("record_ms")) {  // older programs do not tell
        const nlohmann::json& counts = state.at("recorded");
        recording = {state.at("record_ms").at("median"), counts.at("passes"), counts.at("barriers"),
                     counts.at("transient_bytes")};
    }
    if (state.contains("wall_ms")) {
        samples.add(state.at("wall_ms").at("median"), state.at("submitted_ms").at("median"), passes, recording);
    }
}

void addTimings(const nlohmann::json& timings, Samples& samples) {
    std::vector<gpu::PassTime> passes{{"frame", timings.at("frame_ms")}};
    for (const auto& [name, ms] : timings.at("passes").items()) {
        passes.push_back({name, ms});
    }
    samples.add(0.0, 0.0, passes);
}

// One measurement: scene, size and variant.
struct Measurement {
    const AgainstPlan& plan;
    std::string scene;
    uvec2 size;
    Words variant;
};

Words commonWords(const Measurement& measured, const char* command) {
    Words words{command, measured.scene, "--size", fmt::format("{}x{}", measured.size.x, measured.size.y)};
    words.insert(words.end(), measured.variant.begin(), measured.variant.end());
    words.insert(words.end(), measured.plan.shared.begin(), measured.plan.shared.end());
    return words;
}

void benchOnce(const std::string& program, const Measurement& measured, const fs::path& folder, BenchRun& run) {
    const fs::path file = folder / "bench.json";
    Words words = commonWords(measured, "bench");
    const Words more{"--truth",       "none",
                     "--first",       std::to_string(measured.plan.firstFrames),
                     "--warmup",      std::to_string(measured.plan.warmup),
                     "--frames",      std::to_string(measured.plan.frames),
                     "--json",        file.string(),
                     "--no-bandwidth"};
    words.insert(words.end(), more.begin(), more.end());
    const nlohmann::json json = runFor(program, words, file).at("runs").at(0);
    run.settings = json.at("settings");
    run.triangles = json.at("triangles");
    run.memory = json.at("memory_bytes");
    addBench(json.at("first"), run.first.samples);
    addBench(json.at("steady"), run.steady.samples);
}

void renderOnce(const std::string& program, const Measurement& measured, const fs::path& folder, BenchRun& run) {
    const fs::path file = folder / "timings.json";
    if (!measured.variant.empty() && measured.variant.front() != "--preset") {
        failUsage("--against {}: it has no bench, and its render takes no --variant; use --preset and --set",
                  measured.plan.other);
    }
    Words words = commonWords(measured, "render");
    const Words more{"--frames", std::to_string(measured.plan.warmup + measured.plan.frames), "--timings",
                     file.string()};
    words.insert(words.end(), more.begin(), more.end());
    addTimings(runFor(program, words, file), run.steady.samples);
}

}  // namespace

void measureAgainst(const AgainstPlan& plan, BenchResult& result) {
    const TemporaryFolder folder;
    const std::string own = fs::read_symlink("/proc/self/exe").string();
    const bool hasBench = runProgram(plan.other, {"bench", "--help"}, true) == 0;
    Progress progress("run", uint64_t(2) * plan.rounds * plan.scenes.size() * plan.sizes.size() * plan.variants.size());
    for (const std::string& scene : plan.scenes) {
        for (const uvec2& size : plan.sizes) {
            for (const Words& variant : plan.variants) {
                const Measurement measured{plan, scene, size, variant};
                BenchRun runs[2];
                for (uint32_t round = 0; round < plan.rounds; ++round) {
                    for (const bool isOther : {false, true}) {
                        (hasBench ? benchOnce : renderOnce)(isOther ? plan.other : own, measured, folder.path(),
                                                            runs[isOther ? 1 : 0]);
                        progress.advance();
                    }
                }
                result.pairs.push_back({result.runs.size(), result.runs.size() + 1});
                const std::string chosen = variant.empty() ? "" : ", " + variant.back();
                for (BenchRun& run : runs) {
                    run.scene = scene;
                    run.size = size;
                    run.variant = (&run == runs ? "this build" : plan.other) + chosen;
                    result.runs.push_back(std::move(run));
                }
            }
        }
    }
}

}  // namespace reflet
