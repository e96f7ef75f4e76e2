// Renders noisy images.
#include "dataset/preset_frames.h"

#include "capture/show.h"
#include "renderer/history.h"

namespace reflet {

PresetFrames::PresetFrames(gpu::Device& device, const DatasetScene& scene, const std::vector<std::string>& presets)
    : scene_(scene), size_(parseSize(scene.options.size)), renderer_(device, scene.scene, printWarning) {
    for (const std::string& name : presets) {
        SceneOptions options = scene.options;
        options.preset = name;
        Preset preset{name, loadSettings(options)};
        preset.settings.composite.layers = 1;
        presets_.push_back(std::move(preset));
    }
}

std::vector<NoisyImages> PresetFrames::render(const Shot& shot, int frame, uint32_t number) {
    std::vector<NoisyImages> all;
    for (const Preset& preset : presets_) {
        all.push_back(renderOne(preset, shot, frame, number));
    }
    return all;
}

NoisyImages PresetFrames::renderOne(const Preset& preset, const Shot& shot, int frame, uint32_t number) {
    constexpr int warmUp = 16;
    const uint32_t seed = scene_.options.seed;
    renderer_.restart(number);
    for (int i = historyUse(preset.settings, scene_.scene).any() ? warmUp : 0; i > 0; --i) {
        renderer_.render(shot.at(frame - i), size_, seed, preset.settings);
    }
    std::vector<ShowReadback> readbacks;
    const View view = shot.at(frame);
    renderer_.render(view, size_, seed, preset.settings, [&](gpu::Frame& f, const FrameImages& images) {
        for (const char* name : {"final", "unfiltered", "direct", "indirect_diffuse", "indirect_specular"}) {
            readbacks.push_back(requestShow(f, images, findShow(name)));
        }
    });
    const ViewParams params = makeViewParams(view.camera, size_, 0, seed);
    NoisyImages noisy{preset.name, 0, {}};
    for (const ShowReadback& readback : readbacks) {
        noisy.layers.push_back({std::string(readback.show->name), fetchValues(renderer_.frame(), readback, params)});
    }
    return noisy;
}

}  // namespace reflet
