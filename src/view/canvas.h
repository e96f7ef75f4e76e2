// What the window shows: two pictures side by side in a rectangle, and the user interface over all. Shared by C++ and
// GLSL.
#ifndef REFLET_VIEW_CANVAS_H
#define REFLET_VIEW_CANVAS_H

#include "base/shared.h"

SHARED_BEGIN

struct ComposeParams {
    uvec2 size;     // of the window, pixels
    vec2 corner;    // of the rectangle
    vec2 extent;    // of the rectangle; 0: no picture
    vec2 sizeA;     // of the picture on the left, pixels
    vec2 sizeB;     // of the one on the right
    float divider;  // pixels from the window's left edge: from there on, the right one
};

struct UiParams {
    vec2 scale;  // from ImGui's coordinates to the clip space
    vec2 shift;
};

SHARED_END

#ifdef __cplusplus

#include "base/image_file.h"
#include "gpu/frame.h"

struct ImDrawData;

namespace reflet {

/// Where and how the two pictures lie in the window.
struct Layout {
    uvec2 window{0};  ///< pixels
    vec2 corner{0.0F};
    vec2 extent{0.0F};
    float divider = 1e9F;
};

class Canvas {
public:
    /// font: RGBA8.
    Canvas(gpu::Device& device, uvec2 fontSize, std::span<const uint8_t> font);

    /// Draws, and returns when it is done. Pictures may be missing; where the right one is, the left one is everywhere.
    /// The image is valid until the next call.
    gpu::Image draw(gpu::Image left, gpu::Image right, const Layout& layout, const ImDrawData& ui);

    /// What it drew last, as RGB.
    Bitmap picture();

private:
    void upload(const ImDrawData& ui);
    void recordUi(const gpu::DrawCommands& to, const ImDrawData& ui, uvec2 window) const;

    gpu::Device& device_;
    gpu::Frame frame_;
    gpu::Texture font_;
    gpu::Texture none_;
    gpu::Texture window_;
    gpu::Buffer vertices_;
    gpu::Buffer indices_;
};

}  // namespace reflet
#endif

#endif
