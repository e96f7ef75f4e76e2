// Texture lookup.
#include "reference/texture.h"

#include "base/color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

std::array<float, 256> decodingTable() {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        table[i] = static_cast<float>(decodeSrgb(static_cast<double>(i) / 255.0));
    }
    return table;
}

int wrapped(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) {
        return std::clamp(texel, 0, size - 1);
    }
    const int period = wrap == Wrap::mirror ? 2 * size : size;
    const int inside = (texel % period + period) % period;
    return inside < size ? inside : period - 1 - inside;
}

class Texels {
public:
    Texels(const TextureImage& image, const Sampler& sampler, bool srgb)
        : image_(image), sampler_(sampler), srgb_(srgb) {}

    [[nodiscard]] vec4 at(int x, int y) const {
        static const std::array<float, 256> decoded = decodingTable();
        const auto column = static_cast<size_t>(wrapped(x, static_cast<int>(image_.width), sampler_.wrapU));
        const auto row = static_cast<size_t>(wrapped(y, static_cast<int>(image_.height), sampler_.wrapV));
        const uint8_t* t = &image_.rgba[(row * image_.width + column) * 4];
        const float alpha = static_cast<float>(t[3]) / 255.0F;
        if (srgb_) {
            return {decoded[t[0]], decoded[t[1]], decoded[t[2]], alpha};
        }
        return {vec3(t[0], t[1], t[2]) / 255.0F, alpha};
    }

private:
    const TextureImage& image_;
    const Sampler& sampler_;
    bool srgb_;
};

}  // namespace

vec4 readTexture(const Scene& scene, const TextureSlot& slot, const vec2& uv0, const vec2& uv1, bool srgb) {
    static const Sampler standard;
    const TextureImage& image = scene.images[static_cast<size_t>(slot.image)];
    const Sampler& sampler = slot.sampler < 0 ? standard : scene.samplers[static_cast<size_t>(slot.sampler)];
    const vec3 uv(slot.uvSet == 1 ? uv1 : uv0, 1.0F);
    // Coordinates far outside would overflow an int; repetition does not matter there.
    const vec2 size(image.width, image.height);
    const vec2 at =
        glm::clamp(vec2(glm::dot(slot.uvTransform[0], uv), glm::dot(slot.uvTransform[1], uv)) * size, -1e9F, 1e9F);
    const Texels texels(image, sampler, srgb);
    if (!sampler.magLinear) {
        return texels.at(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
    }
    const vec2 corner = glm::floor(at - 0.5F);
    const vec2 f = at - 0.5F - corner;
    const int x = static_cast<int>(corner.x);
    const int y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(texels.at(x, y), texels.at(x + 1, y), f.x),
                    glm::mix(texels.at(x, y + 1), texels.at(x + 1, y + 1), f.x), f.y);
}

}  // namespace reflet
