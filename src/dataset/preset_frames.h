// Noisy images by presets of the renderer.
#pragma once

#include "dataset/files.h"
#include "dataset/views.h"
#include "renderer/renderer.h"

namespace reflet {

class PresetFrames {
public:
    /// presets: names. The scene must outlive this object. Throws UsageError for an unknown preset.
    PresetFrames(gpu::Device& device, const DatasetScene& scene, const std::vector<std::string>& presets);

    /// The burst's frame. Presets with a history first render the 16 frames before it. number: for the noise.
    std::vector<NoisyImages> render(const Shot& shot, int frame, uint32_t number);

private:
    struct Preset {
        std::string name;
        Settings settings;
    };

    NoisyImages renderOne(const Preset& preset, const Shot& shot, int frame, uint32_t number);

    const DatasetScene& scene_;
    uvec2 size_;
    Renderer renderer_;
    std::vector<Preset> presets_;
};

}  // namespace reflet
