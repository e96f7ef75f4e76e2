// Runs the parts of a qualification.
#include "measure/qualify/qualify.h"

#include "base/error.h"
#include "base/progress.h"
#include "capture/spread.h"
#include "job/scene_options.h"
#include "measure/bench/truth.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

namespace reflet {

namespace {

constexpr const char* timedScene = "cave";
constexpr const char* steadyScene = "moving";
constexpr const char* referenceName = "reference";

BenchScene builtin(const std::string& name) {
    SceneOptions options;
    options.scene = "builtin:" + name;
    BenchScene scene{options.scene, loadScene(options), {}, 0};
    scene.view = loadView(options, scene.scene);
    return scene;
}

Settings settingsOf(const std::string& preset) {
    SceneOptions options;
    options.preset = preset;
    return loadSettings(options);
}

LuminanceGrid gridOf(const FloatImage& image) {
    LuminanceGrid grid(size_t{gridSize.x} * gridSize.y, 0.0F);
    const uvec2 cell(image.width / gridSize.x, image.height / gridSize.y);
    const size_t channels = image.channels.size();
    const float share = 1.0F / static_cast<float>(cell.x * cell.y);
    for (uint32_t y = 0; y < cell.y * gridSize.y; ++y) {
        for (uint32_t x = 0; x < cell.x * gridSize.x; ++x) {
            const float* c = &image.data[channels * (size_t{y} * image.width + x)];
            const float luminance = 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2];
            grid[size_t{y / cell.y} * gridSize.x + x / cell.x] += share * luminance;
        }
    }
    return grid;
}

LuminanceGrid referenceOf(gpu::Device& device, const BenchScene& scene) {
    TruthOptions options;
    options.reference.samples = 1024;
    options.folder = standardTruthFolder();
    return gridOf(getTruth(device, scene, qualifySize, {}, options).layers.at("final"));
}

// Against what is stored.
void judge(QualifiedPicture& picture, const std::map<std::string, LuminanceGrid>& stored) {
    const auto known = stored.find(picture.scene + " " + picture.preset);
    const auto reference = stored.find(picture.scene + " " + referenceName);
    if (!picture.finite || known == stored.end()) {
        return;
    }
    picture.difference = differenceOf(picture.grid, known->second);
    if (reference != stored.end()) {
        picture.error = differenceOf(picture.grid, reference->second).mean;
        picture.storedError = differenceOf(known->second, reference->second).mean;
    }
}

}  // namespace

GridDifference differenceOf(const LuminanceGrid& grid, const LuminanceGrid& stored) {
    REFLET_CHECK(grid.size() == stored.size(), "{} cells, not {}", grid.size(), stored.size());
    double mean = 0.0;
    for (const float cell : stored) {
        mean += cell / static_cast<double>(stored.size());
    }
    GridDifference difference;
    for (size_t i = 0; i < grid.size(); ++i) {
        const double base = std::max({double{stored[i]}, 0.1 * mean, 1e-6});
        const double one = std::abs(double{grid[i]} - stored[i]) / base;
        difference.mean += one / static_cast<double>(grid.size());
        difference.worst = std::max(difference.worst, one);
    }
    return difference;
}

bool QualifiedPicture::passes() const {
    return finite &&
           (!difference || (difference->mean <= gridTolerance.mean && difference->worst <= gridTolerance.worst));
}

bool Qualification::passes() const {
    return messages.empty() && stability.passes() && std::ranges::all_of(pictures, &QualifiedPicture::passes);
}

void qualifyPictures(const QualifyPlan& plan, gpu::Device& device, Qualification& to) {
    const std::map<std::string, LuminanceGrid> stored = storedGrids();
    Progress progress("pictures: picture", plan.scenes.size() * plan.presets.size());
    for (const std::string& name : plan.scenes) {
        const BenchScene scene = builtin(name);
        for (const std::string& preset : plan.presets) {
            Subject subject(device, scene, qualifySize, settingsOf(preset));
            for (uint32_t i = 1; i < qualifyFrames; ++i) {
                subject.render();
            }
            const FloatImage image = subject.picture({"final"}).at("final");
            QualifiedPicture& picture = to.pictures.emplace_back();
            picture.scene = name;
            picture.preset = preset;
            picture.grid = gridOf(image);
            picture.finite = std::ranges::all_of(image.data, [](float v) { return std::isfinite(v); });
            judge(picture, stored);
            progress.advance();
        }
        if (plan.references) {
            to.references[name] = referenceOf(device, scene);
        }
    }
}

void qualifyTimes(const QualifyPlan& plan, gpu::Device& device, Qualification& to) {
    to.timedSize = plan.timedSize;
    to.timedScene = timedScene;
    const BenchScene scene = builtin(timedScene);
    Progress progress("times: preset", plan.presets.size());
    for (const std::string& preset : plan.presets) {
        Subject subject(device, scene, plan.timedSize, settingsOf(preset));
        for (uint32_t i = 0; i < plan.timedFrames / 2; ++i) {
            subject.render();
        }
        Samples samples;
        for (uint32_t i = 0; i < plan.timedFrames; ++i) {
            subject.render(samples);
        }
        QualifiedTimes& times = to.times.emplace_back();
        times.preset = preset;
        times.memory = subject.memory();
        for (const Series& series : samples.series()) {
            const double median = spreadOf(series.ms).median;
            if (series.kind == SeriesKind::pass) {
                times.passMs[series.name] = median;
            } else if (series.kind == SeriesKind::total && series.name == "frame") {
                times.frameMs = median;
            }
        }
        progress.advance();
    }
}

// The same frames again and again: whatever differs between rounds, or grows, is a fault.
void qualifyStability(const QualifyPlan& plan, gpu::Device& device, Qualification& to) {
    constexpr uint32_t framesPerRound = 6;
    const BenchScene scene = builtin(steadyScene);
    Subject subject(device, scene, qualifySize, settingsOf("balanced"));
    const auto round = [&] {
        subject.forgetHistory();
        for (uint32_t i = 1; i < framesPerRound; ++i) {
            subject.render();
        }
        return subject.picture({"final"}).at("final").data;
    };
    const auto memory = [&] {
        device.runNow([](VkCommandBuffer) {});
        return device.memory().used(gpu::MemoryUse::device);
    };
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const std::vector<float> first = round();
    Stability& stability = to.stability;
    stability.rounds = 1;
    stability.memoryBegin = memory();
    do {
        const std::vector<float> now = round();
        const bool same = std::ranges::equal(
            now, first, [](float a, float b) { return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b); });
        stability.differing += same ? 0 : 1;
        ++stability.rounds;
    } while (elapsed() < plan.seconds);
    stability.frames = stability.rounds * framesPerRound;
    stability.memoryEnd = memory();
    stability.seconds = elapsed();
}

}  // namespace reflet
