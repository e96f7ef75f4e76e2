// WebP animations, by libwebp. They loop forever.
#pragma once

#include "base/image_file.h"

#include <filesystem>
#include <memory>

namespace reflet {

class WebpAnimation {
public:
    static constexpr uint32_t largestSide = 16383;  ///< pixels, the format's limit

    /// fps: frames per second, above 0.
    WebpAnimation(uint32_t width, uint32_t height, double fps);
    ~WebpAnimation();
    WebpAnimation(const WebpAnimation&) = delete;
    WebpAnimation& operator=(const WebpAnimation&) = delete;

    /// Encodes the next frame, lossy with quality 90. bitmap: 3 or 4 channels. Throws Error, also for another size.
    void add(const Bitmap& bitmap);

    /// Writes the file atomically; call at most once. Returns its size in bytes. Throws Error.
    uint64_t write(const std::filesystem::path& file);

private:
    struct Encoder;
    [[nodiscard]] int timeOf(uint32_t frame) const;

    std::unique_ptr<Encoder> encoder_;
    uint32_t width_;
    uint32_t height_;
    double fps_;
    uint32_t frames_ = 0;
};

}  // namespace reflet
