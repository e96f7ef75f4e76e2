// Text in pictures: DejaVu Sans, as stb_truetype draws it.
#pragma once

#include "base/image_file.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace reflet {

class LabelFont {
public:
    /// height: of a line in pixels. Finds the font where distributions install it; isLoaded() tells whether.
    explicit LabelFont(float height);

    [[nodiscard]] bool isLoaded() const { return !file_.empty(); }
    [[nodiscard]] uint32_t lineHeight() const;
    /// In pixels; 0 without a font. text: UTF-8.
    [[nodiscard]] float widthOf(std::string_view text) const;
    /// The text with its middle replaced by an ellipsis, if it is wider.
    [[nodiscard]] std::string shortened(std::string_view text, float width) const;
    /// Draws onto an RGB bitmap: `left` and `top` of the line, in pixels; `grey` of its letters. What is outside of the
    /// bitmap is left out.
    void draw(Bitmap& bitmap, std::string_view text, float left, uint32_t top, uint8_t grey) const;

private:
    std::string file_;  ///< the font's bytes
    float height_;
};

}  // namespace reflet
