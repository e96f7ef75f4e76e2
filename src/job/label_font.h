// Draws text into pictures: DejaVu Sans, by stb_truetype.
#pragma once

#include "base/image_file.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace reflet {

class LabelFont {
public:
    /// height: of a line in pixels. Searches the font where distributions install it; see isLoaded().
    explicit LabelFont(float height);

    [[nodiscard]] bool isLoaded() const { return !file_.empty(); }
    [[nodiscard]] uint32_t lineHeight() const;
    /// Width in pixels; 0 without a font. text: UTF-8.
    [[nodiscard]] float widthOf(std::string_view text) const;
    /// The text with its middle replaced by an ellipsis, if it is wider than `width` pixels.
    [[nodiscard]] std::string shortened(std::string_view text, float width) const;
    /// Draws onto an RGB bitmap and clips to it. left, top: of the line, in pixels; grey: value of its letters.
    void draw(Bitmap& bitmap, std::string_view text, float left, uint32_t top, uint8_t grey) const;

private:
    std::string file_;  ///< the font's bytes
    float height_;
};

}  // namespace reflet
