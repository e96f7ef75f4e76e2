// The subject of a measurement: one scene with one list of settings at one size. Each has its own renderer, so that
// several can be measured alternately without sharing history.
#pragma once

#include "base/image_file.h"
#include "measure/bench/samples.h"
#include "renderer/renderer.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace reflet {

/// Shared by all subjects of a scene.
struct BenchScene {
    std::string name;
    Scene scene;
    View view;
    uint32_t seed = 0;
};

/// Images of the frame by their names in `reflet list shows`.
using Layers = std::map<std::string, FloatImage>;

class Subject {
public:
    /// Renders some frames, so that all pipelines and images exist. `scene` must outlive it.
    Subject(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings);

    /// Discards history, but keeps everything that is computed only once.
    void forgetHistory() { renderer_.restart(0); }
    void render();
    void render(Samples& samples);
    /// Renders one more frame and reads its images back.
    Layers picture(const std::vector<std::string>& names);

    /// Device memory in bytes: scene, frame and history.
    [[nodiscard]] uint64_t memory() const { return memory_; }
    [[nodiscard]] const Settings& settings() const { return settings_; }
    void change(const Settings& settings) { settings_ = settings; }
    /// Sets the view from the next frame on.
    void setView(const View& view) { view_ = view; }

private:
    View view_;
    uint32_t seed_;
    uvec2 size_;
    Settings settings_;
    uint64_t memoryBefore_;
    Renderer renderer_;
    uint64_t memory_ = 0;
};

}  // namespace reflet
