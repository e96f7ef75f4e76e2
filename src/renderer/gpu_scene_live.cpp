// Live camera images: textures rendered every frame and shown by materials.
#include "renderer/gpu_scene.h"

#include "base/message.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace reflet {

std::optional<size_t> GpuScene::livePictureOf(const Scene& scene, const Material& material,
                                              const std::function<void(const std::string&)>& warn) {
    if (material.camera.empty()) {
        return std::nullopt;
    }
    const auto known = std::ranges::find(live_, material.camera, [](const LivePicture& p) { return p.camera.name; });
    if (known != live_.end()) {
        return known - live_.begin();
    }
    const auto camera = std::ranges::find(scene.cameras, material.camera, &Camera::name);
    if (camera == scene.cameras.end()) {
        std::vector<std::string> names;
        std::ranges::transform(scene.cameras, std::back_inserter(names),
                               [](const Camera& c) { return fmt::format("'{}'", c.name); });
        warn(fmt::format("material '{}' shows camera '{}', which is not in the scene; its cameras are: {}",
                         material.name, material.camera, listed(names)));
        return std::nullopt;
    }
    live_.push_back({*camera, *camera, {}});
    return live_.size() - 1;
}

void GpuScene::setLiveHeight(uint32_t pixels) {
    if (live_.empty() || live_.front().texture.info().size.y == pixels) {
        return;
    }
    const uvec2 size(std::max(1U, pixels * 16 / 9), pixels);
    draws_.livePictures.clear();
    for (LivePicture& picture : live_) {
        picture.texture =
            gpu::Texture(device_,
                         {VK_FORMAT_R16G16B16A16_SFLOAT, size, 1, 1,
                          VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT},
                         "live picture");
        picture.fresh = true;
        draws_.livePictures.push_back(picture.texture.image());
    }
    for (MaterialBinding& binding : materialBindings_) {
        if (binding.live) {
            binding.views[slotEmissive] = live_[*binding.live].texture.image().view();
            writeMaterialSet(binding);
        }
    }
}

}  // namespace reflet
