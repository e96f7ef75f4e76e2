// Finds shows by name, reads their images back and makes pictures of them.
#include "capture/show.h"

#include "base/error.h"
#include "base/text.h"
#include "capture/texels.h"

#include <algorithm>
#include <cmath>

namespace reflet {

const Show& findShow(std::string_view name) {
    const auto found = std::ranges::find(shows(), name, &Show::name);
    if (found == shows().end()) {
        std::vector<std::string> names;
        std::ranges::transform(shows(), std::back_inserter(names), [](const Show& s) { return std::string(s.name); });
        failUsage("no show is called '{}' (see reflet list shows){}", name, suggestion(name, names));
    }
    return *found;
}

ShowReadback requestShow(gpu::Frame& f, const FrameImages& images, const Show& show) {
    const float scale = show.is(ShowProperty::radiance) ? 1.0F / images.view.preExposure : 1.0F;
    ShowReadback readback{&show, show.images(images), {}, scale, images.view};
    for (const gpu::Image& image : readback.images) {
        if (!image) {
            fail("image '{}' is not available with this scene and these settings: {}", show.name, show.description);
        }
        readback.copies.push_back(f.readback(image));
    }
    return readback;
}

namespace {

struct Decoded {
    uvec2 size;
    std::vector<vec4> texels;

    // The texel of this pixel: images of lobes that are traced at reduced resolution are smaller.
    [[nodiscard]] const vec4& at(const uvec2& pixel, const uvec2& picture) const {
        const uvec2 texel = pixel * size / picture;
        return texels[size_t(texel.y) * size.x + texel.x];
    }
};

void valuesOf(const ShowReadback& readback, std::span<const vec4> texels, const ViewParams& view, vec2 uv, float* out) {
    readback.show->values(texels, {view, readback.rendered, uv}, out);
    for (size_t i = 0; i < readback.show->channels.size(); ++i) {
        out[i] *= readback.scale;
    }
}

}  // namespace

FloatImage fetchValues(const gpu::Frame& f, const ShowReadback& readback, const ViewParams& view) {
    std::vector<Decoded> decoded;
    for (size_t i = 0; i < readback.images.size(); ++i) {
        const gpu::Image& image = readback.images[i];
        decoded.push_back({image.size, decodeTexels(image.format, f.bytes(readback.copies[i]))});
    }
    const uvec2 size = readback.show->is(ShowProperty::ownSize) ? decoded.front().size : uvec2(view.size);
    const std::vector<std::string>& channels = readback.show->channels;
    FloatImage values{size.x, size.y, channels, {}};
    values.data.resize(size_t(size.x) * size.y * channels.size());
    std::vector<vec4> texels(decoded.size());
    float* out = values.data.data();
    for (uvec2 pixel(0); pixel.y < size.y; ++pixel.y) {
        for (pixel.x = 0; pixel.x < size.x; ++pixel.x, out += channels.size()) {
            std::ranges::transform(decoded, texels.begin(), [&](const Decoded& d) { return d.at(pixel, size); });
            valuesOf(readback, texels, view, (vec2(pixel) + 0.5F) / vec2(size), out);
        }
    }
    return values;
}

std::vector<float> fetchValue(const gpu::Frame& f, const ShowReadback& readback, const ViewParams& view, uvec2 pixel) {
    std::vector<vec4> texels;
    for (size_t i = 0; i < readback.images.size(); ++i) {
        const gpu::Image& image = readback.images[i];
        const uvec2 texel = pixel * image.size / uvec2(view.size);
        const size_t bytes = gpu::bytesPerTexel(image.format);
        const auto at = f.bytes(readback.copies[i]).subspan((size_t(texel.y) * image.size.x + texel.x) * bytes, bytes);
        texels.push_back(decodeTexels(image.format, at).front());
    }
    std::vector<float> values(readback.show->channels.size());
    valuesOf(readback, texels, view, (vec2(pixel) + 0.5F) / vec2(view.size), values.data());
    return values;
}

Bitmap makePicture(const Show& show, const FloatImage& values) {
    Bitmap bitmap{values.width, values.height, 3, {}};
    const size_t pixels = size_t(values.width) * values.height;
    bitmap.data.reserve(pixels * 3);
    for (size_t i = 0; i < pixels; ++i) {
        const vec3 c = show.picture(&values.data[i * values.channels.size()]);
        for (int channel = 0; channel < 3; ++channel) {
            bitmap.data.push_back(static_cast<uint8_t>(std::lround(c[channel] * 255.0F)));
        }
    }
    return bitmap;
}

Bitmap fetchDisplay(const gpu::Frame& f, gpu::Readback readback, uvec2 size, bool alpha) {
    const auto bytes = f.bytes(readback);
    const size_t channels = alpha ? 4 : 3;
    Bitmap bitmap{size.x, size.y, static_cast<uint32_t>(channels), {}};
    bitmap.data.reserve(bytes.size() / 4 * channels);
    for (size_t i = 0; i < bytes.size(); i += 4) {
        for (size_t channel = 0; channel < channels; ++channel) {
            bitmap.data.push_back(static_cast<uint8_t>(bytes[i + channel]));
        }
    }
    return bitmap;
}

}  // namespace reflet
