// A renderer that runs for long while scene, size, settings and time change: the same state gives the same bytes, and
// neither memory nor handles grow. REFLET_LONG_RUN: how many frames, and then of all scenes and settings below.
#include "capture/show.h"
#include "device/device.h"
#include "fault/faults.h"
#include "renderer/presets.h"
#include "renderer/renderer.h"
#include "renderer/settings.h"
#include "renderer/shaders.h"
#include "scene/builtin.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <random>

namespace reflet::fault {
namespace {

struct State {
    size_t scene = 0;
    size_t size = 0;
    size_t settings = 0;
};

/// What the process has once every state was shown and no renderer is left.
struct Holdings {
    std::string alive;  ///< Vulkan objects
    VkDeviceSize reserved = 0;
    size_t files = 0;
    size_t threads = 0;
    double residentMiB = 0.0;
};

constexpr std::array<uvec2, 3> sizes{{{64, 36}, {50, 40}, {33, 61}}};

size_t entries(const char* folder) {
    return static_cast<size_t>(std::ranges::distance(std::filesystem::directory_iterator(folder)));
}

double residentMiB() {
    std::ifstream file("/proc/self/statm");
    size_t pages = 0;
    file >> pages >> pages;
    return static_cast<double>(pages) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1048576.0;
}

Settings settingsOf(const char* preset, const std::vector<std::string>& assignments) {
    Settings settings;
    applyPreset(settings, preset);
    settings.probes.resolution = 16;  // large ones take most of the time
    for (const std::string& assignment : assignments) {
        setSetting(settings, assignment);
    }
    return settings;
}

class LongRun : public testing::Test {
protected:
    LongRun() {
        // NOLINTBEGIN(concurrency-mt-unsafe): one thread
        const char* asked = std::getenv("REFLET_LONG_RUN");
        frames_ = asked == nullptr ? 0 : std::strtoull(asked, nullptr, 10);
        ::setenv("VK_INSTANCE_LAYERS", "VK_LAYER_REFLET_fault", 1);
        ::setenv("VK_LAYER_PATH", REFLET_FAULT_LAYER_FOLDER, 1);
        gpu::DeviceOptions options;
        options.shaders = {effectShaders(), rendererShaders()};
        device_.emplace(options);
        ::unsetenv("VK_INSTANCE_LAYERS");
        ::unsetenv("VK_LAYER_PATH");
        // NOLINTEND(concurrency-mt-unsafe)
        void* layer = ::dlopen(REFLET_FAULT_LAYER, RTLD_NOW | RTLD_NOLOAD);
        const auto find = layer == nullptr ? nullptr : reinterpret_cast<void* (*)()>(::dlsym(layer, "refletFaults"));
        faults_ = find == nullptr ? nullptr : static_cast<Faults*>(find());
        std::vector<const char*> names{"moving", "glass"};
        settings_ = {settingsOf("plain", {}), settingsOf("fast", {"temporal.enabled=true"})};
        if (frames_ > 0) {
            names.insert(names.end(), {"cornell", "lens", "lamps"});
            settings_.push_back(settingsOf("balanced", {"planar.enabled=true"}));
            settings_.push_back(settingsOf("fast", {"shadow.filter=pcss", "shadow.cascades=3"}));
        }
        std::ranges::transform(names, std::back_inserter(scenes_),
                               [](const char* name) { return findBuiltinScene(name)->make(); });
    }

    std::vector<State> states() const {
        std::vector<State> all;
        for (size_t i = 0; i < scenes_.size() * sizes.size() * settings_.size(); ++i) {
            all.push_back(
                {i / (sizes.size() * settings_.size()), i % sizes.size(), i / sizes.size() % settings_.size()});
        }
        return all;
    }

    /// Two frames with the history of what was there before, then some from the start. Returns the last one's pixels.
    std::vector<uint8_t> visit(Renderer& renderer, const State& state) {
        View view = defaultView(scenes_[state.scene]);
        std::vector<uint8_t> pixels;
        const uint32_t frames = 3 + (5 * static_cast<uint32_t>(state.settings) + static_cast<uint32_t>(state.size)) % 4;
        for (uint32_t i = 0; i < frames + 2; ++i) {
            if (i == 2) {
                renderer.restart(0);
            }
            view.time = 0.1 * i;
            gpu::Readback display;
            renderer.render(view, sizes[state.size], 0, settings_[state.settings],
                            [&](gpu::Frame& f, const FrameImages& images) { display = f.readback(images.display); });
            const Bitmap bitmap = fetchDisplay(renderer.frame(), display, sizes[state.size]);
            pixels.assign(bitmap.data.begin(), bitmap.data.end());
            ++done_;
        }
        return pixels;
    }

    /// Every state once, in an order that the seed gives; the scene changes each time that it is another's turn.
    void lap(uint32_t seed) {
        std::mt19937 random(seed);
        std::vector<State> order = states();
        std::ranges::shuffle(order, random);
        // Three turns of each scene, each with a third of its states, of different sizes and settings.
        std::ranges::stable_sort(order, {}, [&](const State& s) {
            return (s.size + s.settings) % 3 * scenes_.size() + (s.scene + seed) % scenes_.size();
        });
        std::optional<Renderer> renderer;
        size_t shown = scenes_.size();
        for (const State& state : order) {
            if (state.scene != shown) {
                renderer.reset();
                renderer.emplace(*device_, scenes_[state.scene], [](const std::string&) {});
                shown = state.scene;
            }
            const std::vector<uint8_t> pixels = visit(*renderer, state);
            std::vector<uint8_t>& known = known_[{state.scene, state.size, state.settings}];
            EXPECT_TRUE(known.empty() || known == pixels)
                << "scene " << state.scene << ", size " << state.size << ", settings " << state.settings;
            known = pixels;
        }
    }

    Holdings holdings() {
        return {faults_->alive(), device_->memory().reserved(), entries("/proc/self/fd"), entries("/proc/self/task"),
                residentMiB()};
    }

    size_t frames_ = 0;
    size_t done_ = 0;
    std::optional<gpu::Device> device_;
    Faults* faults_ = nullptr;
    std::vector<Scene> scenes_;
    std::vector<Settings> settings_;
    std::map<std::array<size_t, 3>, std::vector<uint8_t>> known_;
};

// Over 5 s: two presets compile their shaders.
TEST_F(LongRun, IsFlatAndRepeatsItself) {
    ASSERT_NE(faults_, nullptr) << "the layer is not loaded";
    std::vector<Holdings> seen;
    for (uint32_t i = 0; i < 3 || done_ < frames_; ++i) {
        lap(i);
        seen.push_back(holdings());
        if (frames_ > 0) {
            std::cout << done_ << " frames: " << seen.back().residentMiB << " MiB resident, " << seen.back().reserved
                      << " bytes of device memory, " << seen.back().files << " files, " << seen.back().threads
                      << " threads" << std::endl;
        }
    }
    const Holdings& first = seen[1];  // the first lap makes what the device keeps
    const Holdings& last = seen.back();
    EXPECT_EQ(first.alive, last.alive);
    EXPECT_EQ(first.reserved, last.reserved);
    EXPECT_EQ(first.files, last.files);
    EXPECT_EQ(first.threads, last.threads);
    // llvmpipe 22.3 keeps what it compiled for the first frame after a change: 5 MiB each time, measured, and 16 with
    // huge pages (test.sh). What was found here first cost 260.
    constexpr double keptByDriver = 32.0;
    const double changes = static_cast<double>(states().size()) * static_cast<double>(seen.size() - 2);
    EXPECT_LT(last.residentMiB, first.residentMiB + keptByDriver * changes);
    EXPECT_EQ(faults_->misuses(), "");
}

}  // namespace
}  // namespace reflet::fault
