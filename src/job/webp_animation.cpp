// WebP animations. The format: RFC 9649 (Zern, Massimino and Alakuijala, 2024).
#include "job/webp_animation.h"

#include "base/error.h"
#include "base/file.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <string_view>

namespace reflet {

namespace {

constexpr float quality = 90.0F;  // of 100
constexpr double millisecondsPerSecond = 1000.0;

/// Frees what the encoder holds of a picture.
struct Picture {
    Picture() { REFLET_CHECK(WebPPictureInit(&data) != 0, "libwebp has another version than its headers"); }
    ~Picture() { WebPPictureFree(&data); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    WebPPicture data{};
};

WebPConfig makeConfig() {
    WebPConfig config;
    REFLET_CHECK(WebPConfigPreset(&config, WEBP_PRESET_PICTURE, quality) != 0, "quality {}", quality);
    config.use_sharp_yuv = 1;  // else edges of saturated colours are blurred
    config.thread_level = 1;
    return config;
}

}  // namespace

struct WebpAnimation::Encoder {
    Encoder(uint32_t width, uint32_t height) {
        WebPAnimEncoderOptions options;
        REFLET_CHECK(WebPAnimEncoderOptionsInit(&options) != 0, "libwebpmux has another version than its headers");
        options.anim_params.loop_count = 0;  // forever
        encoder = WebPAnimEncoderNew(static_cast<int>(width), static_cast<int>(height), &options);
        if (encoder == nullptr) {
            fail("not enough memory for a WebP animation of {}x{} pixels", width, height);
        }
    }
    ~Encoder() { WebPAnimEncoderDelete(encoder); }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    WebPAnimEncoder* encoder = nullptr;
    WebPConfig config = makeConfig();
};

WebpAnimation::WebpAnimation(uint32_t width, uint32_t height, double fps) : width_(width), height_(height), fps_(fps) {
    if (width > largestSide || height > largestSide) {
        failUsage("a WebP animation can have up to {} pixels a side, not {}x{}", largestSide, width, height);
    }
    encoder_ = std::make_unique<Encoder>(width, height);
}

WebpAnimation::~WebpAnimation() = default;

int WebpAnimation::timeOf(uint32_t frame) const {
    return static_cast<int>(std::lround(frame / fps_ * millisecondsPerSecond));
}

void WebpAnimation::add(const Bitmap& bitmap) {
    if (bitmap.width != width_ || bitmap.height != height_) {
        fail("a frame has {}x{} pixels, others of the film {}x{}", bitmap.width, bitmap.height, width_, height_);
    }
    Picture picture;
    picture.data.use_argb = 1;
    picture.data.width = static_cast<int>(width_);
    picture.data.height = static_cast<int>(height_);
    const int stride = static_cast<int>(width_ * bitmap.channels);
    const auto import = bitmap.channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
    REFLET_CHECK(bitmap.channels == 3 || bitmap.channels == 4, "{} channels", bitmap.channels);
    if (import(&picture.data, bitmap.data.data(), stride) == 0 ||
        WebPAnimEncoderAdd(encoder_->encoder, &picture.data, timeOf(frames_), &encoder_->config) == 0) {
        fail("libwebp cannot encode frame {}: {}", frames_, WebPAnimEncoderGetError(encoder_->encoder));
    }
    ++frames_;
}

uint64_t WebpAnimation::write(const std::filesystem::path& file) {
    WebPData data;
    WebPDataInit(&data);
    const bool done = WebPAnimEncoderAdd(encoder_->encoder, nullptr, timeOf(frames_), nullptr) != 0 &&
                      WebPAnimEncoderAssemble(encoder_->encoder, &data) != 0;
    if (!done) {
        fail("{}: libwebp cannot assemble the film: {}", file.string(), WebPAnimEncoderGetError(encoder_->encoder));
    }
    const std::unique_ptr<WebPData, void (*)(WebPData*)> owner(&data, WebPDataClear);
    writeFileAtomically(file, std::string_view(reinterpret_cast<const char*>(data.bytes), data.size));
    return data.size;
}

}  // namespace reflet
