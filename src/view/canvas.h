// Draws the window: two images in a rectangle, separated by a divider, with the user interface on top. Shared by C++
// and GLSL.
#ifndef REFLET_VIEW_CANVAS_H
#define REFLET_VIEW_CANVAS_H

#include "base/shared.h"

SHARED_BEGIN

struct ComposeParams {
    uvec2 size;     // size of the window, pixels
    vec2 corner;    // upper left corner of the rectangle
    vec2 extent;    // size of the rectangle; 0: no image
    vec2 sizeA;     // size of the left image, pixels
    vec2 sizeB;     // size of the right image, pixels
    float divider;  // x in pixels of the window: the right image starts here
    uint linear;    // 1: linear filtering of the images; 0: nearest texel
    uint swapped;   // 1: writes blue, green, red
};

struct UiParams {
    vec2 scale;  // from ImGui's coordinates to clip space
    vec2 shift;
    uint swapped;
};

SHARED_END

#ifdef __cplusplus

#include "base/image_file.h"
#include "device/frame.h"

#include <memory>

struct ImDrawData;

namespace reflet {

/// Placement of the two images in the window.
struct Layout {
    uvec2 window{0};  ///< pixels
    vec2 corner{0.0F};
    vec2 extent{0.0F};
    float divider = 1e9F;
    bool linear = false;  ///< linear filtering of images whose size differs from the rectangle's

    bool operator==(const Layout&) const = default;
};

class Canvas {
public:
    /// font: RGBA8. swapped: draws with red and blue swapped (BGRA), the usual format of windows.
    Canvas(gpu::Device& device, uvec2 fontSize, std::span<const uint8_t> font, bool swapped);

    using Picture = std::shared_ptr<const Bitmap>;

    /// Draws the window's image, and waits until it is done. Images (RGB or RGBA) may be null; without a right one, the
    /// left one fills the rectangle. The result is valid until the next call.
    gpu::Image draw(const Picture& left, const Picture& right, const Layout& layout, const ImDrawData& ui);

    /// Reads the last drawn window back, as RGB.
    Bitmap picture();

private:
    struct Side {
        Picture of;
        gpu::Texture texture;
    };

    void upload(const ImDrawData& ui);
    gpu::Image upload(const Picture& picture, Side& side);
    void compose(const Picture& left, const Picture& right, const Layout& layout);
    void recordUi(const gpu::DrawCommands& to, const ImDrawData& ui, uvec2 window) const;

    gpu::Device& device_;
    gpu::Frame frame_;
    bool swapped_;
    gpu::Texture font_;
    gpu::Texture none_;
    Side left_;
    Side right_;         ///< null where there is no right image
    gpu::Texture base_;  ///< the images without the user interface, kept while they stay the same
    Layout baseLayout_;
    gpu::Texture window_;
    gpu::Buffer vertices_;
    gpu::Buffer indices_;
};

}  // namespace reflet
#endif

#endif
