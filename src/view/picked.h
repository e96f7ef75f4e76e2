// Data of a picked pixel. Frames may be smaller than the picture (temporal.scale): the user interface uses pixels of
// the picture, and records of shaders use pixels of the frame. PixelScale converts between them.
#pragma once

#include "effects/lobe/record_ray.h"
#include "effects/shadow/record_shadow.h"
#include "effects/view.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// Converts between the pixels of a frame and those of the picture that is made from it.
struct PixelScale {
    uvec2 frame{1};    ///< rendered size
    uvec2 picture{1};  ///< displayed size

    /// The frame's pixel at a pixel of the picture.
    [[nodiscard]] uvec2 toFrame(uvec2 pixel) const { return pixel * frame / picture; }
    /// The picture's pixel in the middle of a pixel of the frame.
    [[nodiscard]] uvec2 toPicture(uvec2 pixel) const { return uvec2(placeInPicture(vec2(pixel) + 0.5F)); }
    /// The same for any position, in pixels from the upper left corner.
    [[nodiscard]] vec2 placeInPicture(const vec2& place) const { return place * vec2(picture) / vec2(frame); }
};

/// Values of the picked pixel in one render target.
struct PickedValues {
    std::string name;
    std::vector<std::string> channels;
    std::vector<float> values;
};

/// A cell of the depth pyramid, in pixels of the picture.
struct PickedCell {
    vec2 corner{0.0F};
    vec2 size{0.0F};
    bool isPixel = false;  ///< the finest level: the cell is a pixel of the frame
};

/// A picked pixel. All positions are in pixels of the picture.
struct Picked {
    uvec2 pixel{0};
    std::vector<PickedValues> values;
    std::optional<RecordedRay> ray;          ///< none where the pixel shows no surface
    std::vector<PickedCell> cells;           ///< cells that the ray march has read, in order
    std::vector<RecordedSample> hemisphere;  ///< diffuse rays from the pixel; none without a surface
    std::optional<RecordedShadow> shadow;    ///< the sun's shadow lookup; none without a surface or a shadow map
    ViewParams view{};                       ///< at the time of the pick
    uint64_t change = 0;                     ///< RenderedImage::changes at the time of the pick
};

/// Stores records of a frame in `picked`, converted to pixels of the picture. The ray's steps stay cells of the frame.
void takeRay(Picked& picked, const RecordedRay& ray, const PixelScale& scale);
void takeHemisphere(Picked& picked, std::vector<RecordedSample> samples, const PixelScale& scale);

/// Whether the ray's hit counts with these settings, which may reject back faces.
inline bool countsAsHit(const RecordedRay& ray, const TraceScreenSettings& settings) {
    return ray.outcome == RayOutcome::hit && !(ray.unseen && settings.rejectBackfaces != 0);
}

}  // namespace reflet
