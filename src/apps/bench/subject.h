// What is measured: one scene with one list of settings at one size, with a renderer of its own, so that several can
// take turns and none sees another's history.
#pragma once

#include "apps/bench/samples.h"
#include "base/image_file.h"
#include "render/renderer.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace reflet {

/// What every subject of a scene has in common.
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
    /// Renders some frames, such that all pipelines and images are there. `scene` must outlive it.
    Subject(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings);

    /// The next frame has no history; all that is worked out once is there.
    void forgetHistory() { renderer_.restart(0); }
    void render();
    void render(Samples& samples);
    /// Renders one more frame and says what its images hold.
    Layers picture(const std::vector<std::string>& names);

    /// Of the device's own memory, bytes: scene, frame and history.
    [[nodiscard]] uint64_t memory() const { return memory_; }
    [[nodiscard]] const Settings& settings() const { return settings_; }
    void change(const Settings& settings) { settings_ = settings; }
    /// From the next frame on.
    void look(const View& view) { view_ = view; }

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
