// Renders one scene with one list of settings at one size.
#include "measure/bench/subject.h"

#include "capture/show.h"
#include "job/scene_options.h"

#include <chrono>

namespace reflet {

namespace {

// The first has no history, the second has one: both variants of all pipelines are created.
constexpr int compilingFrames = 2;

// By now, memory dropped earlier has been freed.
uint64_t usedMemory(gpu::Device& device) {
    device.runNow([](VkCommandBuffer) {});
    return device.memory().used(gpu::MemoryUse::device);
}

}  // namespace

Subject::Subject(gpu::Device& device, const BenchScene& scene, uvec2 size, const Settings& settings)
    : view_(scene.view),
      seed_(scene.seed),
      size_(size),
      settings_(settings),
      memoryBefore_(usedMemory(device)),
      renderer_(device, scene.scene, printWarning) {
    if (settings_.accumulate.enabled == 0) {  // accumulation restarts when settings change
        settings_.composite.layers = 0;       // picture() requests them
    }
    for (int i = 0; i < compilingFrames; ++i) {
        render();
    }
    memory_ = usedMemory(device) - memoryBefore_;
    forgetHistory();
}

void Subject::render() {
    renderer_.render(view_, size_, seed_, settings_);
}

void Subject::render(Samples& samples) {
    const auto start = std::chrono::steady_clock::now();
    render();
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    samples.add(wall.count(), renderer_.frame());
}

Layers Subject::picture(const std::vector<std::string>& names) {
    std::vector<ShowReadback> readbacks;
    Settings settings = settings_;
    settings.composite.layers = 1;
    renderer_.render(view_, size_, seed_, settings, [&](gpu::Frame& f, const FrameImages& images) {
        for (const std::string& name : names) {
            readbacks.push_back(requestShow(f, images, findShow(name)));
        }
    });
    const ViewParams params = makeViewParams(view_.camera, size_, 0, seed_);
    Layers layers;
    for (size_t i = 0; i < names.size(); ++i) {
        layers[names[i]] = fetchValues(renderer_.frame(), readbacks[i], params);
    }
    return layers;
}

}  // namespace reflet
